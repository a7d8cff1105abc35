//! Sub-goals: clusters of partial states, their balls, and which of them are eliminated.

mod arranged;
mod candidates;
mod clustering;
mod elimination;
mod radius;

use serde::{Deserialize, Serialize};

use crate::dbscan::DbscanParameters;
use crate::parameters::choose_parameters;
use crate::points::{Points, Track};
use crate::rest::{Kind, Stay, SubsetRecording, SubsetStays, stays as find_stays};
use crate::specification::{Ball, SubsetParameters};
use crate::subset::{Setting, SubsetRequest};
use candidates::Candidates;
pub use clustering::Clusterings;
use elimination::{reasons_against, starts_and_pauses};

/// Which frames are clustered, and when a sub-goal counts as reached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Only frames in which a thing rests; a sub-goal is reached when the thing comes to rest in its ball.
    #[default]
    AtRest,
    /// Every frame, and a sub-goal is reached by a single frame in its ball, as published.
    Published,
}

/// How large the ball around a cluster is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RadiusRule {
    /// What the bulk of the cluster's points needs, and never into the ball of a neighbor.
    #[default]
    Robust,
    /// The largest distance of a point to the center, as published.
    Largest,
}

/// A cluster with its ball.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cluster {
    /// The ball around it.
    pub ball: Ball,
    /// How many frames it has.
    pub frames: usize,
    /// How many demonstrations have frames in it.
    pub demonstrations: usize,
}

/// A cluster that is no sub-goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Eliminated {
    /// The cluster.
    pub cluster: Cluster,
    /// Why it is no sub-goal, as a sentence.
    pub reason: String,
}

/// What was found in one subset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
/// the first observed partial state of a demonstration is eliminated, unless the request restores it. With `stays` the
/// eliminated ones also show where demonstrations only start, and where most of them hold the thing on its way.
///
/// # Complexity
///
/// For n partial states of few features that of [`dbscan`] and O(n log n), however many clusters there are, as long as
/// their balls share no more than a few stays: those of the robust rule share none. In many features O(k²) and O(k · s)
/// more for k clusters and s stays. Where a parameter is left to the engine, that of [`choose_parameters`].
pub fn find_sub_goals(
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
    request: &SubsetRequest,
    radius: RadiusRule,
) -> SubGoalSearch {
    find_sub_goals_again(recording, stays, request, radius, &mut Clusterings::default())
}

/// [`find_sub_goals`] where a search before knows of clusters: it is used, and what this one knows put in its place.
///
/// What is found is the same, whatever is known; clusters of which nothing has changed but that a few demonstrations were
/// [added](Clusterings::follow) need not be searched again.
///
/// # Complexity
///
/// At most that of [`find_sub_goals`]; O(n) for n partial states where only a few of them have come, at places that stand
/// alone.
pub fn find_sub_goals_again(
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
    request: &SubsetRequest,
    radius: RadiusRule,
    known: &mut Clusterings,
) -> SubGoalSearch {
    let parameters = parameters(recording, stays, request);
    let density = DbscanParameters { epsilon: parameters.epsilon, min_points: parameters.min_points };
    let candidates = candidates(recording, stays);
    let (mut found, mut eliminated) = (Vec::new(), Vec::new());
    let clusters = candidates.clusters(recording, density, radius, &mut known.places);
    let reasons = reasons_against(&clusters, recording, stays);
    for (cluster, reason) in clusters.into_iter().zip(reasons) {
        match reason {
            Some(reason) => eliminated.push(Eliminated { cluster, reason }),
            None => found.push(cluster),
        }
    }
    if let Some(stays) = stays {
        let others = starts_and_pauses(recording, stays, density, radius, &found, &eliminated, known);
        eliminated.extend(others);
    }
    let is_restored = |cluster: &Cluster| request.restored.iter().any(|point| cluster.ball.contains(point));
    let (restored, eliminated): (Vec<_>, Vec<_>) =
        eliminated.into_iter().partition(|eliminated| is_restored(&eliminated.cluster));
    found.extend(restored.into_iter().map(|restored: Eliminated| restored.cluster));
    SubGoalSearch { parameters, found, eliminated }
}

/// The partial states in which sub-goals are searched: with `stays` those at rest, without every observed one.
///
/// # Complexity
///
/// O(n) for n observed partial states.
pub fn clustered_points(recording: &SubsetRecording, stays: Option<&SubsetStays>) -> Points {
    candidates(recording, stays).into_points()
}

fn candidates(recording: &SubsetRecording, stays: Option<&SubsetStays>) -> Candidates {
    match stays {
        Some(stays) => Candidates::of_stays(recording, stays, Kind::is_rest),
        None => Candidates::every_frame(recording),
    }
}

fn parameters(
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
    request: &SubsetRequest,
) -> SubsetParameters {
    let density = match (request.epsilon, request.min_points) {
        (Setting::Fixed(epsilon), Setting::Fixed(min_points)) => DbscanParameters { epsilon, min_points },
        (epsilon, min_points) => {
            let chosen = parameters_left_to_the_engine(recording, stays);
            DbscanParameters {
                epsilon: epsilon.or(chosen.epsilon),
                min_points: min_points.or(chosen.min_points),
            }
        }
    };
    SubsetParameters {
        name: request.name.clone(),
        features: request.features.clone(),
        epsilon: density.epsilon,
        min_points: density.min_points,
        min_dwell: stays.map_or(1, |stays| stays.min_dwell),
    }
}

/// What [`find_sub_goals`] takes for a parameter that the expert leaves to the engine.
///
/// # Complexity
///
/// That of [`choose_parameters`]; without `stays` they are looked for first.
pub fn parameters_left_to_the_engine(
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
) -> DbscanParameters {
    let dimension = recording.features.len();
    match stays {
        Some(stays) => choose_parameters(stays, dimension),
        None => choose_parameters(&find_stays(std::slice::from_ref(recording))[0], dimension),
    }
}

/// Frames of `track` in which a sub-goal with `ball` holds: every frame in the ball as published, or, with the stays of
/// the demonstration, those of stays that count and are mostly in the ball.
pub fn frames_reached(
    ball: &Ball,
    track: &Track,
    stays: Option<&[Stay]>,
    counts: impl Fn(Kind) -> bool,
) -> Vec<usize> {
    let inside = |&index: &usize| ball.contains(track.points.point(index));
    let Some(stays) = stays else {
        return (0..track.len()).filter(inside).map(|index| track.frame(index)).collect();
    };
    let mut frames = Vec::new();
    for stay in stays.iter().filter(|stay| counts(stay.kind)) {
        let in_ball: Vec<usize> = stay.dwell.span.clone().filter(inside).collect();
        if 2 * in_ball.len() >= stay.dwell.span.len() || ball.contains(&stay.dwell.center) {
            frames.extend(in_ball.into_iter().map(|index| track.frame(index)));
        }
    }
    frames
}
