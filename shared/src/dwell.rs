//! Where a thing stays still: dwells in the track of a feature subset.

mod classes;
mod length;
mod running_median;
mod scales;
mod wild;

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::points::{Track, distance, median_of, median_point, squared_distance};
pub use length::{Speeds, min_dwell, min_dwell_by};
use running_median::RunningMedian;
pub use scales::{Scales, Tally, scales, scales_of};
pub use wild::wild_detections;

/// A stretch of a track in which the partial state stays at one place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dwell {
    /// Positions in the track of the first observed frame and of the one after the last.
    pub span: Range<usize>,
    /// Median of its partial states.
    pub center: Vec<f64>,
}

/// Where a track starts: the median of its first three observed frames, so that one wild detection does not count.
/// Empty for an empty track.
pub fn start_point(track: &Track) -> Vec<f64> {
    if track.is_empty() {
        return Vec::new();
    }
    median_point(track.points.dimension(), &track.points.iter().take(3))
}

/// How many frames in a row may be wild detections without ending a dwell.
const WILD_FRAMES: usize = 2;

/// A passage at constant speed through the whole ball drifts by its radius; a dwell drifts by less than this share of it.
const DRIFT: f64 = 0.6;

/// The dwells of a track in the order of time: stretches of at least `min_dwell` observed frames within
/// [`Scales::stillness`] of their center that drift less than a slow passage through that ball would.
///
/// Single wild detections do not interrupt a dwell; neighboring stretches at one place are one dwell.
///
/// # Complexity
///
/// O(frames x features x log(frames)) where things rest or move on. A dwell is grown frame by frame from its first, so
/// each frame of a stretch that is near its mean, but drifts, costs the length of that stretch.
pub fn dwells(track: &Track, scales: Scales, min_dwell: usize) -> Vec<Dwell> {
    let mut dwells: Vec<Dwell> = Vec::new();
    let mut joined = Joined::default();
    let (mut mean, mut column) = (Vec::new(), Vec::new());
    let mut start = 0;
    while start < track.len() {
        let span = start..grow(track, start, scales.stillness, &mut mean);
        if span.len() < min_dwell.max(1) || drifts(track, &span, scales, &mut column) {
            start += 1;
            continue;
        }
        start = span.end;
        let center = center(track, span.clone(), &mut column);
        let here = dwells
            .last_mut()
            .filter(|last| squared_distance(&last.center, &center) <= scales.stillness * scales.stillness);
        if let Some(last) = here {
            joined.lengthen(last, track, span.end);
        } else {
            joined = Joined::default();
            dwells.push(Dwell { span, center });
        }
    }
    dwells
}

/// The end of the stretch that starts at `start` and stays within `stillness` of its running mean, for which `mean` is
/// the memory.
fn grow(track: &Track, start: usize, stillness: f64, mean: &mut Vec<f64>) -> usize {
    mean.clear();
    mean.extend_from_slice(track.points.point(start));
    let mut count = 1.0;
    let mut end = start + 1;
    while let Some(next) = (end..track.len().min(end + WILD_FRAMES + 1))
        .find(|&index| squared_distance(track.points.point(index), mean).sqrt() <= stillness)
    {
        count += 1.0;
        for (mean, x) in mean.iter_mut().zip(track.points.point(next)) {
            *mean += (x - *mean) / count;
        }
        end = next + 1;
    }
    end
}

/// Whether the first half of `span` is at another place than the second.
fn drifts(track: &Track, span: &Range<usize>, scales: Scales, column: &mut Vec<f64>) -> bool {
    if span.len() < 2 {
        return false;
    }
    let middle = span.start + span.len() / 2;
    let [from, to] = [span.start..middle, middle..span.end].map(|half| center(track, half, column));
    distance(&from, &to) > DRIFT * scales.stillness
}

/// The median of the partial states in `span`; `column` is the memory for one of their coordinates.
fn center(track: &Track, span: Range<usize>, column: &mut Vec<f64>) -> Vec<f64> {
    let dimension = track.points.dimension();
    let rows = &track.points.coordinates()[span.start * dimension..span.end * dimension];
    let median = |axis: usize| {
        column.clear();
        column.extend(rows.iter().skip(axis).step_by(dimension));
        median_of(column)
    };
    (0..dimension).map(median).collect()
}

/// The partial states of a dwell that was lengthened: a thing may come back to a place again and again.
#[derive(Default)]
struct Joined {
    /// One per feature; none before the dwell is lengthened.
    medians: Vec<RunningMedian>,
}

impl Joined {
    /// Lengthens `dwell` to `end`.
    fn lengthen(&mut self, dwell: &mut Dwell, track: &Track, end: usize) {
        let mut added = dwell.span.end..end;
        if self.medians.is_empty() {
            self.medians = vec![RunningMedian::default(); track.points.dimension()];
            added.start = dwell.span.start;
        }
        for point in added.map(|index| track.points.point(index)) {
            self.medians.iter_mut().zip(point).for_each(|(median, &x)| median.add(x));
        }
        dwell.span.end = end;
        dwell.center = self.medians.iter().map(RunningMedian::median).collect();
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::Points;

    pub(super) const SCALES: Scales = Scales { noise: 0.001, travel: 1.0, stillness: 0.01 };

    pub(super) fn track(x: &[f64]) -> Track {
        Track::observed_throughout(Points::from_rows(1, x.to_vec()))
    }

    /// Start and end of each dwell.
    fn spans(x: &[f64], min_dwell: usize) -> Vec<[usize; 2]> {
        dwells(&track(x), SCALES, min_dwell).into_iter().map(|it| [it.span.start, it.span.end]).collect()
    }

    #[test]
    fn stretches_at_one_place_are_dwells() {
        let x = [0.0, 0.001, 0.0, 0.3, 0.6, 1.0, 1.001, 1.0, 0.999];
        assert_eq!(spans(&x, 3), [[0, 3], [5, 9]]);
        assert_eq!(spans(&x, 4), [[5, 9]]);
        assert_eq!(spans(&[], 3), [[0; 2]; 0]);
    }

    #[test]
    fn a_slow_passage_is_no_dwell() {
        let x: Vec<f64> = (0..40).map(|index| 0.004 * f64::from(index)).collect();
        assert_eq!(spans(&x, 4), [[0; 2]; 0]);
    }

    #[test]
    fn a_wild_detection_does_not_end_a_dwell() {
        assert_eq!(spans(&[0.0, 0.0, 0.0, 0.7, 0.0, 0.0, 0.0], 3), [[0, 7]]);
    }

    #[test]
    fn the_start_does_not_count_one_wild_detection() {
        assert_eq!(start_point(&track(&[0.0, 7.0, 0.0, 1.0])), [0.0]);
    }

    /// The definition, word for word: every center is the median of all that it is the center of.
    fn dwells_by_definition(track: &Track, scales: Scales, min_dwell: usize) -> Vec<Dwell> {
        let center = |span: Range<usize>| {
            median_point(track.points.dimension(), &span.map(|index| track.points.point(index)))
        };
        let mut dwells: Vec<Dwell> = Vec::new();
        let mut start = 0;
        while start < track.len() {
            let span = start..grow(track, start, scales.stillness, &mut Vec::new());
            let middle = span.start + span.len() / 2;
            let drift = distance(&center(span.start..middle), &center(middle..span.end));
            start += 1;
            if span.len() >= min_dwell && (span.len() < 2 || drift <= 0.6 * scales.stillness) {
                start = span.end;
                let here = center(span.clone());
                match dwells.last_mut() {
                    Some(last) if squared_distance(&last.center, &here) <= scales.stillness.powi(2) => {
                        last.span.end = span.end;
                        last.center = center(last.span.clone());
                    }
                    _ => dwells.push(Dwell { span, center: here }),
                }
            }
        }
        dwells
    }

    proptest! {
        #[test]
        fn dwells_are_those_of_the_definition(
            stretches in prop::collection::vec(
                (prop_oneof![3 => Just(0.0), 3 => Just(0.012), 1 => -1.0..1.0], -0.004..0.004, 1..12_usize),
                0..12,
            ),
            shakes in prop::collection::vec(-0.006..0.006, 140),
            dimension in 1..4_usize,
            min_dwell in 1..6_usize,
        ) {
            let x = stretches.iter().flat_map(|&(x, drift, frames)| (0..frames).map(move |at| x + drift * at as f64));
            let x = x.zip(&shakes).map(|(x, shake)| x + shake).collect();
            let track = Track::observed_throughout(Points::from_rows(dimension, x));
            prop_assert_eq!(dwells(&track, SCALES, min_dwell), dwells_by_definition(&track, SCALES, min_dwell));
        }
    }
}
