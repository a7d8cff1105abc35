//! Recordings thinned for drawing: a screen has a few thousand pixels, whatever the recording has.

use std::cmp::Reverse;

use goalgraph::demonstration::Demonstration;
use goalgraph::points::Points;

use crate::protocol::{Cloud, KDistanceCurve, Track};

/// How many frames of a track are enough for a wide screen.
const TRACK_FRAMES: usize = 1200;
/// How many points of a cloud are enough to see its shape.
const CLOUD_POINTS: usize = 4000;
/// How many values of a curve are enough for its width on the screen.
const CURVE_POINTS: usize = 400;
/// How many clusters anybody can tell apart in one drawing.
const DRAWN: usize = 200;

/// The values of a demonstration at evenly spaced frames, at most [`TRACK_FRAMES`] of them.
pub(super) fn track(demonstration: &Demonstration) -> Track {
    let frames = demonstration.frames();
    let stride = frames.div_ceil(TRACK_FRAMES).max(1);
    let values =
        (0..frames).step_by(stride).flat_map(|frame| demonstration.frame(frame).iter().map(drawn)).collect();
    Track { frames, stride, features: demonstration.features().len(), values }
}

fn drawn(value: &f64) -> Option<f32> {
    (!value.is_nan()).then_some(*value as f32)
}

/// Observed partial states of the subset called `subset`, at most about [`CLOUD_POINTS`] of them, evenly spaced in time.
pub(super) fn cloud(demonstrations: &[Demonstration], subset: &str, features: &[String]) -> Cloud {
    let frames: usize = demonstrations.iter().map(Demonstration::frames).sum();
    let stride = frames.div_ceil(CLOUD_POINTS).max(1);
    let mut coordinates = Vec::new();
    for demonstration in demonstrations {
        let columns: Vec<usize> =
            features.iter().filter_map(|name| demonstration.feature_index(name)).collect();
        for frame in (0..demonstration.frames()).step_by(stride) {
            let values = demonstration.frame(frame);
            if columns.iter().all(|&column| !values[column].is_nan()) {
                coordinates.extend(columns.iter().map(|&column| values[column] as f32));
            }
        }
    }
    Cloud { subset: subset.to_owned(), dimensions: features.len(), coordinates }
}

/// The sorted `distances` of `points`, thinned to at most [`CURVE_POINTS`] of them.
pub(super) fn curve(points: &Points, distances: &[f64]) -> KDistanceCurve {
    let last = distances.len().saturating_sub(1);
    let kept = distances.len().min(CURVE_POINTS);
    // Text has no infinity; and whoever reads the curve wants no more than a number beyond all others.
    let distances =
        (0..kept).map(|number| distances[number * last / (kept - 1).max(1)].min(f64::MAX)).collect();
    KDistanceCurve { distances, points: points.len(), extent: extent(points).min(f64::MAX) }
}

/// The diagonal of the box around `points`.
fn extent(points: &Points) -> f64 {
    let side = |axis: usize| {
        let coordinates = points.iter().map(|point| point[axis]);
        let (low, high) =
            coordinates.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (x.min(low), x.max(high)));
        (high - low).max(0.0)
    };
    (0..points.dimension()).map(side).map(|side| side * side).sum::<f64>().sqrt()
}

/// The [`DRAWN`] items that `size` says are largest, in the order that they have.
pub(super) fn largest<T>(items: Vec<T>, size: impl Fn(&T) -> usize) -> Vec<T> {
    let mut ranked: Vec<(usize, T)> = items.into_iter().enumerate().collect();
    ranked.sort_by_key(|(_, item)| Reverse(size(item)));
    ranked.truncate(DRAWN);
    ranked.sort_by_key(|(place, _)| *place);
    ranked.into_iter().map(|(_, item)| item).collect()
}

#[cfg(test)]
mod tests {
    use goalgraph::demonstration::Feature;

    use super::*;

    fn recording(frames: usize) -> Demonstration {
        let features = ["x", "y"].map(Feature::new).into_iter().collect();
        let values = (0..frames * 2).map(|value| if value == 2 { f64::NAN } else { value as f64 }).collect();
        Demonstration::new("a", "", features, values).unwrap()
    }

    #[test]
    fn a_short_track_is_whole_and_undefined_values_are_gaps() {
        let track = track(&recording(3));
        assert_eq!((track.frames, track.stride), (3, 1));
        assert_eq!(track.values, [Some(0.0), Some(1.0), None, Some(3.0), Some(4.0), Some(5.0)]);
    }

    #[test]
    fn a_long_track_is_thinned() {
        let track = track(&recording(10_000));
        assert_eq!(track.stride, 9);
        assert!(track.values.len() <= 2 * TRACK_FRAMES);
    }

    #[test]
    fn a_cloud_leaves_out_what_was_not_observed() {
        let cloud = cloud(&[recording(3)], "all", &["x".to_owned(), "y".to_owned()]);
        assert_eq!(cloud.coordinates, [0.0, 1.0, 4.0, 5.0]);
    }

    #[test]
    fn a_long_curve_keeps_its_ends() {
        let distances: Vec<f64> = (0..1000).map(f64::from).collect();
        let points = Points::from_rows(2, vec![0.0, 0.0, 3.0, 4.0]);
        let curve = curve(&points, &distances);
        assert_eq!((curve.distances.len(), curve.points, curve.extent), (CURVE_POINTS, 2, 5.0));
        assert_eq!((curve.distances[0], curve.distances[CURVE_POINTS - 1]), (0.0, 999.0));
    }

    #[test]
    fn of_very_many_clusters_the_largest_stay_in_their_order() {
        let sizes: Vec<usize> = (0..1000).map(|number| number * 7 % 1000).collect();
        let kept = largest(sizes, |&size| size);
        assert_eq!((kept.len(), kept[0], kept[1]), (DRAWN, 805, 812));
    }
}
