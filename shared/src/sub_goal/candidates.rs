//! The partial states that are clustered, and the clusters that they form.

use super::clustering::Clustering;
use super::{Cluster, RadiusRule, radius};
use crate::dbscan::DbscanParameters;
use crate::points::{Points, distance, mean};
use crate::rest::{Kind, SubsetRecording, SubsetStays};
use crate::specification::Ball;

/// The partial states that are clustered, stretch by stretch.
pub(super) struct Candidates {
    pub(super) points: Points,
    pub(super) stretches: Vec<Stretch>,
    /// How many demonstrations they are from.
    pub(super) demonstrations: usize,
    /// How far from the center of its stay a partial state is at most, where stays are looked at.
    pub(super) reach: f64,
    /// How much room a ball leaves around the center of each of its stays.
    stillness: Option<f64>,
}

/// Partial states of one demonstration in a row.
pub(super) struct Stretch {
    pub(super) demonstration: usize,
    /// Which stay of the demonstration it is; zero where every frame is looked at.
    pub(super) stay: usize,
    /// Center of the stay that it is, where stays are looked at.
    center: Vec<f64>,
    /// Position of the first partial state of the next stretch.
    pub(super) end: usize,
}

impl Candidates {
    /// Every observed partial state, as published.
    pub(super) fn every_frame(recording: &SubsetRecording) -> Self {
        let mut candidates = Self::none(recording, None);
        for (demonstration, track) in recording.tracks.iter().enumerate() {
            candidates.add((demonstration, 0), Vec::new(), track.points.iter());
        }
        candidates
    }

    /// Those in the stays whose kind `is_wanted`, but for the frames that stray from the bulk of their stay.
    pub(super) fn of_stays(
        recording: &SubsetRecording,
        stays: &SubsetStays,
        is_wanted: impl Fn(Kind) -> bool,
    ) -> Self {
        let mut candidates = Self::none(recording, Some(stays.scales.stillness));
        let reach = stays.scales.heap_radius(recording.features.len());
        candidates.reach = reach;
        for (demonstration, track) in recording.tracks.iter().enumerate() {
            let stays = stays.demonstrations[demonstration].iter().enumerate();
            for (index, stay) in stays.filter(|(_, stay)| is_wanted(stay.kind)) {
                let center = &stay.dwell.center;
                let points = stay.dwell.span.clone().map(|index| track.points.point(index));
                candidates.add(
                    (demonstration, index),
                    center.clone(),
                    points.filter(|point| distance(point, center) <= reach),
                );
            }
        }
        candidates
    }

    /// The partial states themselves.
    pub(super) fn into_points(self) -> Points {
        self.points
    }

    fn none(recording: &SubsetRecording, stillness: Option<f64>) -> Self {
        let (points, demonstrations) = (Points::new(recording.features.len()), recording.tracks.len());
        Self { points, stretches: Vec::new(), demonstrations, reach: f64::INFINITY, stillness }
    }

    fn add<'a>(
        &mut self,
        (demonstration, stay): (usize, usize),
        center: Vec<f64>,
        points: impl Iterator<Item = &'a [f64]>,
    ) {
        points.for_each(|point| self.points.push(point));
        self.stretches.push(Stretch { demonstration, stay, center, end: self.points.len() });
    }

    /// Their clusters, in the order of the first point of each. What is `known` of them is used, and then it is of these.
    ///
    /// # Complexity
    ///
    /// That of [`dbscan`](crate::dbscan::dbscan), or less where a few points have come since, and O(n log n) for n points of
    /// few coordinates; O(k²) for k clusters of many.
    pub(super) fn clusters(
        &self,
        recording: &SubsetRecording,
        density: DbscanParameters,
        rule: RadiusRule,
        known: &mut Option<Clustering>,
    ) -> Vec<Cluster> {
        let members = self.members(density, known);
        let center = |members: &Vec<u32>| {
            mean(self.points.dimension(), members.iter().map(|&member| self.points.point(member as usize)))
        };
        let centers: Vec<Vec<f64>> = members.iter().map(center).collect();
        let rooms = (rule == RadiusRule::Robust).then(|| radius::rooms(self.points.dimension(), &centers));
        let cluster = |(index, members): (usize, &Vec<u32>)| {
            let stretches = self.stretches_of(members);
            let mut demonstrations: Vec<usize> = stretches.iter().map(|it| it.demonstration).collect();
            demonstrations.dedup();
            Cluster {
                ball: Ball {
                    subset: recording.name.clone(),
                    features: recording.features.clone(),
                    center: centers[index].clone(),
                    radius: self.radius(
                        members,
                        &stretches,
                        &centers[index],
                        rooms.as_ref().map(|it| it[index]),
                    ),
                },
                frames: members.len(),
                demonstrations: demonstrations.len(),
            }
        };
        members.iter().enumerate().map(cluster).collect()
    }

    /// The positions of each cluster's points, ascending.
    fn members(&self, density: DbscanParameters, known: &mut Option<Clustering>) -> Vec<Vec<u32>> {
        let labels = Clustering::labels(known.as_ref(), self, density);
        *known = Some(Clustering::of(self, density, &labels));
        let mut members = vec![Vec::new(); labels.clusters()];
        for (index, label) in labels.iter().enumerate() {
            if let Some(label) = label {
                members[label].push(index as u32);
            }
        }
        members
    }

    /// The stretches that have points among these, which are ascending.
    ///
    /// # Complexity
    ///
    /// O(m + f log s) for m points in f of s stretches.
    fn stretches_of(&self, members: &[u32]) -> Vec<&Stretch> {
        let mut found: Vec<&Stretch> = Vec::new();
        for &member in members {
            if found.last().is_none_or(|last| last.end <= member as usize) {
                let before = self.stretches.partition_point(|stretch| stretch.end <= member as usize);
                found.extend(self.stretches.get(before));
            }
        }
        found
    }

    /// By the robust rule where there is `room` to be kept to, as published where there is none.
    fn radius(&self, members: &[u32], stretches: &[&Stretch], center: &[f64], room: Option<f64>) -> f64 {
        let to_center = |point: &[f64]| distance(point, center);
        let distances = members.iter().map(|&member| to_center(self.points.point(member as usize))).collect();
        let Some(room) = room else {
            return radius::largest(distances);
        };
        let floor = |stillness: f64| {
            stillness + stretches.iter().map(|stretch| to_center(&stretch.center)).fold(0.0, f64::max)
        };
        radius::robust(distances, self.stillness.map_or(0.0, floor), room)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A look at the stretches from the first on.
    fn stretches_one_by_one<'a>(candidates: &'a Candidates, members: &[u32]) -> Vec<&'a Stretch> {
        let mut all = candidates.stretches.iter();
        let mut found: Vec<&Stretch> = Vec::new();
        for &member in members {
            if found.last().is_none_or(|last| last.end <= member as usize) {
                found.extend(all.find(|stretch| (member as usize) < stretch.end));
            }
        }
        found
    }

    proptest! {
        #[test]
        fn stretches_of_points_are_found(
            lengths in prop::collection::vec(0..5_usize, 0..30), are_members in prop::collection::vec(any::<bool>(), 120),
        ) {
            let mut candidates = Candidates::none(&SubsetRecording::default(), None);
            candidates.points = Points::new(1);
            for (stay, &length) in lengths.iter().enumerate() {
                candidates.add((0, stay), Vec::new(), std::iter::repeat_n(&[0.0][..], length));
            }
            let members: Vec<u32> =
                (0..candidates.points.len() as u32).filter(|&at| are_members[at as usize]).collect();
            let stays = |stretches: Vec<&Stretch>| stretches.iter().map(|it| it.stay).collect::<Vec<_>>();
            let expected = stays(stretches_one_by_one(&candidates, &members));
            prop_assert_eq!(stays(candidates.stretches_of(&members)), expected);
        }
    }
}
