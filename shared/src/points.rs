//! Points in the space of a feature subset.

use nalgebra::DVectorView;
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

    /// The coordinates of all points in row-major order.
    pub fn coordinates(&self) -> &[f64] {
        &self.coordinates
    }

    /// Adds a point; `point` has `dimension` coordinates.
    pub fn push(&mut self, point: &[f64]) {
        debug_assert_eq!(point.len(), self.dimension);
        self.coordinates.extend_from_slice(point);
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
    let mut mean = vec![0.0; dimension];
    let mut count = 0_usize;
    for point in points {
        for (sum, x) in mean.iter_mut().zip(point) {
            *sum += x;
        }
        count += 1;
    }
    mean.into_iter().map(|sum| sum / count.max(1) as f64).collect()
}

/// Median of points, coordinate by coordinate; the origin when there are none.
pub fn median_point<'a>(dimension: usize, points: &(impl Iterator<Item = &'a [f64]> + Clone)) -> Vec<f64> {
    (0..dimension).map(|axis| median(points.clone().map(|point| point[axis]).collect())).collect()
}

/// Median of `values` (the mean of the middle two when their number is even); zero when there are none.
pub fn median(mut values: Vec<f64>) -> f64 {
    median_of(&mut values)
}

/// The [`median`] of `values` whose order does not matter, which it changes.
pub fn median_of(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let count = values.len();
    let (below, &mut upper, _) = values.select_nth_unstable_by(count / 2, f64::total_cmp);
    if count.is_multiple_of(2) {
        let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        return f64::midpoint(lower, upper);
    }
    upper
}

/// The `share` quantile (0 to 1) of `values`, the next value below; zero when there are none.
pub fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let rank = quantile_rank(values.len(), share);
    *values.select_nth_unstable_by(rank, f64::total_cmp).1
}

/// The position of the `share` quantile among `count` sorted values, of which there is at least one.
pub fn quantile_rank(count: usize, share: f64) -> usize {
    ((count - 1) as f64 * share.clamp(0.0, 1.0)) as usize
}

/// What one demonstration shows of one feature subset: the frames in which every feature of the subset is defined.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Track {
    len: usize,
    /// Indices of the frames, ascending; none when they are those from 0 to `len`.
    frames: Vec<u32>,
    /// The partial state in each of those frames.
    pub points: Points,
}

impl Track {
    /// The partial states of `demonstration` in the features at `columns`, frames with an undefined value left out.
    ///
    /// Memory: the values of the columns, and 4 bytes per frame once one is left out.
    ///
    /// # Panics
    ///
    /// When there are more than 2³² frames and one is left out.
    ///
    /// # Complexity
    ///
    /// O(frames x columns).
    pub fn new(demonstration: &Demonstration, columns: &[usize]) -> Self {
        let mut track = Self { points: Points::new(columns.len()), ..Self::default() };
        track.points.coordinates.reserve_exact(demonstration.frames() * columns.len());
        let neighbors = columns.windows(2).all(|pair| pair[1] == pair[0] + 1);
        let block = columns.first().filter(|_| neighbors).map(|&first| first..first + columns.len());
        let mut gathered = vec![0.0; columns.len()];
        for index in 0..demonstration.frames() {
            let frame = demonstration.frame(index);
            let point = if let Some(block) = &block {
                &frame[block.clone()]
            } else {
                gathered.iter_mut().zip(columns).for_each(|(x, &column)| *x = frame[column]);
                &gathered
            };
            if point.iter().all(|x| !x.is_nan()) {
                track.push(index, point);
            }
        }
        track
    }

    /// A track of which every frame was observed.
    pub fn observed_throughout(points: Points) -> Self {
        Self { len: points.len(), frames: Vec::new(), points }
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
        if self.frames.is_empty() && frame != self.len {
            self.frames = (0..self.len).map(compact).collect();
            self.frames.push(compact(frame));
        } else if !self.frames.is_empty() {
            self.frames.push(compact(frame));
        }
        self.points.push(point);
        self.len += 1;
    }

    /// The track without the observations at `positions`, which are ascending and below [`Track::len`].
    ///
    /// # Complexity
    ///
    /// O(frames x features), nothing when there are no positions.
    #[must_use]
    pub fn without(mut self, positions: &[usize]) -> Self {
        let Some(&first) = positions.first() else {
            return self;
        };
        if self.frames.is_empty() {
            self.frames = (0..self.len).map(compact).collect();
        }
        let dimension = self.points.dimension;
        let mut kept = first;
        let ends = positions[1..].iter().copied().chain([self.len]);
        for (&left_out, end) in positions.iter().zip(ends) {
            let span = left_out + 1..end;
            let count = span.len();
            self.points
                .coordinates
                .copy_within(span.start * dimension..span.end * dimension, kept * dimension);
            self.frames.copy_within(span, kept);
            kept += count;
        }
        self.points.coordinates.truncate(kept * dimension);
        self.frames.truncate(kept);
        self.len = kept;
        if self.frames.last().is_none_or(|&last| last as usize + 1 == kept) {
            self.frames = Vec::new();
        }
        self
    }

    /// The index of the frame of the observation at `position`, which is below [`Track::len`].
    pub fn frame(&self, position: usize) -> usize {
        debug_assert!(position < self.len);
        self.frames.get(position).map_or(position, |&frame| frame as usize)
    }

    /// How many frames were observed.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether no frame was observed.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }
}

/// A frame's index in half the memory.
fn compact(frame: usize) -> u32 {
    u32::try_from(frame)
        .unwrap_or_else(|_| panic!("frame {frame} is beyond the 2³² that a track can tell apart"))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use proptest::prelude::*;

    use super::*;
    use crate::demonstration::Feature;

    fn track(values: Vec<f64>, columns: &[usize]) -> Track {
        let features: Arc<[Feature]> = ["x", "y", "z"].map(Feature::new).into();
        Track::new(&Demonstration::new("a", "", features, values).unwrap(), columns)
    }

    fn frames(track: &Track) -> Vec<usize> {
        (0..track.len()).map(|position| track.frame(position)).collect()
    }

    #[test]
    fn a_track_has_the_frames_in_which_all_its_features_are_defined() {
        let values = vec![0.0, 1.0, 2.0, 10.0, f64::NAN, 12.0, 20.0, 21.0, 22.0];
        let whole = track(values.clone(), &[2, 0]);
        assert_eq!(
            (frames(&whole), whole.points.coordinates()),
            (vec![0, 1, 2], &[2.0, 0.0, 12.0, 10.0, 22.0, 20.0][..])
        );
        let part = track(values, &[0, 1]);
        assert_eq!((frames(&part), part.points.coordinates()), (vec![0, 2], &[0.0, 1.0, 20.0, 21.0][..]));
    }

    proptest! {
        #[test]
        fn leaving_observations_out_leaves_the_others(
            cells in prop::collection::vec(prop_oneof![5 => 0.0..1.0, 1 => Just(f64::NAN)], 3..60),
            picks in prop::collection::vec(any::<bool>(), 20),
        ) {
            let whole = track(cells[..cells.len() / 3 * 3].to_vec(), &[0, 1]);
            let out: Vec<usize> = (0..whole.len()).filter(|&position| picks[position]).collect();
            let kept: Vec<usize> = (0..whole.len()).filter(|&position| !picks[position]).collect();
            let part = whole.clone().without(&out);
            prop_assert_eq!(frames(&part), kept.iter().map(|&position| whole.frame(position)).collect::<Vec<_>>());
            let rows: Vec<&[f64]> = kept.iter().map(|&position| whole.points.point(position)).collect();
            prop_assert_eq!(part.points.coordinates(), rows.concat());
            prop_assert_eq!(part.len(), part.points.len());
        }
    }
}
