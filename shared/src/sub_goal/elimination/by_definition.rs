//! What is said of a cluster when every stay is looked at for it, and every ball for its center.

use proptest::prelude::*;

use super::{LONG, SUPPORT_OF_LONG, SUPPORT_OF_UNCLEAR, new_ones, reasons_against};
use crate::dwell::{Dwell, Scales};
use crate::points::{Points, Track, median};
use crate::rest::{Kind, Stay, SubsetRecording, SubsetStays};
use crate::sub_goal::Cluster;
use crate::sub_goal::arranged::tests::{balls, points};

fn reason_against(
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

/// A demonstration for every few of `points`, in which a thing stays at one after the other; some have no stay at all.
fn recorded(
    points: &[Vec<f64>],
    kinds: &[(Kind, usize)],
    a_demonstration: usize,
) -> (SubsetRecording, SubsetStays) {
    let dimension = points.first().map_or(1, Vec::len);
    let stay = |(center, &(kind, frames)): (&Vec<f64>, &(Kind, usize))| Stay {
        dwell: Dwell { span: 0..frames, center: center.clone() },
        kind,
    };
    let stays: Vec<Stay> = points.iter().zip(kinds).map(stay).collect();
    let mut demonstrations: Vec<Vec<Stay>> = stays.chunks(a_demonstration).map(<[Stay]>::to_vec).collect();
    demonstrations.insert(demonstrations.len() / 2, Vec::new());
    let track = |stays: &Vec<Stay>| {
        let rows = stays.iter().flat_map(|stay| stay.dwell.center.clone()).collect();
        Track::observed_throughout(Points::from_rows(dimension, rows))
    };
    let recording = SubsetRecording {
        features: vec![String::new(); dimension],
        tracks: demonstrations.iter().map(track).collect(),
        ..SubsetRecording::default()
    };
    let stays = SubsetStays {
        scales: Scales::default(),
        min_dwell: 1,
        shortest_left: 2.0,
        axis: None,
        demonstrations,
    };
    (recording, stays)
}

fn clusters(points: &[Vec<f64>], radii: &[f64]) -> Vec<Cluster> {
    let balls = balls(points, radii).into_iter().enumerate();
    balls.map(|(number, ball)| Cluster { ball, frames: 1, demonstrations: 1 + number % 4 }).collect()
}

fn kind() -> impl Strategy<Value = Kind> {
    prop_oneof![
        1 => Just(Kind::Start),
        1 => Just(Kind::LeftAlone),
        3 => Just(Kind::Rest),
        5 => Just(Kind::Pause),
    ]
}

proptest! {
    #[test]
    fn reasons_are_those_of_a_look_at_every_stay(
        points in points(),
        kinds in prop::collection::vec((kind(), 1..9_usize), 60),
        radii in prop::collection::vec(0.0..0.6, 5),
        a_demonstration in 1..9_usize,
    ) {
        let (recording, stays) = recorded(&points, &kinds, a_demonstration);
        let clusters = clusters(&points, &radii);
        for stays in [Some(&stays), None] {
            let expected: Vec<_> =
                clusters.iter().map(|cluster| reason_against(cluster, &recording, stays)).collect();
            prop_assert_eq!(reasons_against(&clusters, &recording, stays), expected);
        }
    }

    #[test]
    fn new_ones_have_their_centers_in_no_ball_that_is_shown(
        points in points(), radii in prop::collection::vec(0.0..0.6, 5), shown in 0..60_usize,
    ) {
        let clusters = clusters(&points, &radii);
        let shown: Vec<&Cluster> = clusters.iter().take(shown).step_by(3).collect();
        let others: Vec<Cluster> = clusters.iter().skip(1).step_by(2).cloned().collect();
        let is_new = |it: &&Cluster| !shown.iter().any(|shown| shown.ball.contains(&it.ball.center));
        let expected: Vec<Cluster> = others.iter().filter(is_new).cloned().collect();
        prop_assert_eq!(new_ones(others, &shown), expected);
    }
}
