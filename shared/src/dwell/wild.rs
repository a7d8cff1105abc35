//! Single frames in which a thing was seen where it is not.

use super::Scales;
use crate::points::{Track, squared_distance};

/// How many neighboring frames are looked at.
const WINDOW: usize = 5;

/// The positions in `track` at which the thing was seen far from where it was shortly before and after, ascending.
///
/// A frame is wild when it is far from the median of the five around it, compared with how far those are from it
/// (Hampel's identifier, 1974).
///
/// # Complexity
///
/// O(frames x features).
pub fn wild_detections(track: &Track, scales: Scales) -> Vec<usize> {
    let mut wild = Vec::new();
    if track.len() < WINDOW {
        return wild;
    }
    let dimension = track.points.dimension();
    let near = 2.0 * scales.stillness;
    let mut center = vec![0.0; dimension];
    for index in 0..track.len() {
        let first = index.saturating_sub(WINDOW / 2).min(track.len() - WINDOW);
        let around = &track.points.coordinates()[first * dimension..(first + WINDOW) * dimension];
        for (axis, x) in center.iter_mut().enumerate() {
            *x = median_of_five(std::array::from_fn(|at| around[at * dimension + axis]));
        }
        let from_center = squared_distance(track.points.point(index), &center).sqrt();
        // Most frames are that near, whatever the spread is.
        if from_center <= near {
            continue;
        }
        let squares = |at: usize| squared_distance(&around[at * dimension..(at + 1) * dimension], &center);
        let spread = median_of_five(std::array::from_fn(squares)).sqrt();
        if from_center > 4.0 * spread + near {
            wild.push(index);
        }
    }
    wild
}

/// The middle one of five numbers, by a fixed network of comparisons.
fn median_of_five([a, b, c, d, e]: [f64; WINDOW]) -> f64 {
    let (a, b) = sorted(a, b);
    let (d, e) = sorted(d, e);
    // The least and the largest of four are not the middle of five.
    let b_or_less = sorted(b, e).0;
    let a_or_more = sorted(a, d).1;
    let (low, high) = sorted(a_or_more, b_or_less);
    sorted(low, sorted(high, c).0).1
}

fn sorted(a: f64, b: f64) -> (f64, f64) {
    if b < a { (b, a) } else { (a, b) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::tests::{SCALES, track};
    use super::*;
    use crate::points::{Points, distance, median, median_point};

    /// The definition, word for word.
    fn wild_by_definition(track: &Track, scales: Scales) -> Vec<usize> {
        let is_wild = |&index: &usize| {
            let first = index.saturating_sub(WINDOW / 2).min(track.len() - WINDOW);
            let around = (first..first + WINDOW).map(|at| track.points.point(at));
            let center = median_point(track.points.dimension(), &around);
            let spread = median(around.map(|point| distance(point, &center)).collect());
            distance(track.points.point(index), &center) > 4.0 * spread + 2.0 * scales.stillness
        };
        if track.len() < WINDOW { Vec::new() } else { (0..track.len()).filter(is_wild).collect() }
    }

    #[test]
    fn wild_detections_are_told_from_moves() {
        let x = [0.0, 0.0, 0.0, 0.7, 0.0, 0.0, 0.1, 0.2, 0.3, 0.4, 0.4, 0.4];
        assert_eq!(wild_detections(&track(&x), SCALES), [3]);
        assert_eq!(wild_detections(&track(&x[..4]), SCALES), [0; 0]);
    }

    #[test]
    fn the_median_of_five_is_the_middle_one_in_every_order() {
        let mut digits = [0_u8; WINDOW];
        for number in 0..WINDOW.pow(WINDOW as u32) {
            let mut rest = number;
            for digit in &mut digits {
                (*digit, rest) = ((rest % WINDOW) as u8, rest / WINDOW);
            }
            let mut sorted = digits;
            sorted.sort_unstable();
            let median = median_of_five(digits.map(f64::from));
            assert_eq!(median.to_bits(), f64::from(sorted[2]).to_bits(), "{digits:?}");
        }
    }

    proptest! {
        #[test]
        fn wild_detections_are_those_of_the_definition(
            x in prop::collection::vec(prop_oneof![4 => Just(0.0), 4 => -0.02..0.02, 1 => -1.0..1.0], 0..60),
            dimension in 1..4_usize,
        ) {
            let track = Track::observed_throughout(Points::from_rows(dimension, x));
            prop_assert_eq!(wild_detections(&track, SCALES), wild_by_definition(&track, SCALES));
        }
    }
}
