//! Which clusters are no sub-goals, and why.

use super::clustering::{Clustering, Clusterings};
use super::{Candidates, Cluster, Eliminated, RadiusRule};
use crate::dbscan::DbscanParameters;
use crate::points::{Track, median};
use crate::rest::{Kind, Stay, SubsetRecording, SubsetStays};

/// A place where a thing is never known to be left alone needs this share of the demonstrations, or that share if it
/// stays there about as long as elsewhere: others are stops by chance.
const SUPPORT_OF_UNCLEAR: f64 = 0.5;
const SUPPORT_OF_LONG: f64 = 0.1;

/// A thing stays at a place about as long as elsewhere from this share of the typical length on.
const LONG: f64 = 0.6;

/// Why a cluster is no sub-goal, if it is none.
pub(super) fn reason_against(
    cluster: &Cluster,
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
) -> Option<String> {
    let starts = stays.map_or_else(
        || recording.tracks.iter().filter(|track| starts_inside(track, cluster)).count(),
        |stays| stays.demonstrations.iter().filter(|stays| rests_from_start(stays, cluster)).count(),
    );
    let total = recording.tracks.len();
    if starts > 0 {
        return Some(format!("{starts} of {total} demonstrations start here"));
    }
    let stays = stays?;
    let needed = support_needed(cluster, stays);
    let support = cluster.demonstrations;
    let held = held_only(cluster, stays);
    if held > support {
        return Some(format!("{held} of {total} demonstrations hold it here on the way"));
    }
    (support < needed).then(|| format!("only {support} of {total} demonstrations rest here"))
}

fn starts_inside(track: &Track, cluster: &Cluster) -> bool {
    track.points.iter().next().is_some_and(|first| cluster.ball.contains(first))
}

fn rests_from_start(stays: &[Stay], cluster: &Cluster) -> bool {
    let first = stays.first();
    first.is_some_and(|stay| stay.kind == Kind::Start && cluster.ball.contains(&stay.dwell.center))
}

/// How many demonstrations hold the thing at a place and never put it down there; none if it is left alone there in one.
fn held_only(cluster: &Cluster, stays: &SubsetStays) -> usize {
    let here = |stay: &&Stay| cluster.ball.contains(&stay.dwell.center);
    let kinds = |stays: &[Stay]| stays.iter().filter(here).map(|stay| stay.kind).collect::<Vec<_>>();
    let all: Vec<Vec<Kind>> = stays.demonstrations.iter().map(|stays| kinds(stays)).collect();
    if all.iter().flatten().any(|&kind| kind == Kind::LeftAlone) {
        return 0;
    }
    all.iter()
        .filter(|kinds| kinds.contains(&Kind::Pause) && !kinds.iter().any(|kind| kind.is_rest()))
        .count()
}

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
    let is_new = |cluster: &Cluster| {
        let mut known = found.iter().chain(eliminated.iter().map(|eliminated| &eliminated.cluster));
        !known.any(|known| known.ball.contains(&cluster.ball.center))
    };
    let shown = |kind: Kind, needed: usize, what: &str, known: &mut Option<Clustering>| -> Vec<Eliminated> {
        let candidates = Candidates::of_stays(recording, stays, |it| it == kind);
        let clusters = candidates.clusters(recording, density, rule, known).into_iter();
        let clusters = clusters.filter(|cluster| cluster.demonstrations >= needed && is_new(cluster));
        let with_reason = clusters.map(|cluster| {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Points;
    use crate::rest::stays;
    use crate::sub_goal::{SubGoalSearch, find_sub_goals};
    use crate::subset::{Setting, SubsetRequest};

    /// A thing on a line: in each demonstration, where it is and for how many frames.
    fn recording(demonstrations: &[&[(f64, usize)]]) -> SubsetRecording {
        let track = |stretches: &&[(f64, usize)]| {
            let x: Vec<f64> = stretches.iter().flat_map(|&(x, frames)| vec![x; frames]).collect();
            Track::observed_throughout(Points::from_rows(1, x))
        };
        SubsetRecording::new("red", &["red.x".to_owned()], demonstrations.iter().map(track).collect())
    }

    fn request(epsilon: Setting<f64>, min_points: Setting<usize>) -> SubsetRequest {
        let features = vec!["red.x".to_owned()];
        SubsetRequest { name: "red".to_owned(), features, epsilon, min_points, restored: Vec::new() }
    }

    fn centers(search: &SubGoalSearch) -> Vec<f64> {
        search.found.iter().map(|cluster| cluster.ball.center[0]).collect()
    }

    fn reasons(search: &SubGoalSearch) -> Vec<(f64, &str)> {
        let pairs = search.eliminated.iter();
        pairs.map(|it| (it.cluster.ball.center[0], it.reason.as_str())).collect()
    }

    fn at_rest(demonstrations: &[&[(f64, usize)]]) -> SubGoalSearch {
        let recording = recording(demonstrations);
        let stays = &stays(std::slice::from_ref(&recording))[0];
        find_sub_goals(&recording, Some(stays), &request(Setting::Auto, Setting::Auto), RadiusRule::Robust)
    }

    #[test]
    fn a_cluster_that_holds_the_first_observed_state_is_eliminated() {
        let recording =
            recording(&[&[(0.0, 10), (0.5, 1), (1.0, 10)], &[(0.0, 10), (1.0, 10)], &[(1.0, 10)]]);
        let request = request(Setting::Fixed(0.1), Setting::Fixed(5));
        let search = find_sub_goals(&recording, None, &request, RadiusRule::Largest);
        assert_eq!(centers(&search), [0.0; 0]);
        let expected = [(0.0, "2 of 3 demonstrations start here"), (1.0, "1 of 3 demonstrations start here")];
        assert_eq!(reasons(&search), expected);
    }

    #[test]
    fn places_where_demonstrations_only_start_are_shown() {
        let way: &[(f64, usize)] = &[(0.0, 20), (0.5, 1), (1.0, 20)];
        let search = at_rest(&[way, way, way]);
        assert_eq!(centers(&search), [1.0]);
        assert_eq!(reasons(&search), [(0.0, "3 of 3 demonstrations start here")]);
    }

    #[test]
    fn an_eliminated_cluster_is_a_sub_goal_again_when_the_expert_restores_it() {
        let way: &[(f64, usize)] = &[(0.0, 20), (0.5, 1), (1.0, 20)];
        let recording = recording(&[way, way, way]);
        let stays = &stays(std::slice::from_ref(&recording))[0];
        let mut request = request(Setting::Auto, Setting::Auto);
        request.restored = vec![vec![0.0]];
        let search = find_sub_goals(&recording, Some(stays), &request, RadiusRule::Robust);
        assert_eq!(centers(&search), [1.0, 0.0]);
        assert_eq!(reasons(&search), []);
    }

    #[test]
    fn a_start_of_one_demonstration_alone_is_not_shown() {
        let search = at_rest(&[&[(0.0, 20), (0.5, 1), (1.0, 20)], &[(0.2, 20), (0.5, 1), (1.0, 20)]]);
        assert_eq!(centers(&search), [1.0]);
        assert_eq!(reasons(&search), []);
    }

    #[test]
    fn pauses_of_most_demonstrations_are_shown() {
        let pauses: &[(f64, usize)] =
            &[(0.0, 30), (0.5, 1), (1.0, 5), (1.5, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
        let search = at_rest(&[pauses, pauses, pauses]);
        assert_eq!(centers(&search), [2.0, 3.0]);
        let expected = [
            (0.0, "3 of 3 demonstrations start here"),
            (1.0, "3 of 3 demonstrations hold it here on the way"),
        ];
        assert_eq!(reasons(&search), expected);
    }

    #[test]
    fn a_place_where_more_demonstrations_pause_than_rest_is_eliminated() {
        let pause: &[(f64, usize)] =
            &[(0.0, 30), (0.5, 1), (1.0, 5), (1.5, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
        let rest: &[(f64, usize)] =
            &[(0.0, 30), (0.5, 1), (1.0, 30), (1.5, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
        let search = at_rest(&[pause, pause, pause, rest, rest]);
        assert_eq!(centers(&search), [2.0, 3.0]);
        assert_eq!(reasons(&search)[0], (1.0, "3 of 5 demonstrations hold it here on the way"));
    }

    #[test]
    fn a_stop_of_one_demonstration_is_eliminated() {
        let way: &[(f64, usize)] = &[(0.0, 30), (1.0, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
        let stop: &[(f64, usize)] = &[(0.0, 30), (1.0, 30), (1.5, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
        let search = at_rest(&[way, way, way, stop]);
        assert_eq!(centers(&search), [2.0, 3.0]);
        assert_eq!(reasons(&search)[0], (1.0, "only 1 of 4 demonstrations rest here"));
    }
}
