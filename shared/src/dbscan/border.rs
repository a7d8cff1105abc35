//! Which points are border points, and of which cluster.

use std::ops::Range;

use super::bounds::Bounds;
use super::cells::{Cells, Members, Neighborhood};
use super::core_points::{PIECE, piece};
use super::rows::Space;
use super::tree::{NodeId, Parts};
use crate::parallel;

/// The border points: each row that is no core point but within epsilon of one, with the cell of the nearest; ties go to
/// the core point that is earlier in the input.
///
/// # Complexity
///
/// Each point that is no core point is compared with the core points in the cells around it, of heaps with what is nearest.
pub(super) fn border_points<S: Space>(cells: &Cells<S>, core: &[bool]) -> Vec<(u32, u32)> {
    parallel::map(cells.len().div_ceil(PIECE), |number| border_points_in(cells, core, number)).concat()
}

fn border_points_in<S: Space>(cells: &Cells<S>, core: &[bool], number: usize) -> Vec<(u32, u32)> {
    let mut neighborhood = Neighborhood::new(cells, number * PIECE);
    let mut border = Vec::new();
    for cell in piece(cells, number) {
        let range = cells.range(cell);
        if cells.is_dense(cell) || !core[range.clone()].contains(&false) {
            continue;
        }
        let around = neighborhood.members(cell);
        for at in range.filter(|&at| !core[at]) {
            border.extend(cell_of_nearest(cells, core, around, at).map(|cell| (at as u32, cell as u32)));
        }
    }
    border
}

/// The cell of the core point that is nearest to the row at `at`, if one is within epsilon.
fn cell_of_nearest<S: Space>(
    cells: &Cells<S>,
    core: &[bool],
    around: &[Members],
    at: usize,
) -> Option<usize> {
    let point = cells.rows().row(at);
    let mut nearest = Nearest { cells, core, point, squared: cells.squared_epsilon(), at: None };
    for members in around {
        match members {
            Members::Few(range) => nearest.look_at(range.clone()),
            Members::Heap(root) => nearest.look_into(*root),
        }
    }
    nearest.at.map(|at| cells.cell_at(at))
}

/// The nearest core point so far.
struct Nearest<'a, S> {
    cells: &'a Cells<S>,
    core: &'a [bool],
    point: &'a [f64],
    squared: f64,
    /// Its row, once there is one.
    at: Option<usize>,
}

impl<S: Space> Nearest<'_, S> {
    /// Looks whether a nearer one is among these rows.
    fn look_at(&mut self, range: Range<usize>) {
        let rows = self.cells.rows();
        for at in range.filter(|&at| self.core[at]) {
            let squared = rows.squared_distance(at, self.point);
            let is_earlier = || self.at.is_none_or(|known| rows.input(at) < rows.input(known));
            if squared < self.squared || (squared <= self.squared && is_earlier()) {
                (self.squared, self.at) = (squared, Some(at));
            }
        }
    }

    /// Looks whether a nearer one is in this tree.
    fn look_into(&mut self, node: NodeId) {
        let heaps = self.cells.heaps();
        if heaps.bounds(node).nearest(&Bounds::of_point(self.point)) <= self.squared {
            match heaps.parts(node) {
                Parts::Leaf(range) => self.look_at(range),
                Parts::Both(first, second) => {
                    self.look_into(first);
                    self.look_into(second);
                }
            }
        }
    }
}
