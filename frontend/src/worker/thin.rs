//! Recordings thinned for drawing: a screen has a few thousand pixels, whatever the recording has.

use goalgraph::demonstration::Demonstration;

use crate::protocol::{Cloud, Track};

/// How many frames of a track are enough for a wide screen.
const TRACK_FRAMES: usize = 1200;
/// How many points of a cloud are enough to see its shape.
const CLOUD_POINTS: usize = 4000;

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
}
