//! Which cells are in one cluster.

use super::bounds::Bounds;
use super::cells::{Cells, Members, Neighborhood};
use super::components::Components;
use super::core_points::{PIECE, piece};
use super::rows::Space;
use super::tree::{NodeId, Parts};
use crate::parallel;

/// Joins the cells that have core points within epsilon of each other.
///
/// # Complexity
///
/// O(cells) pairs of cells, of which those that are joined already are not compared. A comparison ends with the first
/// pair of points that is near enough; of two heaps only what lies between them is compared.
pub(super) fn join<S: Space>(cells: &Cells<S>, core: &[bool]) -> Components {
    let components = Components::new(cells.len());
    parallel::map(cells.len().div_ceil(PIECE), |number| join_piece(cells, core, &components, number));
    components
}

fn join_piece<S: Space>(cells: &Cells<S>, core: &[bool], components: &Components, number: usize) {
    let mut neighborhood = Neighborhood::before(cells, number * PIECE);
    for cell in piece(cells, number).filter(|&cell| core[cells.range(cell)].contains(&true)) {
        let mut component = components.find(cell);
        for other in neighborhood.cells(cell).iter().flat_map(|range| range.start..range.end.min(cell)) {
            if components.find(other) != component && touch(cells, core, cell, other) {
                components.join(cell, other);
                component = components.find(cell);
            }
        }
    }
}

/// Whether a core point of `cell` is within epsilon of one of `other`.
fn touch<S: Space>(cells: &Cells<S>, core: &[bool], cell: usize, other: usize) -> bool {
    let pair = Pair { cells, core, all_core: cells.is_dense(cell) && cells.is_dense(other) };
    match (cells.members(cell), cells.members(other)) {
        (Members::Heap(heap), Members::Heap(other)) => pair.heaps_touch(heap, other),
        (Members::Heap(heap), Members::Few(mut few)) | (Members::Few(mut few), Members::Heap(heap)) => {
            few.any(|at| core[at] && pair.heap_touches(heap, at))
        }
        (Members::Few(mut few), Members::Few(others)) => {
            few.any(|at| core[at] && others.clone().any(|other| pair.are_near(at, other)))
        }
    }
}

/// Two cells that are compared.
struct Pair<'a, S> {
    cells: &'a Cells<S>,
    core: &'a [bool],
    /// Whether neither has a point that is no core point.
    all_core: bool,
}

impl<S: Space> Pair<'_, S> {
    /// Whether `other` is a core point within epsilon of `at`.
    fn are_near(&self, at: usize, other: usize) -> bool {
        let rows = self.cells.rows();
        self.core[other] && rows.squared_distance(other, rows.row(at)) <= self.cells.squared_epsilon()
    }

    /// What the boxes around core points say on whether two of them are near, if they say it.
    fn verdict(&self, bounds: &Bounds, other: &Bounds) -> Option<bool> {
        if bounds.nearest(other) > self.cells.squared_epsilon() {
            return Some(false);
        }
        (self.all_core && bounds.farthest(other) <= self.cells.squared_epsilon()).then_some(true)
    }

    /// Whether a core point of `heap` is within epsilon of the row at `at`.
    fn heap_touches(&self, heap: NodeId, at: usize) -> bool {
        let heaps = self.cells.heaps();
        let point = Bounds::of_point(self.cells.rows().row(at));
        self.verdict(&heaps.bounds(heap), &point).unwrap_or_else(|| match heaps.parts(heap) {
            Parts::Leaf(mut range) => range.any(|other| self.are_near(at, other)),
            Parts::Both(first, second) => self.heap_touches(first, at) || self.heap_touches(second, at),
        })
    }

    /// Whether core points of two heaps are within epsilon of each other; the larger one is halved.
    fn heaps_touch(&self, heap: NodeId, other: NodeId) -> bool {
        let heaps = self.cells.heaps();
        let verdict = self.verdict(&heaps.bounds(heap), &heaps.bounds(other));
        verdict.unwrap_or_else(|| match (heaps.parts(heap), heaps.parts(other)) {
            (Parts::Leaf(mut range), _) => range.any(|at| self.core[at] && self.heap_touches(other, at)),
            (_, Parts::Leaf(mut range)) => range.any(|at| self.core[at] && self.heap_touches(heap, at)),
            (Parts::Both(first, second), _) if heaps.range(heap).len() >= heaps.range(other).len() => {
                self.heaps_touch(first, other) || self.heaps_touch(second, other)
            }
            (_, Parts::Both(first, second)) => {
                self.heaps_touch(heap, first) || self.heaps_touch(heap, second)
            }
        })
    }
}
