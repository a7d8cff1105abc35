use proptest::prelude::*;

use super::*;

/// The definition, word for word.
fn brute_force_core(points: &Points, parameters: DbscanParameters) -> Vec<bool> {
    let neighbors = |a: &[f64]| {
        points.iter().filter(|b| squared_distance(a, b) <= parameters.epsilon * parameters.epsilon).count()
    };
    points.iter().map(|point| neighbors(point) >= parameters.min_points).collect()
}

/// Checks every clause of the definition against brute force.
fn assert_is_dbscan(points: &Points, parameters: DbscanParameters) {
    let labels = dbscan(points, parameters);
    let core = brute_force_core(points, parameters);
    let near = |a: usize, b: usize| {
        squared_distance(points.point(a), points.point(b)) <= parameters.epsilon * parameters.epsilon
    };
    let mut components = petgraph::unionfind::UnionFind::new(points.len());
    for a in 0..points.len() {
        for b in 0..a {
            if core[a] && core[b] && near(a, b) {
                components.union(a, b);
            }
        }
    }
    for a in 0..points.len() {
        let has_core_neighbor = (0..points.len()).any(|b| core[b] && near(a, b));
        assert_eq!(labels[a].is_some(), has_core_neighbor, "point {a} of {points:?}");
        if !core[a] && labels[a].is_some() {
            let of_cluster = (0..points.len()).any(|b| core[b] && near(a, b) && labels[b] == labels[a]);
            assert!(of_cluster, "border point {a} is in a cluster without a core point near it");
        }
        for b in 0..a {
            if core[a] && core[b] {
                assert_eq!(labels[a] == labels[b], components.equiv(a, b), "core points {a} and {b}");
            }
        }
    }
}

fn points_and_parameters() -> impl Strategy<Value = (Points, DbscanParameters)> {
    // A coarse grid makes duplicates and ties at exactly epsilon common.
    let coordinate = prop_oneof![(-8_i32..8).prop_map(|x| f64::from(x) * 0.25), -3.0..3.0_f64];
    (1_usize..11).prop_flat_map(move |dimension| {
        let coordinates = prop::collection::vec(coordinate.clone(), 0..60 * dimension);
        let epsilon = prop_oneof![Just(0.25), Just(0.5), Just(1.0), 0.01..2.0_f64];
        (coordinates, epsilon, 1_usize..8).prop_map(move |(coordinates, epsilon, min_points)| {
            (Points::from_rows(dimension, coordinates), DbscanParameters { epsilon, min_points })
        })
    })
}

proptest! {
    #[test]
    fn labels_are_those_of_the_definition((points, parameters) in points_and_parameters()) {
        assert_is_dbscan(&points, parameters);
    }
}

fn check(dimension: usize, rows: &[f64], epsilon: f64, min_points: usize, expected: &[Option<usize>]) {
    let points = Points::from_rows(dimension, rows.to_vec());
    assert_eq!(dbscan(&points, DbscanParameters { epsilon, min_points }), expected);
}

#[test]
fn no_points_give_no_labels() {
    check(3, &[], 1.0, 5, &[]);
}

#[test]
fn a_distance_of_exactly_epsilon_is_near() {
    check(1, &[0.0, 1.0], 1.0, 2, &[Some(0), Some(0)]);
}

#[test]
fn a_point_counts_itself() {
    check(1, &[5.0], 0.1, 1, &[Some(0)]);
    check(1, &[5.0], 0.1, 2, &[None]);
}

#[test]
fn a_border_point_joins_its_nearest_core_point() {
    let rows = [0.0, 0.05, 0.1, 0.2, 1.0, 1.6, 2.0, 2.1, 2.2];
    let expected = [0, 0, 0, 0, 1, 1, 1, 1, 1].map(Some);
    check(1, &rows, 0.85, 4, &expected);
}

#[test]
fn a_heap_of_duplicates_is_one_cluster() {
    for dimension in [1, 3, 12] {
        let points = Points::from_rows(dimension, vec![0.5; 5_000 * dimension]);
        let labels = dbscan(&points, DbscanParameters { epsilon: 1e-9, min_points: 4 });
        assert!(labels.iter().all(|label| *label == Some(0)));
    }
}

#[test]
fn points_that_differ_only_beyond_the_eighth_coordinate_are_told_apart() {
    let mut rows = Vec::new();
    for index in 0..200 {
        let mut row = [0.0; 12];
        row[11] = f64::from(index / 100) * 10.0;
        rows.extend(row);
    }
    let labels = dbscan(&Points::from_rows(12, rows), DbscanParameters { epsilon: 0.5, min_points: 3 });
    assert!(labels[..100].iter().all(|label| *label == Some(0)));
    assert!(labels[100..].iter().all(|label| *label == Some(1)));
}

#[test]
fn absurd_magnitudes_do_not_panic() {
    let rows = vec![1e308, -1e308, 1e-308, 0.0, 1e308, 5e-324];
    for epsilon in [1e-300, 1.0, 1e300] {
        let labels = dbscan(&Points::from_rows(1, rows.clone()), DbscanParameters { epsilon, min_points: 2 });
        assert_eq!(labels.len(), rows.len());
    }
}
