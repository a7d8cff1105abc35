use proptest::prelude::*;

use super::*;
use crate::points::squared_distance;

/// The definition, word for word: the clusters by their first points, border points with their nearest core point.
fn brute_force(points: &Points, parameters: DbscanParameters) -> Vec<Option<usize>> {
    let squared = |a: usize, b: usize| squared_distance(points.point(a), points.point(b));
    let near = |a: usize, b: usize| squared(a, b) <= parameters.epsilon * parameters.epsilon;
    let all = 0..points.len();
    let core: Vec<bool> =
        all.clone().map(|a| all.clone().filter(|&b| near(a, b)).count() >= parameters.min_points).collect();
    let mut components = petgraph::unionfind::UnionFind::new(points.len());
    for a in all.clone().filter(|&a| core[a]) {
        for b in (0..a).filter(|&b| core[b] && near(a, b)) {
            components.union(a, b);
        }
    }
    let mut numbers = std::collections::BTreeMap::new();
    let number = |a: usize| {
        let cores = all.clone().filter(|&b| core[b] && near(a, b));
        let nearest = cores.min_by(|&b, &c| squared(a, b).total_cmp(&squared(a, c)))?;
        let next = numbers.len();
        Some(*numbers.entry(components.find(if core[a] { a } else { nearest })).or_insert(next))
    };
    all.clone().map(number).collect()
}

fn assert_is_dbscan(points: &Points, parameters: DbscanParameters) {
    let labels: Vec<Option<usize>> = dbscan(points, parameters).iter().collect();
    assert_eq!(labels, brute_force(points, parameters), "{points:?} with {parameters:?}");
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

/// Heaps of hundreds of points, larger than a cell's tree has leaves, with points between and beside them.
fn heaps_and_parameters() -> impl Strategy<Value = (Points, DbscanParameters)> {
    (1_usize..7).prop_flat_map(|dimension| {
        let center = prop::collection::vec((-6_i32..6).prop_map(|x| f64::from(x) * 0.5), dimension);
        let spread = prop_oneof![Just(0.0), Just(0.01), Just(0.1), Just(0.4)];
        let offset =
            prop::collection::vec(prop_oneof![(-2_i32..3).prop_map(f64::from), -1.0..1.0_f64], dimension);
        let heap =
            (center, spread, prop::collection::vec(offset, 1..150)).prop_map(|(center, spread, offsets)| {
                let point = |offset: Vec<f64>| {
                    center.iter().zip(offset).map(|(c, o)| c + spread * o).collect::<Vec<_>>()
                };
                offsets.into_iter().flat_map(point).collect::<Vec<f64>>()
            });
        let epsilon = prop_oneof![Just(0.25), Just(0.5), Just(1.0), 0.02..1.5_f64];
        let min_points = prop_oneof![1_usize..10, 10..150_usize];
        // Far from the origin coordinates are coarse, and a grid is too fine to count its cells.
        let origin = prop_oneof![Just(0.0), Just(0.0), Just(1e6), Just(1e13)];
        (prop::collection::vec(heap, 1..6), epsilon, min_points, origin).prop_map(
            move |(heaps, epsilon, min_points, origin)| {
                let mut coordinates = heaps.concat();
                if let Some(first) = coordinates.first_mut() {
                    *first += origin;
                }
                (Points::from_rows(dimension, coordinates), DbscanParameters { epsilon, min_points })
            },
        )
    })
}

proptest! {
    #[test]
    fn labels_are_those_of_the_definition((points, parameters) in points_and_parameters()) {
        assert_is_dbscan(&points, parameters);
    }

    #[test]
    fn heaps_are_clustered_by_the_definition((points, parameters) in heaps_and_parameters()) {
        assert_is_dbscan(&points, parameters);
    }
}

fn check(dimension: usize, rows: &[f64], epsilon: f64, min_points: usize, expected: &[Option<usize>]) {
    let points = Points::from_rows(dimension, rows.to_vec());
    assert_eq!(
        dbscan(&points, DbscanParameters { epsilon, min_points }).iter().collect::<Vec<_>>(),
        expected
    );
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
        assert!(labels.iter().all(|label| label == Some(0)));
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
    assert!(labels.iter().take(100).all(|label| label == Some(0)));
    assert!(labels.iter().skip(100).all(|label| label == Some(1)));
}

#[test]
fn absurd_magnitudes_do_not_panic() {
    let rows = vec![1e308, -1e308, 1e-308, 0.0, 1e308, 5e-324];
    for epsilon in [1e-300, 1.0, 1e300] {
        let labels = dbscan(&Points::from_rows(1, rows.clone()), DbscanParameters { epsilon, min_points: 2 });
        assert_eq!(labels.len(), rows.len());
    }
}
