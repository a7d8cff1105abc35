//! Points that are noise at a glance.

use super::grid::{Cursors, Grid, Run};

/// Drops the runs, which are sorted by their cells, of cells with fewer than `min_points` points and no cell near them:
/// what is on its way between two rests is mostly so far from everything else. Nothing that is kept is near them.
///
/// # Complexity
///
/// O(cells), times the number of rows of cells around one.
pub(super) fn without_strays(grid: &Grid, mut runs: Vec<Run>, min_points: usize) -> Vec<Run> {
    let cells: Vec<(u64, usize)> = runs
        .chunk_by(|a, b| a.key == b.key)
        .map(|runs| (runs[0].key, runs.iter().map(Run::len).sum()))
        .collect();
    let keys: Vec<u64> = cells.iter().map(|cell| cell.0).collect();
    let mut is_kept: Vec<bool> = cells.iter().map(|cell| cell.1 >= min_points).collect();
    drop(cells);
    let mut cursors = Cursors::new(grid, &keys, 0, |difference| difference <= 0);
    let mut around = Vec::new();
    for cell in 0..keys.len() {
        around.clear();
        cursors.around(cell, &mut around);
        for other in around.iter().flat_map(Clone::clone).filter(|&other| other != cell) {
            is_kept[other] = true;
            is_kept[cell] = true;
        }
    }
    let mut cell = 0;
    runs.retain(|run| {
        cell += usize::from(keys[cell] != run.key);
        is_kept[cell]
    });
    runs
}
