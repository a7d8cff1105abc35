//! Boxes around points, and how near and how far what is in them can be.
//!
//! Rounding is monotone, and the squares here are summed in the order of
//! [`squared_distance`](crate::points::squared_distance). So the bounds hold for the distances as they are calculated, to
//! the last bit: what a box decides is what its points would have decided.

/// The smallest box around some points: lowest and highest coordinate on each axis.
#[derive(Clone, Copy)]
pub(super) struct Bounds<'a> {
    pub(super) low: &'a [f64],
    pub(super) high: &'a [f64],
}

/// Lowest, then highest coordinates of at least one row.
#[inline]
pub(super) fn around<'a>(dimension: usize, mut rows: impl Iterator<Item = &'a [f64]>, bounds: &mut Vec<f64>) {
    let start = bounds.len();
    let first = rows.next().unwrap_or_default();
    bounds.extend_from_slice(first);
    bounds.extend_from_slice(first);
    let (low, high) = bounds[start..].split_at_mut(dimension);
    let high = &mut high[..dimension];
    for row in rows {
        let row = &row[..dimension];
        for axis in 0..dimension {
            low[axis] = smaller(low[axis], row[axis]);
            high[axis] = larger(high[axis], row[axis]);
        }
    }
}

impl<'a> Bounds<'a> {
    /// The box whose lowest, then highest coordinates are `bounds`.
    #[inline]
    pub(super) fn new(dimension: usize, bounds: &'a [f64]) -> Self {
        let (low, high) = bounds.split_at(dimension);
        Self { low, high: &high[..dimension] }
    }

    /// The box of one point.
    pub(super) fn of_point(point: &'a [f64]) -> Self {
        Self { low: point, high: point }
    }

    /// Square of the least distance that a point of this box can have from one of `other`.
    #[inline]
    pub(super) fn nearest(&self, other: &Bounds) -> f64 {
        let axes = self.low.iter().zip(self.high).zip(other.low.iter().zip(other.high));
        let gap = |((low, high), (other_low, other_high)): ((&f64, &f64), (&f64, &f64))| {
            larger(larger(low - other_high, other_low - high), 0.0)
        };
        axes.map(gap).map(|gap| gap * gap).sum()
    }

    /// Square of the greatest distance that a point of this box can have from one of `other`.
    #[inline]
    pub(super) fn farthest(&self, other: &Bounds) -> f64 {
        let axes = self.low.iter().zip(self.high).zip(other.low.iter().zip(other.high));
        let way = |((low, high), (other_low, other_high)): ((&f64, &f64), (&f64, &f64))| {
            larger(other_high - low, high - other_low)
        };
        axes.map(way).map(|way| way * way).sum()
    }

    /// The axis on which the box is widest, where it has any width, with the coordinate that cuts it in the middle: both
    /// sides hold something when what is at most there is told from the rest.
    pub(super) fn middle(&self) -> Option<(usize, f64)> {
        let widths = self.low.iter().zip(self.high).map(|(low, high)| high - low);
        let widest =
            widths.enumerate().fold((0, 0.0), |widest, it| if it.1 > widest.1 { it } else { widest });
        let (axis, width) = widest;
        let (low, high) = (*self.low.get(axis)?, *self.high.get(axis)?);
        let middle = f64::midpoint(low, high);
        (width > 0.0).then_some((axis, if middle < high { middle } else { low }))
    }
}

// Unlike `f64::max`, one instruction: nothing here is undefined.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
