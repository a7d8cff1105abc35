//! Where the things of a random task start, where they are put, and in which orders.

use crate::chance::Chance;
use crate::geometry::{Point, raised};
use crate::layout::{Layout, Object, Order, Site};
use crate::orders::{random_orders, random_word};

use super::knobs::{Kind, Knobs};
use super::names;
use super::space::{Space, beside, scatter};

const TABLE: Space = [(0.0, 0.7), (-0.35, 0.35), (0.02, 0.02)];
const ROOM: Space = [(0.0, 4.0), (-2.0, 2.0), (0.4, 2.0)];
const JOINTS: Space = [(-1.6, 1.6), (-1.6, 1.6), (0.0, 0.0)];
/// Between spots on the table.
const GAP: f64 = 0.12;

pub(crate) fn draw(knobs: &Knobs, chance: &mut Chance) -> Layout {
    match knobs.kind {
        Kind::Apart => apart(knobs, chance),
        Kind::Levels => levels(knobs, chance),
        Kind::Relay => relay(knobs, chance),
        Kind::Visits => {
            let name = names::objects(1, chance)[0];
            visits(knobs, name, TABLE, chance)
        }
        Kind::Drone => visits(knobs, "drone", ROOM, chance),
        Kind::Arm => visits(knobs, "arm", JOINTS, chance),
    }
}

/// Each object has one place; some must be placed before others.
fn apart(knobs: &Knobs, chance: &mut Chance) -> Layout {
    let count = chance.whole(2, 5);
    let spots = scatter(2 * count, TABLE, GAP, chance);
    let names = names::objects(count, chance);
    let sites = (0..count).map(|object| site(&names, object, 1, spots[count + object]));
    let before = random_constraints(count, chance);
    Layout {
        sites: sites.collect(),
        orders: draw_orders(knobs, count, &before, chance),
        objects: objects(knobs, &names, &spots, chance),
    }
}

/// One stack, built in different orders.
fn levels(knobs: &Knobs, chance: &mut Chance) -> Layout {
    let count = chance.whole(2, 4);
    let spots = scatter(count + 1, TABLE, GAP, chance);
    let names = names::objects(count, chance);
    let height = chance.within((0.025, 0.06)).max(knobs.separation);
    let wanted = chance.whole(2, 4).min(knobs.demonstrations / 2);
    let stacks = random_orders(wanted, |chance| random_word(count, &[], chance), chance);
    let mut sites: Vec<Site> = Vec::new();
    let mut find_or_add = |object: usize, level: usize| {
        let found = site(&names, object, level + 1, raised(spots[count], height * level as f64));
        let known = sites.iter().position(|site| site.name == found.name);
        known.unwrap_or_else(|| {
            sites.push(found);
            sites.len() - 1
        })
    };
    let mut orders: Vec<Order> = Vec::new();
    for Order { word, preference } in stacks {
        let levels = word.into_iter().enumerate();
        let word = levels.map(|(level, object)| find_or_add(object, level)).collect();
        orders.push(Order { word, preference });
    }
    Layout { objects: objects(knobs, &names, &spots, chance), sites, orders }
}

/// Some objects, at least the first, are put at a first place and later at a second.
fn relay(knobs: &Knobs, chance: &mut Chance) -> Layout {
    let count = chance.whole(1, 4);
    let spots = scatter(3 * count, TABLE, GAP, chance);
    let names = names::objects(count, chance);
    let mut before = random_constraints(count, chance);
    let mut sites: Vec<Site> = Vec::new();
    for object in 0..count {
        sites.push(site(&names, object, 1, spots[count + object]));
    }
    for object in 0..count {
        if object == 0 || chance.happens(0.4) {
            before.push((object, sites.len()));
            let second = second_place(knobs, &spots, count + object, 2 * count + object, chance);
            sites.push(site(&names, object, 2, second));
        }
    }
    Layout {
        orders: draw_orders(knobs, sites.len(), &before, chance),
        objects: objects(knobs, &names, &spots, chance),
        sites,
    }
}

/// One thing with several places.
fn visits(knobs: &Knobs, name: &'static str, space: Space, chance: &mut Chance) -> Layout {
    let count = chance.whole(2, 5);
    let mut spots = scatter(1 + count, space, GAP * knobs.scale, chance);
    let last = spots.len() - 1;
    spots[last] = second_place(knobs, &spots, 1, last, chance);
    let sites = (1..=count).map(|visit| site(&[name], 0, visit, spots[visit]));
    Layout {
        sites: sites.collect(),
        orders: draw_orders(knobs, count, &[], chance),
        objects: objects(knobs, &[name], &spots, chance),
    }
}

/// The spot that was meant, or one that is as close to the first as can still be told apart.
fn second_place(knobs: &Knobs, spots: &[Point], first: usize, second: usize, chance: &mut Chance) -> Point {
    if !chance.happens(0.25) {
        return spots[second];
    }
    let near = knobs.separation * chance.within((1.05, 1.5));
    let is_other = |&index: &usize| index != first && index != second;
    let others: Vec<Point> = (0..spots.len()).filter(is_other).map(|index| spots[index]).collect();
    beside(spots[first], near, &others)
}

/// Pairs of which the first must be placed before the second, without a cycle.
fn random_constraints(count: usize, chance: &mut Chance) -> Vec<(usize, usize)> {
    let ranking = random_word(count, &[], chance);
    let probability = chance.within((0.0, 0.6));
    let mut before = Vec::new();
    for later in 1..count {
        for earlier in 0..later {
            if chance.happens(probability) {
                before.push((ranking[earlier], ranking[later]));
            }
        }
    }
    before
}

/// Up to six words of all places; in one task of seven the last word stops short of its last place.
fn draw_orders(knobs: &Knobs, count: usize, before: &[(usize, usize)], chance: &mut Chance) -> Vec<Order> {
    let wanted = chance.whole(1, 6).min(knobs.demonstrations / 2);
    let mut orders = random_orders(wanted, |chance| random_word(count, before, chance), chance);
    let last = orders.len() - 1;
    if last > 0 && count > 2 && chance.happens(0.15) {
        orders[last].word.pop();
    }
    orders
}

fn objects(knobs: &Knobs, names: &[&str], spots: &[Point], chance: &mut Chance) -> Vec<Object> {
    let reach = knobs.scale * chance.within((0.01, 0.08));
    let start_reach = if knobs.starts_vary { reach } else { 0.0 };
    let object = |(name, &start): (&&str, &Point)| Object { name: (*name).to_owned(), start, start_reach };
    names.iter().zip(spots).map(object).collect()
}

fn site(names: &[&str], object: usize, number: usize, center: Point) -> Site {
    Site { name: format!("{} {number}", names[object]), object, center }
}
