//! Points that are noise at a glance.

use super::grid::{Cursors, Grid, Run};

/// Drops the runs, which are sorted by their cells, of cells with fewer than `min_points` points and no cell near them:
/// what is on its way between two rests is mostly so far from everything else. Nothing that is kept is near them.
///
/// # Complexity
///
/// O(cells), times the number of rows of cells around one, and pairs of cells near each other.
pub(super) fn without_strays(grid: &Grid, mut runs: Vec<Run>, min_points: usize) -> Vec<Run> {
    let cells = || runs.chunk_by(|a, b| a.key == b.key);
    let keys: Vec<u64> = cells().map(|runs| runs[0].key).collect();
    let is_dense = |runs: &[Run]| runs.iter().map(Run::len).sum::<usize>() >= min_points;
    let mut is_kept: Vec<bool> = cells().map(is_dense).collect();
    mark_neighbors(grid, &keys, &mut is_kept);
    let mut cell = 0;
    runs.retain(|run| {
        cell += usize::from(keys[cell] != run.key);
        is_kept[cell]
    });
    runs
}

/// Marks the cells that have another one near them.
fn mark_neighbors(grid: &Grid, keys: &[u64], marks: &mut [bool]) {
    let mut cursors = Cursors::new(grid, keys, 0, |difference| difference <= 0);
    let mut around = Vec::new();
    for cell in 0..keys.len() {
        around.clear();
        cursors.around(cell, &mut around);
        for other in around.iter().flat_map(Clone::clone).filter(|&other| other != cell) {
            marks[other] = true;
            marks[cell] = true;
        }
    }
}
