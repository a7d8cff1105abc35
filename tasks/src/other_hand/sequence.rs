//! Orders in which places are visited.

use super::dice::Dice;

/// A random order of `0..count` in which every `(before, after)` pair is kept.
pub(super) fn respecting(dice: &mut Dice, count: usize, pairs: &[(usize, usize)]) -> Vec<usize> {
    let mut left: Vec<usize> = (0..count).collect();
    let mut order = Vec::with_capacity(count);
    while !left.is_empty() {
        let free =
            |item: &usize| !pairs.iter().any(|&(before, after)| after == *item && left.contains(&before));
        let free: Vec<usize> = left.iter().copied().filter(free).collect();
        let next = dice.pick(&free);
        left.retain(|&item| item != next);
        order.push(next);
    }
    order
}

/// Two to four distinct orders, now and then a single one, few enough that each can be shown twice.
pub(super) fn several<T: PartialEq>(
    dice: &mut Dice,
    demonstrations: usize,
    mut draw: impl FnMut(&mut Dice) -> T,
) -> Vec<T> {
    let least = if dice.chance(0.1) { 1 } else { 2 };
    let wanted = dice.count(least..=(demonstrations / 2).min(4));
    let mut orders = Vec::new();
    for _ in 0..8 * wanted {
        let order = draw(dice);
        if orders.len() < wanted && !orders.contains(&order) {
            orders.push(order);
        }
    }
    orders
}

/// The order shown in each demonstration: each at least twice, the rest by preference.
pub(super) fn deal(dice: &mut Dice, orders: usize, demonstrations: usize) -> Vec<usize> {
    let preferences: Vec<f64> = (0..orders).map(|_| dice.between(0.2, 1.0)).collect();
    let mut dealt: Vec<usize> = (0..2 * orders).map(|index| index % orders).collect();
    while dealt.len() < demonstrations {
        let candidate = dice.count(0..=orders - 1);
        if dice.chance(preferences[candidate]) {
            dealt.push(candidate);
        }
    }
    dice.shuffle(&mut dealt);
    dealt
}
