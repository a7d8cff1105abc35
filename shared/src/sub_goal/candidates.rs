//! The partial states that are clustered, and the clusters that they form.

use std::collections::BTreeSet;

use super::{Cluster, RadiusRule, radius};
use crate::dbscan::{DbscanParameters, dbscan};
use crate::points::{Points, distance, mean};
use crate::rest::{Kind, SubsetRecording, SubsetStays};
use crate::specification::Ball;

/// The partial states that are clustered, with the demonstration of each and the stay that it belongs to.
pub(super) struct Candidates {
    points: Points,
    demonstrations: Vec<usize>,
    /// Positions in `stay_centers`; meaningless where no stays are looked at.
    stays: Vec<usize>,
    stay_centers: Vec<Vec<f64>>,
    /// How much room a ball leaves around the center of each of its stays.
    stillness: Option<f64>,
}

impl Candidates {
    /// Every observed partial state, as published.
    pub(super) fn every_frame(recording: &SubsetRecording) -> Self {
        let mut candidates = Self::none(recording, None);
        for (demonstration, track) in recording.tracks.iter().enumerate() {
            track.points.iter().for_each(|point| candidates.add(point, demonstration));
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
        for (demonstration, track) in recording.tracks.iter().enumerate() {
            for stay in stays.demonstrations[demonstration].iter().filter(|stay| is_wanted(stay.kind)) {
                let points = stay.dwell.span.clone().map(|index| track.points.point(index));
                candidates.stay_centers.push(stay.dwell.center.clone());
                let still = points.filter(|point| distance(point, &stay.dwell.center) <= reach);
                still.for_each(|point| candidates.add(point, demonstration));
            }
        }
        candidates
    }

    fn none(recording: &SubsetRecording, stillness: Option<f64>) -> Self {
        let points = Points::new(recording.features.len());
        Self { points, demonstrations: Vec::new(), stays: Vec::new(), stay_centers: Vec::new(), stillness }
    }

    fn add(&mut self, point: &[f64], demonstration: usize) {
        self.points.push(point);
        self.demonstrations.push(demonstration);
        self.stays.push(self.stay_centers.len().saturating_sub(1));
    }

    /// Their clusters, in the order of the first point of each.
    pub(super) fn clusters(
        &self,
        recording: &SubsetRecording,
        density: DbscanParameters,
        rule: RadiusRule,
    ) -> Vec<Cluster> {
        let members = self.members(density);
        let center = |members: &Vec<usize>| {
            mean(self.points.dimension(), members.iter().map(|&member| self.points.point(member)))
        };
        let centers: Vec<Vec<f64>> = members.iter().map(center).collect();
        let cluster = |(index, members): (usize, &Vec<usize>)| Cluster {
            ball: Ball {
                subset: recording.name.clone(),
                features: recording.features.clone(),
                center: centers[index].clone(),
                radius: self.radius(members, &centers, index, rule),
            },
            frames: members.len(),
            demonstrations: distinct(members, &self.demonstrations).len(),
        };
        members.iter().enumerate().map(cluster).collect()
    }

    /// The positions of each cluster's points.
    fn members(&self, density: DbscanParameters) -> Vec<Vec<usize>> {
        let mut members: Vec<Vec<usize>> = Vec::new();
        for (index, label) in dbscan(&self.points, density).iter().enumerate() {
            if let Some(label) = label {
                members.resize(members.len().max(label + 1), Vec::new());
                members[label].push(index);
            }
        }
        members
    }

    fn radius(&self, members: &[usize], centers: &[Vec<f64>], index: usize, rule: RadiusRule) -> f64 {
        let to_center = |point: &[f64]| distance(point, &centers[index]);
        let distances = members.iter().map(|&member| to_center(self.points.point(member))).collect();
        let floor = |stillness: f64| {
            let stays = distinct(members, &self.stays).into_iter();
            stillness + stays.map(|stay| to_center(&self.stay_centers[stay])).fold(0.0, f64::max)
        };
        match rule {
            RadiusRule::Largest => radius::largest(distances),
            RadiusRule::Robust => {
                radius::robust(distances, self.stillness.map_or(0.0, floor), radius::room(centers, index))
            }
        }
    }
}

fn distinct(members: &[usize], of: &[usize]) -> BTreeSet<usize> {
    members.iter().map(|&member| of[member]).collect()
}
