//! The same blocks placed again and again.

use super::{object, on_the_table, order, site};
use crate::layout::Layout;
use crate::task::Task;

/// One cube that visits four places, in five orders.
///
/// One subset, `cube`; in metres. All five words are there from five demonstrations on.
pub fn four_places(seed: u64, demonstrations: usize) -> Task {
    let layout = Layout {
        objects: vec![object("cube", [0.05, 0.0, 0.02], 0.04)],
        sites: vec![
            site("near left", 0, [0.25, -0.15, 0.02]),
            site("near right", 0, [0.25, 0.15, 0.02]),
            site("far left", 0, [0.50, -0.15, 0.02]),
            site("far right", 0, [0.50, 0.15, 0.02]),
        ],
        orders: vec![
            order(6, &[0, 1, 2, 3]),
            order(4, &[0, 1, 3, 2]),
            order(3, &[1, 0, 2, 3]),
            order(3, &[3, 2, 1, 0]),
            order(2, &[2, 0, 3, 1]),
        ],
    };
    on_the_table("four-places", layout, demonstrations).record(seed)
}

/// A stack of red, yellow and green that is built anew `builds` times, each time at a further place.
///
/// Three sub-goals a time. The top block is taken first and becomes the bottom of the new stack, so that the block
/// placed last is the first to be lifted again. One word; subsets `red`, `yellow` and `green`; in metres.
pub fn rebuilt_stack(builds: usize, seed: u64, demonstrations: usize) -> Task {
    const COLORS: [&str; 3] = ["red", "yellow", "green"];
    const LEVELS: [(&str, f64); 3] = [("bottom", 0.02), ("middle", 0.06), ("top", 0.10)];
    let mut bottom_up = [0, 1, 2];
    let start = |block: usize| object(COLORS[block], [0.05, -0.20, LEVELS[block].1], 0.0);
    let objects = bottom_up.map(start).into();
    let mut sites = Vec::new();
    for build in 1..=builds {
        bottom_up.reverse();
        for (block, (level, z)) in bottom_up.into_iter().zip(LEVELS) {
            let name = format!("{} {level} {build}", COLORS[block]);
            let y = if build % 2 == 0 { -0.10 } else { 0.10 };
            sites.push(site(&name, block, [0.05 + 0.12 * build as f64, y, z]));
        }
    }
    let word: Vec<usize> = (0..sites.len()).collect();
    let layout = Layout { objects, sites, orders: vec![order(1, &word)] };
    let name = format!("rebuilt-stack-{builds}");
    on_the_table(&name, layout, demonstrations).record(seed)
}
