//! Several blocks, each with one place.

use super::{object, on_the_table, order, site};
use crate::layout::Order;
use crate::layout::{Layout, Object};
use crate::orders::permutations;
use crate::task::Task;

/// Red and yellow side by side in either order, two demonstrations in three red first; green across them last.
///
/// Three places, two distinct words from two demonstrations on, subsets `red`, `yellow` and `green`; in metres.
pub fn tower(seed: u64, demonstrations: usize) -> Task {
    let layout = Layout {
        objects: waiting(&["red", "yellow", "green"]),
        sites: vec![
            site("red left", 0, [0.40, -0.03, 0.02]),
            site("yellow right", 1, [0.40, 0.03, 0.02]),
            site("green top", 2, [0.40, 0.0, 0.06]),
        ],
        orders: vec![order(2, &[0, 1, 2]), order(1, &[1, 0, 2])],
    };
    on_the_table("tower", layout, demonstrations).record(seed)
}

/// Two stacks of two: yellow on red, blue on green; each bottom before its top.
///
/// Four places and, from six demonstrations on, all six possible words. Most often yellow comes second: red, yellow,
/// green, blue. In metres.
pub fn two_stacks(seed: u64, demonstrations: usize) -> Task {
    let layout = Layout {
        objects: waiting(&["red", "yellow", "green", "blue"]),
        sites: vec![
            site("red bottom", 0, [0.42, -0.12, 0.02]),
            site("yellow top", 1, [0.42, -0.12, 0.06]),
            site("green bottom", 2, [0.42, 0.12, 0.02]),
            site("blue top", 3, [0.42, 0.12, 0.06]),
        ],
        orders: vec![
            order(7, &[0, 1, 2, 3]),
            order(3, &[0, 2, 1, 3]),
            order(2, &[0, 2, 3, 1]),
            order(2, &[2, 3, 0, 1]),
            order(2, &[2, 0, 1, 3]),
            order(2, &[2, 0, 3, 1]),
        ],
    };
    on_the_table("two-stacks", layout, demonstrations).record(seed)
}

/// Four blocks, each to a place of its own, in any order.
///
/// With 24 demonstrations each of the 24 words is there once; with more, some are preferred. In metres.
pub fn four_blocks(seed: u64, demonstrations: usize) -> Task {
    let words = permutations(4).into_iter().enumerate();
    let orders = words.map(|(rank, word)| Order { word, preference: 24 - rank });
    let layout = Layout {
        objects: waiting(&["red", "yellow", "green", "blue"]),
        sites: vec![
            site("red place", 0, [0.38, -0.18, 0.02]),
            site("yellow place", 1, [0.46, -0.06, 0.02]),
            site("green place", 2, [0.38, 0.06, 0.02]),
            site("blue place", 3, [0.46, 0.18, 0.02]),
        ],
        orders: orders.collect(),
    };
    on_the_table("four-blocks", layout, demonstrations).record(seed)
}

/// Blocks in a row near the demonstrator, each somewhere in a square of 8 cm.
fn waiting(names: &[&str]) -> Vec<Object> {
    let row = names.iter().enumerate();
    row.map(|(index, name)| object(name, [0.08, -0.21 + 0.14 * index as f64, 0.02], 0.04)).collect()
}
