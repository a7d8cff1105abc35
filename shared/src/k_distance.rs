//! How far points are from their neighbors: the curve that epsilon is read from.

use crate::kd_tree::KdTree;
use crate::points::Points;

/// The distances of points to their `k`-th nearest neighbor, themselves included as in DBSCAN, ascending: of all points
/// or, where there are more, of `sample` of them, evenly spaced in their order. Empty with fewer than `k` points: then no
/// epsilon makes one of them core.
///
/// With `k = min_points` this is the sorted k-dist graph of Ester, Kriegel, Sander and Xu (1996), section 4.2. Exact to
/// the last bit: with any epsilon just those points of the sample are core whose distance is at most epsilon.
///
/// # Complexity
///
/// For n points O(n log n), and O(k log n) for each of the sample in few dimensions; O(n) for each in many.
///
/// # Example
///
/// ```
/// use goalgraph::k_distance::k_distances;
/// use goalgraph::points::Points;
///
/// let points = Points::from_rows(1, vec![0.0, 1.0, 3.0, 9.0]);
/// assert_eq!(k_distances(&points, 2, 1000), [1.0, 1.0, 2.0, 6.0]);
/// ```
pub fn k_distances(points: &Points, k: usize, sample: usize) -> Vec<f64> {
    let (k, size) = (k.max(1), points.len().min(sample));
    if points.len() < k {
        return Vec::new();
    }
    let tree = KdTree::new(points.dimension(), &points.iter().collect::<Vec<_>>());
    let query = |number: usize| points.point(number * points.len() / size);
    let mut distances: Vec<f64> =
        (0..size).map(|number| least_epsilon(kth_square(&tree, query(number), k))).collect();
    distances.sort_by(f64::total_cmp);
    distances
}

/// Square of the distance from `query` to the `k`-th nearest of at least `k` points.
fn kth_square(tree: &KdTree, query: &[f64], k: usize) -> f64 {
    let mut nearest = Vec::with_capacity(k + 1);
    tree.search(
        query,
        f64::INFINITY,
        |_| false,
        |_, square| {
            let at = nearest.partition_point(|&known| known <= square);
            nearest.insert(at, square);
            nearest.truncate(k);
            // Once there are k, only what is nearer changes anything.
            if nearest.len() == k { nearest[k - 1].next_down() } else { f64::INFINITY }
        },
    );
    nearest.last().copied().unwrap_or(f64::INFINITY)
}

/// The smallest number whose square, as it is rounded, is at least `square`: the least epsilon that reaches so far.
fn least_epsilon(square: f64) -> f64 {
    let mut epsilon = square.sqrt().next_down().max(0.0);
    while epsilon * epsilon < square {
        epsilon = epsilon.next_up();
    }
    epsilon
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::squared_distance;

    /// The definition: of every point the distances to all, sorted, and of those the `k`-th.
    fn brute_force(points: &Points, k: usize) -> Vec<f64> {
        let kth = |a: &[f64]| {
            let mut squares: Vec<f64> = points.iter().map(|b| squared_distance(a, b)).collect();
            squares.sort_by(f64::total_cmp);
            least_epsilon(squares[k - 1])
        };
        let mut distances: Vec<f64> = points.iter().map(kth).collect();
        distances.sort_by(f64::total_cmp);
        distances
    }

    /// How many points are core, by DBSCAN's definition.
    fn core_points(points: &Points, epsilon: f64, min_points: usize) -> usize {
        let neighbors =
            |a: &[f64]| points.iter().filter(|b| squared_distance(a, b) <= epsilon * epsilon).count();
        points.iter().filter(|point| neighbors(point) >= min_points).count()
    }

    fn points_and_k() -> impl Strategy<Value = (Points, usize)> {
        // A coarse grid makes duplicates and ties common.
        let coordinate = prop_oneof![(-3_i32..3).prop_map(|x| f64::from(x) * 0.1), -3.0..3.0_f64];
        (1_usize..6).prop_flat_map(move |dimension| {
            let coordinates = prop::collection::vec(coordinate.clone(), dimension..120 * dimension);
            coordinates.prop_flat_map(move |coordinates| {
                let points = Points::from_rows(dimension, coordinates);
                let most = points.len();
                (Just(points), 1..=most)
            })
        })
    }

    proptest! {
        #[test]
        fn distances_are_those_of_the_definition((points, k) in points_and_k()) {
            prop_assert_eq!(k_distances(&points, k, usize::MAX), brute_force(&points, k));
        }

        #[test]
        fn a_distance_as_epsilon_makes_just_those_points_core_that_have_no_larger_one(
            (points, k) in points_and_k()
        ) {
            let distances = k_distances(&points, k, usize::MAX);
            for &epsilon in &distances {
                let no_larger = distances.iter().filter(|&&distance| distance <= epsilon).count();
                prop_assert_eq!(core_points(&points, epsilon, k), no_larger);
            }
        }

        #[test]
        fn the_least_epsilon_is_the_least(square in prop_oneof![0.0..1e-300_f64, 0.0..1e9_f64, 0.0..f64::MAX]) {
            let epsilon = least_epsilon(square);
            prop_assert!(epsilon * epsilon >= square);
            let less = epsilon.next_down();
            prop_assert!(less < 0.0 || less * less < square);
        }
    }

    #[test]
    fn a_sample_is_evenly_spaced_and_measured_against_all_points() {
        let points = Points::from_rows(1, (0..1000).map(f64::from).collect());
        let distances = k_distances(&points, 3, 10);
        // The first point has both neighbors on one side.
        assert_eq!(distances, [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0]);
    }

    #[test]
    fn any_number_of_equal_points_is_no_trouble() {
        let mut coordinates = vec![0.25; 3 * 5000];
        coordinates.extend([1.25, 0.25, 0.25]);
        let distances = k_distances(&Points::from_rows(3, coordinates), 20, usize::MAX);
        assert_eq!((distances[0], distances[4999], distances[5000]), (0.0, 0.0, 1.0));
    }

    #[test]
    fn fewer_points_than_neighbors_have_no_distances() {
        assert_eq!(k_distances(&Points::from_rows(2, vec![0.0, 0.0]), 2, 1000), [0.0; 0]);
        assert_eq!(k_distances(&Points::new(2), 1, 1000), [0.0; 0]);
    }
}
