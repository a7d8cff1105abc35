//! Which points are core points.

use std::ops::Range;

use super::cells::{Cells, Members, Neighborhood};
use super::rows::Space;
use super::tree::Ball;
use crate::parallel;

/// So many cells are one piece of work.
pub(super) const PIECE: usize = 2048;

/// For each row whether it is a core point: whether `min_points` rows, itself included, are within epsilon.
///
/// # Complexity
///
/// O(cells) where cells have `min_points` points; otherwise each point is compared with those in the cells around it, up
/// to `min_points` neighbors.
pub(super) fn core_points<S: Space>(cells: &Cells<S>) -> Vec<bool> {
    parallel::map(cells.len().div_ceil(PIECE), |piece| core_points_in(cells, piece)).concat()
}

/// The cells of a piece of work.
pub(super) fn piece<S: Space>(cells: &Cells<S>, piece: usize) -> Range<usize> {
    piece * PIECE..cells.len().min((piece + 1) * PIECE)
}

fn core_points_in<S: Space>(cells: &Cells<S>, number: usize) -> Vec<bool> {
    let mut neighborhood = Neighborhood::new(cells, number * PIECE);
    let mut core = Vec::new();
    for cell in piece(cells, number) {
        let range = cells.range(cell);
        if cells.is_dense(cell) {
            core.resize(core.len() + range.len(), true);
            continue;
        }
        let around = neighborhood.members(cell);
        core.extend(range.map(|at| is_core(cells, around, cells.rows().row(at))));
    }
    core
}

fn is_core<S: Space>(cells: &Cells<S>, around: &[Members], center: &[f64]) -> bool {
    let ball = Ball { center, squared_epsilon: cells.squared_epsilon() };
    let mut count = 0;
    for members in around {
        count += match members {
            Members::Few(range) => cells.rows().count(range.clone(), &ball),
            Members::Heap(root) => {
                cells.heaps().count(cells.rows(), *root, &ball, cells.min_points() - count)
            }
        };
        if count >= cells.min_points() {
            return true;
        }
    }
    false
}
