//! Clusters that points are added to.

use std::cell::Cell;

use super::bounds::{Bounds, around};
use super::{DbscanParameters, Labels, dbscan};
use crate::points::{Points, squared_distance};

/// What is known of a point from a clustering before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Before {
    /// It was not there.
    New,
    /// It was noise.
    Noise,
    /// It was in the cluster with this number.
    Cluster(usize),
}

/// With more comparisons than this for each point, clustering all anew takes no longer.
const FEW: usize = 16;

/// How often it is tried to reach new points by others that have been reached: they mostly follow each other.
const ROUNDS: usize = 4;

/// Keeps what is further away than a neighbor's neighbor apart in spite of rounding.
const ROOM: f64 = 1.0 + 1e-9;

/// What [`dbscan`] gives, where those of the points that are not new were clustered `before` with the same parameters:
/// these all, in this order, and no others. How the clusters were numbered does not count.
///
/// # Complexity
///
/// O(n) with a small constant where few new points join clusters that stand alone or are far from everything; that of
/// [`dbscan`] otherwise.
pub(crate) fn dbscan_of_more(points: &Points, parameters: DbscanParameters, before: &[Before]) -> Labels {
    grown(points, parameters, before).unwrap_or_else(|| dbscan(points, parameters))
}

/// The clusters with the new points, if these change nothing for the others; none where that is not certain.
///
/// A new point can change the neighborhoods of points within epsilon, and by that the clusters of points within twice
/// epsilon. Where all these are of one cluster, old points stay what they are, and so does everything else. New points in
/// reach of one of its core points are then of that cluster too, whatever they are.
fn grown(points: &Points, parameters: DbscanParameters, before: &[Before]) -> Option<Labels> {
    let new: Vec<usize> = (0..before.len()).filter(|&at| before[at] == Before::New).collect();
    let mut known = Known::new(points, parameters, before);
    if new.len() * (known.boxes.len() + known.noise.len()) > FEW * before.len() {
        return None;
    }
    let (mut joining, mut strays) = (Vec::new(), Vec::new());
    for point in new {
        match known.home(point) {
            Home::In(cluster) => joining.push((point, cluster)),
            Home::Nowhere => strays.push(point),
            Home::Unclear => return None,
        }
    }
    let is_near_joining = |&stray: &usize| joining.iter().any(|&(point, _)| known.are_near(point, stray));
    if strays.iter().any(|stray| known.takes_too_long() || is_near_joining(stray)) {
        return None;
    }
    for &(point, cluster) in &joining {
        known.clusters[cluster].push(point);
    }
    let mut settled = Settled::new(before, known.clusters.len());
    let mut waiting = joining;
    for _ in 0..ROUNDS {
        waiting.retain(|&(point, cluster)| !settled.reaches(&known, point, cluster));
    }
    if !waiting.is_empty() {
        return None;
    }
    let Known { mut clusters, .. } = known;
    clusters.extend(clusters_of(points, parameters, &strays));
    Some(Labels::of_clusters(before.len(), &clusters))
}

/// The clusters of those points that are far from all others.
fn clusters_of(points: &Points, parameters: DbscanParameters, positions: &[usize]) -> Vec<Vec<usize>> {
    let mut alone = Points::new(points.dimension());
    for &position in positions {
        alone.push(points.point(position));
    }
    let labels = dbscan(&alone, parameters);
    let mut clusters = vec![Vec::new(); labels.clusters()];
    for (&position, label) in positions.iter().zip(labels.iter()) {
        if let Some(label) = label {
            clusters[label].push(position);
        }
    }
    clusters
}

/// The clusters as they were, and what was none.
struct Known<'a> {
    points: &'a Points,
    min_points: usize,
    squared_epsilon: f64,
    /// The points of each cluster.
    clusters: Vec<Vec<usize>>,
    /// The box around each cluster as it was.
    boxes: Vec<Vec<f64>>,
    noise: Vec<usize>,
    /// How many more comparisons are worth their while.
    left: Cell<usize>,
}

impl<'a> Known<'a> {
    fn new(points: &'a Points, parameters: DbscanParameters, before: &[Before]) -> Self {
        let (mut clusters, mut noise): (Vec<Vec<usize>>, _) = (Vec::new(), Vec::new());
        for (position, before) in before.iter().enumerate() {
            match *before {
                Before::New => {}
                Before::Noise => noise.push(position),
                Before::Cluster(number) => {
                    clusters.resize_with(clusters.len().max(number + 1), Vec::new);
                    clusters[number].push(position);
                }
            }
        }
        let boxed = |members: &Vec<usize>| {
            let mut bounds = Vec::with_capacity(2 * points.dimension());
            around(points.dimension(), members.iter().map(|&member| points.point(member)), &mut bounds);
            bounds
        };
        let boxes = clusters.iter().map(boxed).collect();
        let squared_epsilon = parameters.epsilon * parameters.epsilon;
        let left = Cell::new(FEW * before.len());
        Self { points, min_points: parameters.min_points, squared_epsilon, clusters, boxes, noise, left }
    }

    fn squared(&self, a: usize, b: usize) -> f64 {
        squared_distance(self.points.point(a), self.points.point(b))
    }

    fn are_near(&self, a: usize, b: usize) -> bool {
        self.left.set(self.left.get().saturating_sub(1));
        self.squared(a, b) <= self.squared_epsilon
    }

    /// Whether clustering all anew is the shorter way by now.
    fn takes_too_long(&self) -> bool {
        self.left.get() == 0
    }

    /// What a new point may have to do with.
    fn home(&self, point: usize) -> Home {
        let own = Bounds::of_point(self.points.point(point));
        let far = 4.0 * self.squared_epsilon * ROOM;
        let gaps = self.boxes.iter().map(|bounds| Bounds::new(self.points.dimension(), bounds).nearest(&own));
        let around: Vec<(usize, f64)> = gaps.enumerate().filter(|&(_, gap)| gap <= far).collect();
        let is_near = around.iter().any(|&(_, gap)| gap <= self.squared_epsilon);
        let noise = self.noise.iter().map(|&noise| self.squared(point, noise)).fold(f64::INFINITY, f64::min);
        match around[..] {
            _ if !is_near && noise > self.squared_epsilon => Home::Nowhere,
            [(cluster, _)] if is_near && noise > far => Home::In(cluster),
            _ => Home::Unclear,
        }
    }

    /// Whether a point of a cluster has enough of that around it.
    fn is_core(&self, point: usize, cluster: usize) -> bool {
        let near = self.clusters[cluster].iter().filter(|&&other| self.are_near(point, other));
        near.take(self.min_points).count() == self.min_points
    }
}

/// What a new point may have to do with.
enum Home {
    /// With this cluster alone.
    In(usize),
    /// With no point that was there.
    Nowhere,
    /// With more than that.
    Unclear,
}

/// What is certain of the new clusters.
struct Settled {
    /// Whether the cluster of a point is.
    is_settled: Vec<bool>,
    /// Core points of each cluster.
    core: Vec<Vec<usize>>,
}

impl Settled {
    fn new(before: &[Before], clusters: usize) -> Self {
        let is_settled = before.iter().map(|&before| before != Before::New).collect();
        Self { is_settled, core: vec![Vec::new(); clusters] }
    }

    /// Whether a point is within epsilon of what is certain to be a core point of the cluster; then it is of that cluster.
    fn reaches(&mut self, known: &Known, point: usize, cluster: usize) -> bool {
        let is_witness = |&&other: &&usize| {
            self.is_settled[other] && known.are_near(point, other) && known.is_core(other, cluster)
        };
        if !self.core[cluster].iter().any(|&core| known.are_near(point, core)) {
            let mut others = known.clusters[cluster].iter().take_while(|_| !known.takes_too_long());
            let Some(&witness) = others.find(is_witness) else {
                return false;
            };
            self.core[cluster].push(witness);
        }
        self.is_settled[point] = true;
        true
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// What `dbscan` says of those points that are not new.
    fn clustered_before(points: &Points, parameters: DbscanParameters, is_new: &[bool]) -> Vec<Before> {
        let mut old = Points::new(points.dimension());
        points.iter().zip(is_new).filter(|(_, is_new)| !**is_new).for_each(|(point, _)| old.push(point));
        let labels = dbscan(&old, parameters);
        let mut labels = labels.iter();
        let mut next = || labels.next().flatten().map_or(Before::Noise, Before::Cluster);
        is_new.iter().map(|&is_new| if is_new { Before::New } else { next() }).collect()
    }

    /// Heaps on a line of places, each new or not, and what epsilon is.
    fn heaps() -> impl Strategy<Value = (Points, Vec<bool>, f64)> {
        let heap = (
            0..6_i32,
            prop::collection::vec(-1.0..1.0_f64, 2..24),
            prop_oneof![4 => Just(false), 1 => Just(true)],
        );
        let gap = prop_oneof![Just(1.0), Just(3.0), Just(6.0)];
        (prop::collection::vec(heap, 1..12), 1..3_usize, gap, 0.2..1.2_f64).prop_map(
            |(heaps, dimension, gap, epsilon)| {
                let (mut points, mut is_new) = (Points::new(dimension), Vec::new());
                for (place, offsets, new) in heaps {
                    for offset in offsets.chunks_exact(dimension) {
                        let point: Vec<f64> = offset.iter().map(|x| gap * f64::from(place) + x).collect();
                        points.push(&point);
                        is_new.push(new);
                    }
                }
                (points, is_new, epsilon)
            },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn clusters_that_grow_are_those_of_all_points((points, is_new, epsilon) in heaps(), min_points in 1..6_usize) {
            let parameters = DbscanParameters { epsilon, min_points };
            let before = clustered_before(&points, parameters, &is_new);
            prop_assert_eq!(dbscan_of_more(&points, parameters, &before), dbscan(&points, parameters));
        }
    }

    /// Whether the clusters of points on a line, the last of which are new, are known without clustering them all.
    fn is_known(x: &[f64], new: usize) -> bool {
        let points = Points::from_rows(1, x.to_vec());
        let parameters = DbscanParameters { epsilon: 1.0, min_points: 3 };
        let is_new: Vec<bool> = (0..x.len()).map(|at| at + new >= x.len()).collect();
        let before = clustered_before(&points, parameters, &is_new);
        let grown = grown(&points, parameters, &before);
        assert!(grown.as_ref().is_none_or(|grown| *grown == dbscan(&points, parameters)));
        grown.is_some()
    }

    #[test]
    fn points_at_a_place_that_stands_alone_join_it() {
        assert!(is_known(&[0.0, 0.5, 1.0, 9.0, 9.5, 10.0, 0.2, 9.7], 2));
        assert!(is_known(&[0.0, 0.5, 1.0, 0.6, 0.4, 0.3, 0.2, 0.1, 1.7, 1.9], 2));
    }

    #[test]
    fn points_far_from_everything_are_clustered_alone() {
        assert!(is_known(&[0.0, 0.5, 1.0, 0.6, 0.4, 0.3, 0.2, 0.1, 0.7, 20.0, 20.5, 21.0], 3));
    }

    #[test]
    fn many_points_at_a_known_place_and_many_elsewhere_are_not_compared_with_each_other() {
        let at = |place: f64, count: usize| (0..count).map(move |point| place + point as f64 / 1e4);
        let points = |new: usize| at(0.0, 100).chain(at(0.0, new)).chain(at(9.0, new)).collect::<Vec<f64>>();
        assert!(is_known(&points(20), 40));
        assert!(!is_known(&points(2000), 4000));
    }

    #[test]
    fn points_between_clusters_or_beside_noise_are_not_so_simple() {
        assert!(!is_known(&[0.0, 0.5, 1.0, 2.5, 3.0, 3.5, 1.7], 1));
        assert!(!is_known(&[0.0, 0.5, 1.0, 9.0, 8.2], 1));
        assert!(!is_known(&[0.0, 0.5, 1.0, 2.8, 1.4], 1));
    }
}
