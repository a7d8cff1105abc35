//! Which clusters are no sub-goals, and why.

#[cfg(test)]
mod by_definition;
#[cfg(test)]
mod tests;
mod visits;

use super::arranged::Arranged;
use super::clustering::{Clustering, Clusterings};
use super::{Candidates, Cluster, Eliminated, RadiusRule};
use crate::dbscan::DbscanParameters;
use crate::rest::{Kind, Stay, SubsetRecording, SubsetStays};
use visits::{ArrangedStays, Visit, is_left_alone, typical_length};

/// A place where a thing is never known to be left alone needs this share of the demonstrations, or that share if it
/// stays there about as long as elsewhere: others are stops by chance.
const SUPPORT_OF_UNCLEAR: f64 = 0.5;
const SUPPORT_OF_LONG: f64 = 0.1;

/// A thing stays at a place about as long as elsewhere from this share of the typical length on.
const LONG: f64 = 0.6;

/// Why each of `clusters` is no sub-goal; none of those that are.
///
/// # Complexity
///
/// O(s log s) for s stays of few features, and O(log s) and the stays in its ball for each cluster; of many features O(s)
/// for each.
pub(super) fn reasons_against(
    clusters: &[Cluster],
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
) -> Vec<Option<String>> {
    let dimension = recording.features.len();
    let total = recording.tracks.len();
    let starts = match stays {
        Some(stays) => {
            Arranged::new(dimension, stays.demonstrations.iter().filter_map(|it| rest_at_start(it)))
        }
        None => Arranged::new(dimension, recording.tracks.iter().filter_map(|it| it.points.iter().next())),
    };
    let stays = stays.map(|stays| ArrangedStays::new(dimension, stays));
    let reason = |cluster: &Cluster| match starts.inside(&cluster.ball).len() {
        0 => stays.as_ref().and_then(|stays| reason_in_stays(cluster, stays)),
        starts => Some(format!("{starts} of {total} demonstrations start here")),
    };
    clusters.iter().map(reason).collect()
}

fn reason_in_stays(cluster: &Cluster, stays: &ArrangedStays) -> Option<String> {
    let total = stays.demonstrations;
    let here = stays.inside(&cluster.ball);
    let support = cluster.demonstrations;
    let held = held_only(&here);
    if held > support {
        return Some(format!("{held} of {total} demonstrations hold it here on the way"));
    }
    let needed = support_needed(&here, stays);
    (support < needed).then(|| format!("only {support} of {total} demonstrations rest here"))
}

/// Where a thing is from the start of a demonstration on, if it stays there.
fn rest_at_start(stays: &[Stay]) -> Option<&[f64]> {
    let start = stays.first().filter(|stay| stay.kind == Kind::Start);
    start.map(|stay| stay.dwell.center.as_slice())
}

/// How many demonstrations hold the thing at a place and never put it down there; none if it is left alone there in one.
fn held_only(here: &[Visit]) -> usize {
    if is_left_alone(here) {
        return 0;
    }
    let in_demonstrations = here.chunk_by(|a, b| a.0 == b.0);
    in_demonstrations
        .filter(|visits| {
            let mut kinds = visits.iter().map(|(_, stay)| stay.kind);
            kinds.clone().any(|kind| kind == Kind::Pause) && !kinds.any(Kind::is_rest)
        })
        .count()
}

/// How many demonstrations must rest at a place.
fn support_needed(here: &[Visit], stays: &ArrangedStays) -> usize {
    let is_long = typical_length(here) >= LONG * stays.typical;
    let share = if is_long { SUPPORT_OF_LONG } else { SUPPORT_OF_UNCLEAR };
    match stays.demonstrations {
        0..3 => 1,
        _ if is_left_alone(here) => 2,
        total => 2.max((share * total as f64).ceil() as usize),
    }
}

/// What an expert would look for in vain otherwise: where several demonstrations start, and where at least half of them
/// hold the thing on its way, except in the balls that are there already.
pub(super) fn starts_and_pauses(
    recording: &SubsetRecording,
    stays: &SubsetStays,
    density: DbscanParameters,
    rule: RadiusRule,
    found: &[Cluster],
    eliminated: &[Eliminated],
    known: &mut Clusterings,
) -> Vec<Eliminated> {
    let total = recording.tracks.len();
    let shown_already: Vec<&Cluster> =
        found.iter().chain(eliminated.iter().map(|eliminated| &eliminated.cluster)).collect();
    let shown = |kind: Kind, needed: usize, what: &str, known: &mut Option<Clustering>| -> Vec<Eliminated> {
        let candidates = Candidates::of_stays(recording, stays, |it| it == kind);
        let clusters = candidates.clusters(recording, density, rule, known).into_iter();
        let clusters = clusters.filter(|cluster| cluster.demonstrations >= needed).collect();
        let with_reason = new_ones(clusters, &shown_already).into_iter().map(|cluster| {
            let reason = format!("{} of {total} demonstrations {what}", cluster.demonstrations);
            Eliminated { cluster, reason }
        });
        with_reason.collect()
    };
    let mut all = shown(Kind::Start, 2, "start here", &mut known.starts);
    let most = 2.max(total.div_ceil(2));
    all.extend(shown(Kind::Pause, most, "hold it here on the way", &mut known.pauses));
    all
}

/// Those of `clusters` whose centers are in none of the balls that are shown already.
fn new_ones(clusters: Vec<Cluster>, shown_already: &[&Cluster]) -> Vec<Cluster> {
    let Some(first) = clusters.first() else {
        return clusters;
    };
    let dimension = first.ball.center.len();
    let centers = Arranged::new(dimension, clusters.iter().map(|cluster| cluster.ball.center.as_slice()));
    let mut is_new = vec![true; clusters.len()];
    for position in shown_already.iter().flat_map(|shown| centers.inside(&shown.ball)) {
        is_new[position] = false;
    }
    clusters.into_iter().zip(is_new).filter_map(|(cluster, is_new)| is_new.then_some(cluster)).collect()
}
