//! Sub-goals: clusters of partial states, their balls, and which of them are eliminated.

use std::collections::BTreeSet;

use crate::dbscan::{DbscanParameters, dbscan};
use crate::parameters::choose_parameters;
use crate::points::{Points, Track, distance, mean, median, quantile};
use crate::rest::{Kind, Stay, SubsetRecording, SubsetStays};
use crate::specification::{Ball, SubsetParameters};
use crate::subset::{Setting, SubsetRequest};

/// Which frames are clustered, and when a sub-goal counts as reached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Only frames in which a thing rests; a sub-goal is reached when the thing comes to rest in its ball.
    #[default]
    AtRest,
    /// Every frame, and a sub-goal is reached by a single frame in its ball, as published.
    Published,
}

/// How large the ball around a cluster is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RadiusRule {
    /// What the bulk of the cluster's points needs, and never into the ball of a neighbor.
    #[default]
    Robust,
    /// The largest distance of a point to the center, as published.
    Largest,
}

/// A cluster with its ball.
#[derive(Clone, Debug, PartialEq)]
pub struct Cluster {
    /// The ball around it.
    pub ball: Ball,
    /// How many frames it has.
    pub frames: usize,
    /// How many demonstrations have frames in it.
    pub demonstrations: usize,
}

/// A cluster that is no sub-goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Eliminated {
    /// The cluster.
    pub cluster: Cluster,
    /// Why it is no sub-goal, as a sentence.
    pub reason: String,
}

/// What was found in one subset.
#[derive(Clone, Debug, PartialEq)]
pub struct SubGoalSearch {
    /// The parameters that were used.
    pub parameters: SubsetParameters,
    /// The sub-goals.
    pub found: Vec<Cluster>,
    /// The clusters that are none.
    pub eliminated: Vec<Eliminated>,
}

/// Searches sub-goals in one subset by DBSCAN over its partial states in all demonstrations.
///
/// With `stays` only frames at rest are clustered; without, every observed frame as published. A cluster whose ball holds
/// the first observed partial state of a demonstration is eliminated.
///
/// # Complexity
///
/// That of [`dbscan`], and of [`choose_parameters`] where a parameter is left to the engine.
pub fn find_sub_goals(
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
    request: &SubsetRequest,
    radius: RadiusRule,
) -> SubGoalSearch {
    let parameters = parameters(recording, stays, request);
    let candidates = match stays {
        Some(stays) => Candidates::at_rest(recording, stays),
        None => Candidates::every_frame(recording),
    };
    let density = DbscanParameters { epsilon: parameters.epsilon, min_points: parameters.min_points };
    let labels = dbscan(&candidates.points, density);
    let mut members: Vec<Vec<usize>> = Vec::new();
    for (index, label) in labels.iter().enumerate() {
        if let Some(label) = *label {
            members.resize(members.len().max(label + 1), Vec::new());
            members[label].push(index);
        }
    }
    let clusters = clusters(&candidates, &members, recording, radius, stays);
    let (mut found, mut eliminated) = (Vec::new(), Vec::new());
    for cluster in clusters {
        match reason_against(&cluster, recording, stays) {
            Some(reason) => eliminated.push(Eliminated { cluster, reason }),
            None => found.push(cluster),
        }
    }
    SubGoalSearch { parameters, found, eliminated }
}

fn parameters(
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
    request: &SubsetRequest,
) -> SubsetParameters {
    let chosen = match stays {
        Some(stays) => choose_parameters(stays, recording.features.len()),
        None => choose_parameters(
            &crate::rest::stays(std::slice::from_ref(recording))[0],
            recording.features.len(),
        ),
    };
    SubsetParameters {
        name: request.name.clone(),
        features: request.features.clone(),
        epsilon: match request.epsilon {
            Setting::Auto => chosen.epsilon,
            Setting::Fixed(epsilon) => epsilon,
        },
        min_points: match request.min_points {
            Setting::Auto => chosen.min_points,
            Setting::Fixed(min_points) => min_points,
        },
        min_dwell: stays.map_or(1, |stays| stays.min_dwell),
    }
}

/// The partial states that are clustered, with the demonstration of each and the rest that it belongs to.
struct Candidates {
    points: Points,
    demonstrations: Vec<usize>,
    /// Positions in `rest_centers`; meaningless where no rests are looked at.
    rests: Vec<usize>,
    rest_centers: Vec<Vec<f64>>,
}

impl Candidates {
    fn every_frame(recording: &SubsetRecording) -> Self {
        let mut candidates = Self::none(recording);
        for (demonstration, track) in recording.tracks.iter().enumerate() {
            track.points.iter().for_each(|point| candidates.add(point, demonstration));
        }
        candidates
    }

    fn at_rest(recording: &SubsetRecording, stays: &SubsetStays) -> Self {
        let mut candidates = Self::none(recording);
        let reach = stays.scales.heap_radius(recording.features.len());
        for (demonstration, track) in recording.tracks.iter().enumerate() {
            for stay in stays.demonstrations[demonstration].iter().filter(|stay| stay.kind.is_rest()) {
                let points = stay.dwell.span.clone().map(|index| track.points.point(index));
                candidates.rest_centers.push(stay.dwell.center.clone());
                let still = points.filter(|point| distance(point, &stay.dwell.center) <= reach);
                still.for_each(|point| candidates.add(point, demonstration));
            }
        }
        candidates
    }

    fn none(recording: &SubsetRecording) -> Self {
        let points = Points::new(recording.features.len());
        Self { points, demonstrations: Vec::new(), rests: Vec::new(), rest_centers: Vec::new() }
    }

    fn add(&mut self, point: &[f64], demonstration: usize) {
        self.points.push(point);
        self.demonstrations.push(demonstration);
        self.rests.push(self.rest_centers.len().saturating_sub(1));
    }
}

fn clusters(
    candidates: &Candidates,
    members: &[Vec<usize>],
    recording: &SubsetRecording,
    rule: RadiusRule,
    stays: Option<&SubsetStays>,
) -> Vec<Cluster> {
    let dimension = recording.features.len();
    let center =
        |members: &Vec<usize>| mean(dimension, members.iter().map(|&member| candidates.points.point(member)));
    let centers: Vec<Vec<f64>> = members.iter().map(center).collect();
    let farthest_rest = |index: usize| {
        let rests: BTreeSet<usize> = members[index].iter().map(|&member| candidates.rests[member]).collect();
        rests
            .into_iter()
            .map(|rest| distance(&candidates.rest_centers[rest], &centers[index]))
            .fold(0.0, f64::max)
    };
    let radius = |index: usize| {
        let distances =
            members[index].iter().map(|&member| distance(candidates.points.point(member), &centers[index]));
        let largest = distances.clone().fold(0.0, f64::max);
        match rule {
            RadiusRule::Largest => largest,
            RadiusRule::Robust => {
                let bulk = quantile(distances.collect(), 0.9);
                let floor = stays.map_or(0.0, |stays| stays.scales.stillness + farthest_rest(index));
                let others = (0..centers.len()).filter(|&other| other != index);
                let room = others.map(|other| 0.45 * distance(&centers[index], &centers[other]));
                (1.5 * bulk).max(floor).min(room.fold(f64::INFINITY, f64::min))
            }
        }
    };
    let cluster = |index: usize| Cluster {
        ball: Ball {
            subset: recording.name.clone(),
            features: recording.features.clone(),
            center: centers[index].clone(),
            radius: radius(index),
        },
        frames: members[index].len(),
        demonstrations: members[index]
            .iter()
            .map(|&member| candidates.demonstrations[member])
            .collect::<BTreeSet<_>>()
            .len(),
    };
    (0..members.len()).map(cluster).collect()
}

/// Why a cluster is no sub-goal, if it is none.
fn reason_against(
    cluster: &Cluster,
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
) -> Option<String> {
    let starts = match stays {
        Some(stays) => {
            let first = |of: &&Vec<Stay>| {
                of.first()
                    .is_some_and(|stay| stay.kind == Kind::Start && cluster.ball.contains(&stay.dwell.center))
            };
            stays.demonstrations.iter().filter(first).count()
        }
        None => recording.tracks.iter().filter(|track| starts_in(track, &cluster.ball)).count(),
    };
    let total = recording.tracks.len();
    if starts > 0 {
        return Some(format!("{starts} of {total} demonstrations start here"));
    }
    let needed = support_needed(cluster, stays?);
    let support = cluster.demonstrations;
    (support < needed).then(|| format!("only {support} of {total} demonstrations rest here"))
}

/// A place where a thing is never known to be left alone needs this share of the demonstrations, or that share if it
/// stays there about as long as elsewhere: others are stops by chance.
const SUPPORT_OF_UNCLEAR: f64 = 0.5;
const SUPPORT_OF_LONG: f64 = 0.1;

/// A thing stays at a place about as long as elsewhere from this share of the typical length on.
const LONG: f64 = 0.6;

/// How many demonstrations must rest at a place.
fn support_needed(cluster: &Cluster, stays: &SubsetStays) -> usize {
    let total = stays.demonstrations.len();
    let here = |stay: &&Stay| cluster.ball.contains(&stay.dwell.center);
    let frames = |stay: &Stay| stay.dwell.span.len() as f64;
    let rests = || stays.demonstrations.iter().flatten().filter(|stay| stay.kind.is_rest());
    let unclear = || rests().filter(|stay| stay.kind == Kind::Rest);
    let length_here = median(unclear().filter(here).map(frames).collect());
    let elsewhere = median(unclear().map(frames).collect()).max(stays.shortest_left);
    let is_long = length_here >= LONG * elsewhere;
    let share = if is_long { SUPPORT_OF_LONG } else { SUPPORT_OF_UNCLEAR };
    match total {
        0..3 => 1,
        _ if rests().filter(here).any(|stay| stay.kind == Kind::LeftAlone) => 2,
        _ => 2.max((share * total as f64).ceil() as usize),
    }
}

fn starts_in(track: &Track, ball: &Ball) -> bool {
    !track.is_empty() && ball.contains(track.points.point(0))
}

/// Frames of `track` in which a sub-goal with `ball` holds: every frame in the ball as published, or, with the stays of
/// the demonstration, those of rests that are mostly in the ball.
pub fn frames_reached(ball: &Ball, track: &Track, stays: Option<&[Stay]>) -> Vec<usize> {
    let inside = |&index: &usize| ball.contains(track.points.point(index));
    let Some(stays) = stays else {
        return (0..track.len()).filter(inside).map(|index| track.frames[index]).collect();
    };
    let mut frames = Vec::new();
    for stay in stays.iter().filter(|stay| stay.kind.is_rest()) {
        let in_ball: Vec<usize> = stay.dwell.span.clone().filter(inside).collect();
        if 2 * in_ball.len() >= stay.dwell.span.len() || ball.contains(&stay.dwell.center) {
            frames.extend(in_ball.into_iter().map(|index| track.frames[index]));
        }
    }
    frames
}
