//! What things are called.

use crate::chance::Chance;

const FAMILIES: [[&str; 5]; 4] = [
    ["red", "yellow", "green", "blue", "white"],
    ["cup", "plate", "bowl", "spoon", "jar"],
    ["gear", "shaft", "bearing", "lid", "base_plate"],
    ["block_1", "block_2", "block_3", "block_4", "block_5"],
];

/// Up to five names of one family.
pub(crate) fn objects(count: usize, chance: &mut Chance) -> Vec<&'static str> {
    let family = chance.pick(&FAMILIES);
    family.into_iter().take(count).collect()
}
