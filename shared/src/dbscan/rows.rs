//! Points in an order of our own, and the number of their coordinates.

use std::ops::Range;

use crate::points::squared_distance;

/// How many coordinates a point has: a constant of the type where the compiler is to know it.
pub(super) trait Space: Copy + Send + Sync {
    fn dimension(self) -> usize;
}

/// `D` coordinates.
#[derive(Clone, Copy)]
pub(super) struct Fixed<const D: usize>;

/// Any number of coordinates.
#[derive(Clone, Copy)]
pub(super) struct Wide(pub(super) usize);

impl<const D: usize> Space for Fixed<D> {
    #[inline]
    fn dimension(self) -> usize {
        D
    }
}

impl Space for Wide {
    #[inline]
    fn dimension(self) -> usize {
        self.0
    }
}

/// Points row by row, and where each was in the input.
pub(super) struct Rows<S> {
    space: S,
    coordinates: Vec<f64>,
    order: Vec<u32>,
}

impl<S: Space> Rows<S> {
    /// No rows yet, with room for `capacity` of them.
    pub(super) fn with_capacity(space: S, capacity: usize) -> Self {
        let coordinates = Vec::with_capacity(capacity * space.dimension());
        Self { space, coordinates, order: Vec::with_capacity(capacity) }
    }

    /// Adds the points of the input from `start` to `end`; `input` are the coordinates of all.
    pub(super) fn extend(&mut self, input: &[f64], range: Range<u32>) {
        let dimension = self.space.dimension();
        let coordinates = range.start as usize * dimension..range.end as usize * dimension;
        self.coordinates.extend_from_slice(&input[coordinates]);
        self.order.extend(range);
    }

    pub(super) fn space(&self) -> S {
        self.space
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.order.len()
    }

    /// The row at `at`.
    #[inline]
    pub(super) fn row(&self, at: usize) -> &[f64] {
        let dimension = self.space.dimension();
        &self.coordinates[at * dimension..][..dimension]
    }

    /// The rows in `range`.
    #[inline]
    pub(super) fn rows(&self, range: Range<usize>) -> impl Iterator<Item = &[f64]> {
        let dimension = self.space.dimension();
        self.coordinates[range.start * dimension..range.end * dimension].chunks_exact(dimension)
    }

    /// Where the row at `at` was in the input.
    pub(super) fn input(&self, at: usize) -> u32 {
        self.order[at]
    }

    /// Where each row was in the input.
    pub(super) fn into_inputs(self) -> Vec<u32> {
        self.order
    }

    /// Square of the distance of the row at `at` from `point`.
    #[inline]
    pub(super) fn squared_distance(&self, at: usize, point: &[f64]) -> f64 {
        squared_distance(self.row(at), &point[..self.space.dimension()])
    }

    /// Brings those rows of `range` to its front that are at most `pivot` on `axis`; returns how many.
    pub(super) fn partition(&mut self, range: Range<usize>, axis: usize, pivot: f64) -> usize {
        let dimension = self.space.dimension();
        let (mut front, mut back) = (range.start, range.end);
        while front < back {
            if self.coordinates[front * dimension + axis] <= pivot {
                front += 1;
            } else {
                back -= 1;
                self.swap(front, back);
            }
        }
        front - range.start
    }

    fn swap(&mut self, a: usize, b: usize) {
        let dimension = self.space.dimension();
        for axis in 0..dimension {
            self.coordinates.swap(a * dimension + axis, b * dimension + axis);
        }
        self.order.swap(a, b);
    }
}
