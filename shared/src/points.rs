//! Points in the space of a feature subset.

use nalgebra::{DVector, DVectorView};
use serde::{Deserialize, Serialize};

use crate::demonstration::Demonstration;

/// `len` points of `dimension` coordinates, row by row.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Points {
    dimension: usize,
    coordinates: Vec<f64>,
}

impl Points {
    /// No points yet, of `dimension` coordinates each.
    pub fn new(dimension: usize) -> Self {
        Self { dimension, coordinates: Vec::new() }
    }

    /// Points from coordinates in row-major order; an incomplete last row is left out.
    pub fn from_rows(dimension: usize, mut coordinates: Vec<f64>) -> Self {
        coordinates.truncate(coordinates.len() / dimension.max(1) * dimension);
        Self { dimension, coordinates }
    }

    /// Adds a point; `point` has `dimension` coordinates.
    pub fn push(&mut self, point: &[f64]) {
        debug_assert_eq!(point.len(), self.dimension);
        self.coordinates.extend_from_slice(point);
    }

    /// All coordinates, point by point.
    pub fn coordinates(&self) -> &[f64] {
        &self.coordinates
    }

    /// How many coordinates each point has.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.coordinates.len() / self.dimension.max(1)
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.coordinates.is_empty()
    }

    /// The point at `index`, which is below [`Points::len`].
    pub fn point(&self, index: usize) -> &[f64] {
        &self.coordinates[index * self.dimension..(index + 1) * self.dimension]
    }

    /// All points in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[f64]> + Clone {
        self.coordinates.chunks_exact(self.dimension.max(1))
    }
}

/// A point as a vector to calculate with.
pub fn vector(point: &[f64]) -> DVectorView<'_, f64> {
    DVectorView::from_slice(point, point.len())
}

/// Euclidean distance of two points of the same dimension.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    vector(a).metric_distance(&vector(b))
}

/// Square of the Euclidean distance of two points of the same dimension, without a square root: clustering asks for
/// nothing else.
pub fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum()
}

/// Mean of points, coordinate by coordinate; the origin when there are none.
pub fn mean<'a>(dimension: usize, points: impl Iterator<Item = &'a [f64]>) -> Vec<f64> {
    let mut sum = DVector::zeros(dimension);
    let mut count = 0_usize;
    for point in points {
        sum += vector(point);
        count += 1;
    }
    (sum / count.max(1) as f64).as_slice().to_vec()
}

/// Median of points, coordinate by coordinate; the origin when there are none.
pub fn median_point<'a>(dimension: usize, points: &(impl Iterator<Item = &'a [f64]> + Clone)) -> Vec<f64> {
    (0..dimension).map(|axis| median(points.clone().map(|point| point[axis]).collect())).collect()
}

/// Median of `values` (the mean of the middle two when their number is even); zero when there are none.
pub fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    let (below, upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let upper = *upper;
    if below.len() == middle && values.len().is_multiple_of(2) {
        let lower = values[..middle].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        return f64::midpoint(lower, upper);
    }
    upper
}

/// The `share` quantile (0 to 1) of `values`, the next value below; zero when there are none.
pub fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let index = ((values.len() - 1) as f64 * share.clamp(0.0, 1.0)) as usize;
    *values.select_nth_unstable_by(index, f64::total_cmp).1
}

/// What one demonstration shows of one feature subset: the frames in which every feature of the subset is defined.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Track {
    /// Indices of the frames, ascending.
    pub frames: Vec<usize>,
    /// The partial state in each of those frames.
    pub points: Points,
}

impl Track {
    /// The partial states of `demonstration` in the features at `columns`, frames with an undefined value left out.
    ///
    /// # Complexity
    ///
    /// O(frames x columns).
    pub fn new(demonstration: &Demonstration, columns: &[usize]) -> Self {
        let mut track = Self { frames: Vec::new(), points: Points::new(columns.len()) };
        let mut point = vec![0.0; columns.len()];
        for index in 0..demonstration.frames() {
            let frame = demonstration.frame(index);
            for (x, &column) in point.iter_mut().zip(columns) {
                *x = frame[column];
            }
            if point.iter().all(|x| !x.is_nan()) {
                track.frames.push(index);
                track.points.push(&point);
            }
        }
        track
    }

    /// The partial states of `demonstration` in the features that are called so; names that it does not have are left out.
    ///
    /// # Complexity
    ///
    /// O(frames x columns).
    pub fn of_features(demonstration: &Demonstration, names: &[String]) -> Self {
        let columns = names.iter().filter_map(|name| demonstration.feature_index(name));
        Self::new(demonstration, &columns.collect::<Vec<_>>())
    }

    /// A track of which no frame was observed.
    pub(crate) fn unobserved(dimension: usize) -> Self {
        Self { points: Points::new(dimension), ..Self::default() }
    }

    /// Adds an observation in `frame`, which is after all that are there.
    pub(crate) fn push(&mut self, frame: usize, point: &[f64]) {
        self.frames.push(frame);
        self.points.push(point);
    }

    /// The track without the observations at `positions`, which are ascending and below [`Track::len`].
    ///
    /// # Complexity
    ///
    /// O(frames x features), nothing when there are no positions.
    #[must_use]
    pub fn without(self, positions: &[usize]) -> Self {
        if positions.is_empty() {
            return self;
        }
        let mut kept = Self::unobserved(self.points.dimension());
        let mut left_out = positions.iter().peekable();
        for position in 0..self.len() {
            if left_out.next_if_eq(&&position).is_none() {
                kept.push(self.frame(position), self.points.point(position));
            }
        }
        kept
    }

    /// The index of the frame of the observation at `position`, which is below [`Track::len`].
    pub fn frame(&self, position: usize) -> usize {
        self.frames[position]
    }

    /// How many frames were observed.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Whether no frame was observed.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }
}
