//! Orders of placing, and how many demonstrations show each.

use crate::chance::Chance;
use crate::layout::Order;

/// How many of `demonstrations` show each order: in proportion to the preferences (largest remainder), but each
/// at least `at_least` times where there are enough.
pub(crate) fn apportion(orders: &[Order], demonstrations: usize, at_least: usize) -> Vec<usize> {
    let enough = demonstrations >= at_least * orders.len();
    let floor = if enough { at_least } else { 0 };
    let total: usize = orders.iter().map(|order| order.preference).sum();
    let mut counts = vec![floor; orders.len()];
    for _ in floor * orders.len()..demonstrations {
        let due = |index: usize| {
            let quota = orders[index].preference * demonstrations;
            quota.cast_signed() - (counts[index] * total).cast_signed()
        };
        let most_due = (0..orders.len()).rev().max_by_key(|&index| due(index));
        counts[most_due.unwrap_or(0)] += 1;
    }
    counts
}

/// All permutations of `0..count`, in lexicographic order.
pub(crate) fn permutations(count: usize) -> Vec<Vec<usize>> {
    let mut words = vec![Vec::new()];
    for _ in 0..count {
        let longer = |word: &Vec<usize>| {
            let unused = (0..count).filter(|symbol| !word.contains(symbol));
            let words = unused.map(|symbol| [word.as_slice(), &[symbol]].concat());
            words.collect::<Vec<_>>()
        };
        words = words.iter().flat_map(longer).collect();
    }
    words
}

/// A random word of `0..count` in which the first of each pair stands before the second.
///
/// The pairs must not form a cycle.
pub(crate) fn random_word(count: usize, before: &[(usize, usize)], chance: &mut Chance) -> Vec<usize> {
    let mut word: Vec<usize> = Vec::with_capacity(count);
    while word.len() < count {
        let waits =
            |symbol: usize| before.iter().any(|&(first, second)| second == symbol && !word.contains(&first));
        let ready: Vec<usize> =
            (0..count).filter(|&symbol| !word.contains(&symbol) && !waits(symbol)).collect();
        word.push(chance.pick(&ready));
    }
    word
}

/// Up to `wanted` distinct words with falling preferences.
pub(crate) fn random_orders(
    wanted: usize,
    mut draw: impl FnMut(&mut Chance) -> Vec<usize>,
    chance: &mut Chance,
) -> Vec<Order> {
    let mut orders: Vec<Order> = Vec::new();
    for _ in 0..4 * wanted {
        let word = draw(chance);
        if orders.len() < wanted && orders.iter().all(|order| order.word != word) {
            let preference = chance.whole(1, 12 / (orders.len() + 1).min(6));
            orders.push(Order { word, preference });
        }
    }
    orders
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(preferences: &[usize], demonstrations: usize, at_least: usize) -> Vec<usize> {
        let order = |&preference: &usize| Order { word: Vec::new(), preference };
        let orders: Vec<Order> = preferences.iter().map(order).collect();
        apportion(&orders, demonstrations, at_least)
    }

    #[test]
    fn demonstrations_are_shared_out_in_proportion() {
        assert_eq!(counts(&[2, 1], 9, 1), [6, 3]);
        assert_eq!(counts(&[7, 3, 2, 2, 2, 2], 18, 1), [7, 3, 2, 2, 2, 2]);
        assert_eq!(counts(&[100, 1, 1], 5, 1), [3, 1, 1]);
        assert_eq!(counts(&[3, 2, 1], 2, 1), [1, 1, 0]);
    }

    #[test]
    fn four_things_have_24_permutations() {
        let words = permutations(4);
        assert_eq!(words.len(), 24);
        assert!(words.is_sorted());
        assert_eq!(words[23], [3, 2, 1, 0]);
    }

    #[test]
    fn a_random_word_keeps_its_constraints() {
        for seed in 0..50 {
            let word = random_word(4, &[(3, 0), (0, 1)], &mut Chance::new(seed, 0));
            let position = |symbol| word.iter().position(|&other| other == symbol);
            assert!(position(3) < position(0) && position(0) < position(1));
        }
    }
}
