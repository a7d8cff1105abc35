//! Scenes on a table.

use super::dice::Dice;
use super::point::{Point, add};
use super::scene::{Area, Scene, Spot};
use super::sequence;
use super::session::Session;

const NAMES: [&str; 8] = ["cup", "bolt", "spool", "crate", "wedge", "puck", "flask", "tile"];

/// Every object goes to a place of its own, in any of several orders.
pub(super) fn own_places(dice: &mut Dice, session: &Session, area: Area) -> Scene {
    let things = names(dice, 1..=5);
    let mut centers: Vec<Point> = Vec::new();
    for _ in &things {
        let next = area.clear_spot(dice, &[], 0.0, &centers);
        centers.push(next);
    }
    let spot = |(thing, center)| Spot { thing, label: "home".to_owned(), center };
    let spots: Vec<Spot> = centers.into_iter().enumerate().map(spot).collect();
    let orders =
        sequence::several(dice, session.demonstrations, |dice| sequence::respecting(dice, spots.len(), &[]));
    Scene { things, spots, orders, area }
}

/// Objects are stacked on one base or two; who lies at which level differs between the orders.
pub(super) fn stacks(dice: &mut Dice, session: &Session, area: Area) -> Scene {
    let things = names(dice, 2..=5);
    let bases = if things.len() > 2 && dice.chance(0.5) { 2 } else { 1 };
    let slots: Vec<(usize, usize)> = (0..things.len()).map(|index| (index % bases, index / bases)).collect();
    let upwards: Vec<(usize, usize)> = (bases..slots.len()).map(|slot| (slot - bases, slot)).collect();
    let habit = sequence::respecting(dice, things.len(), &[]);
    let shown = sequence::several(dice, session.demonstrations, |dice| {
        let filled = sequence::respecting(dice, slots.len(), &upwards);
        let mut lots = habit.clone();
        if dice.chance(0.3) {
            dice.shuffle(&mut lots);
        } else {
            let first = dice.count(0..=lots.len() - 2);
            lots.swap(first, first + 1);
        }
        filled.into_iter().map(|slot| (lots[slot], slots[slot])).collect::<Vec<_>>()
    });
    let level = dice.between(0.03, 0.06).max(session.separation());
    let mut centers: Vec<Point> = Vec::new();
    for _ in 0..bases {
        let next = area.clear_spot(dice, &centers, session.separation().max(0.06), &[]);
        centers.push(next);
    }
    let mut spots = Vec::new();
    let spot = |&(thing, (base, height)): &(usize, (usize, usize))| Spot {
        thing,
        label: format!("base-{}-level-{}", base + 1, height + 1),
        center: add(centers[base], [0.0, 0.0, level * height as f64]),
    };
    let orders =
        shown.iter().map(|order| order.iter().map(|step| index_of(&mut spots, spot(step))).collect());
    let orders = orders.collect();
    Scene { things, spots, orders, area }
}

/// Objects are parked before they go to their last place: one of their own, or a level of one stack.
pub(super) fn parking(dice: &mut Dice, session: &Session, area: Area) -> Scene {
    let things = names(dice, 1..=3);
    let stacked = dice.chance(0.5);
    let level = dice.between(0.03, 0.06).max(session.separation());
    let base = area.clear_spot(dice, &[], 0.0, &[]);
    let mut spots: Vec<Spot> = Vec::new();
    let mut pairs = Vec::new();
    for thing in 0..things.len() {
        let crowd: Vec<Point> = spots.iter().map(|spot| spot.center).collect();
        let last = if stacked {
            add(base, [0.0, 0.0, level * thing as f64])
        } else {
            area.clear_spot(dice, &[], 0.0, &crowd)
        };
        let park = area.place(dice, &[last], session.separation(), &crowd);
        let next = spots.len();
        pairs.push((next, next + 1));
        if stacked && thing > 0 {
            pairs.push((next - 1, next + 1));
        }
        spots.push(Spot { thing, label: "park".to_owned(), center: park });
        spots.push(Spot { thing, label: "home".to_owned(), center: last });
    }
    let orders = sequence::several(dice, session.demonstrations, |dice| {
        sequence::respecting(dice, spots.len(), &pairs)
    });
    Scene { things, spots, orders, area }
}

/// One object is put down at three to five places.
pub(super) fn carried(dice: &mut Dice, session: &Session, area: Area) -> Scene {
    let things = names(dice, 1..=1);
    let mut centers: Vec<Point> = Vec::new();
    for _ in 0..dice.count(3..=5) {
        let next = area.place(dice, &centers, session.separation(), &[]);
        centers.push(next);
    }
    let spot = |(index, center)| Spot { thing: 0, label: format!("stop-{}", index + 1), center };
    let spots: Vec<Spot> = centers.into_iter().enumerate().map(spot).collect();
    let orders =
        sequence::several(dice, session.demonstrations, |dice| sequence::respecting(dice, spots.len(), &[]));
    Scene { things, spots, orders, area }
}

fn names(dice: &mut Dice, count: std::ops::RangeInclusive<usize>) -> Vec<&'static str> {
    let mut names = NAMES.to_vec();
    dice.shuffle(&mut names);
    names.truncate(dice.count(count));
    names
}

/// Where `spot` is in `spots`, to which it is added when new.
fn index_of(spots: &mut Vec<Spot>, spot: Spot) -> usize {
    if let Some(index) = spots.iter().position(|known| *known == spot) {
        return index;
    }
    spots.push(spot);
    spots.len() - 1
}
