//! How large the ball around a cluster is, from the distances of its points to its center.

use super::arranged::Arranged;
use crate::points::{distance, quantile};

/// The share of points that the robust rule looks at: the rest may be a chain of transit points.
const BULK: f64 = 0.9;

/// The ball is this many times as large as the bulk needs, as the next demonstration will not rest on the same spot.
const MARGIN: f64 = 1.5;

/// Two balls get less than half of the way between their centers each, so that no frame is in both.
const SHARE_OF_WAY: f64 = 0.45;

/// The largest of the distances, as published.
pub(super) fn largest(distances: Vec<f64>) -> f64 {
    distances.into_iter().fold(0.0, f64::max)
}

/// What the bulk of the points needs, at least `floor`, at most `room`.
pub(super) fn robust(distances: Vec<f64>, floor: f64, room: f64) -> f64 {
    (MARGIN * quantile(distances, BULK)).max(floor).min(room)
}

/// How large the ball around each of `centers`, of `dimension` coordinates, may be beside the others; infinite when it is
/// the only one.
///
/// # Complexity
///
/// O(k log k) for k centers of few coordinates; O(k²) of many.
pub(super) fn rooms(dimension: usize, centers: &[Vec<f64>]) -> Vec<f64> {
    let arranged = Arranged::new(dimension, centers.iter().map(Vec::as_slice));
    let room = |(index, center): (usize, &Vec<f64>)| {
        let nearest = arranged.nearest_other(index, center);
        nearest.map_or(f64::INFINITY, |other| SHARE_OF_WAY * distance(center, &centers[other]))
    };
    centers.iter().enumerate().map(room).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::sub_goal::arranged::tests::points;

    /// The definition: the least of what each of the others leaves.
    fn room(centers: &[Vec<f64>], index: usize) -> f64 {
        let others = centers.iter().enumerate().filter(|&(other, _)| other != index);
        let rooms = others.map(|(_, other)| SHARE_OF_WAY * distance(&centers[index], other));
        rooms.fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn the_nearest_other_center_leaves_the_least_room(centers in points()) {
            let expected: Vec<f64> = (0..centers.len()).map(|index| room(&centers, index)).collect();
            prop_assert_eq!(rooms(centers.first().map_or(1, Vec::len), &centers), expected);
        }
    }

    #[test]
    fn one_straggler_blows_up_the_published_ball_only() {
        let distances: Vec<f64> = (0..20).map(|index| if index == 7 { 0.5 } else { 0.01 }).collect();
        assert!((largest(distances.clone()) - 0.5).abs() < 1e-12);
        assert!((robust(distances, 0.0, f64::INFINITY) - 0.015).abs() < 1e-12);
    }

    #[test]
    fn neighbors_never_share_a_frame() {
        let centers = [vec![0.0, 0.0], vec![1.0, 0.0], vec![0.0, 4.0]];
        let rooms_of_all = rooms(2, &centers);
        let radii = [0, 1, 2].map(|index| robust(vec![3.0; 5], 2.0, rooms_of_all[index]));
        assert!(radii[0] + radii[1] < 1.0 && radii[0] + radii[2] < 4.0, "{radii:?}");
        assert!(rooms(2, &centers[..1])[0].is_infinite());
    }
}
