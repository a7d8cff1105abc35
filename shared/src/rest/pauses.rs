//! Which rests are pauses after all: too brief, a step on the way, or held in the hand by what the ways to them say.

use super::axis::{Axis, Verdict};
use super::{Kind, Stay, SubsetRecording, SubsetStays, frames_possible};
use crate::kd_tree::KdTree;
use crate::points::{Track, distance, median};

/// A dwell that is shorter than this share of a typical one is a pause, unless the thing was left alone.
const BRIEF: f64 = 0.3;

/// A stay that runs into a longer one no further away than this many times what counts as still, is a creep before or
/// after that, if it is shorter than this share of a long one.
const CREEP_REACH: f64 = 3.0;
const CREEP: f64 = 0.6;

/// How many frames lie between two stays that run into each other at most.
const CREEP_GAP: usize = 3;

/// A dwell that is shorter than the first share of a long one, or the second share of the shortest time for which things
/// are left alone, and no further from a longer neighbor than this share of the travel, is a step on the way to that.
const STEP: f64 = 0.35;
const STEP_LEFT_ALONE: f64 = 0.6;
const STEP_REACH: f64 = 0.15;

/// Turns into pauses what is not known to be left alone and is brief, a step, or held by what its ways say.
pub(super) fn tell_pauses(recording: &SubsetRecording, stays: &mut SubsetStays) {
    if let Some(axis) = stays.axis.clone() {
        tell_held(recording, stays, &axis);
    }
    let unclear = stays.lengths(recording, |stay| stay.kind == Kind::Rest);
    let long = typical_of_most_time(unclear);
    let brief = BRIEF * long;
    let step = (STEP * long).max(STEP_LEFT_ALONE * stays.shortest_left);
    let step_reach = STEP_REACH * stays.scales.travel;
    let creep_reach = CREEP_REACH * stays.scales.stillness;
    for (track, stays) in recording.tracks.iter().zip(&mut stays.demonstrations) {
        let is_pause = |index: usize| {
            frames_possible(track, &stays[index].dwell) < brief
                || is_step(track, stays, index, step, step_reach)
                || is_creep(track, stays, index, CREEP * long, creep_reach)
        };
        let pauses: Vec<bool> = (0..stays.len()).map(is_pause).collect();
        for (stay, is_pause) in stays.iter_mut().zip(pauses) {
            if is_pause && stay.kind == Kind::Rest {
                stay.kind = Kind::Pause;
            }
        }
    }
}

/// The length of stay for which half of all time is spent in stays as long or longer: there may be many more pauses than
/// rests, but they do not take more time.
fn typical_of_most_time(mut lengths: Vec<f64>) -> f64 {
    lengths.sort_by(f64::total_cmp);
    let half = lengths.iter().sum::<f64>() / 2.0;
    let mut passed = 0.0;
    let is_half_passed = |length: &f64| {
        passed += length;
        passed >= half
    };
    lengths.iter().copied().find(is_half_passed).unwrap_or(0.0)
}

/// Whether a stay runs into a longer one right beside it: the thing creeps to its place, or from it.
fn is_creep(track: &Track, stays: &[Stay], index: usize, creep: f64, reach: f64) -> bool {
    let frames = frames_possible(track, &stays[index].dwell);
    let runs_on = |pair: &[Stay]| {
        let [earlier, later] = [&pair[0].dwell, &pair[1].dwell];
        let gap = track.frame(later.span.start) - track.frame(earlier.span.end - 1);
        gap <= CREEP_GAP && distance(&earlier.center, &later.center) <= reach
    };
    let is_longer = |stay: &Stay| stay.dwell.span.len() as f64 > frames;
    let from_before =
        index.checked_sub(1).is_some_and(|at| is_longer(&stays[at]) && runs_on(&stays[at..=index]));
    let on_after =
        stays.get(index + 1).is_some_and(|after| is_longer(after) && runs_on(&stays[index..=index + 1]));
    frames < creep && (from_before || on_after)
}

/// Whether a stay is a short stop near a longer one.
fn is_step(track: &Track, stays: &[Stay], index: usize, step: f64, reach: f64) -> bool {
    let frames = frames_possible(track, &stays[index].dwell);
    let neighbors = [index.checked_sub(1), Some(index + 1)].into_iter().flatten();
    neighbors.filter_map(|at| stays.get(at)).any(|neighbor| {
        distance(&neighbor.dwell.center, &stays[index].dwell.center) <= reach
            && frames < step.min(STEP_LEFT_ALONE * neighbor.dwell.span.len() as f64)
    })
}

/// Turns into pauses what is held by the ways to it and from it. What those leave open is decided by how long it lasts
/// and whether the thing is known to be put down at that place.
fn tell_held(recording: &SubsetRecording, stays: &mut SubsetStays, axis: &Axis) {
    let in_tracks = recording.tracks.iter().zip(&stays.demonstrations);
    let verdicts: Vec<Vec<Verdict>> = in_tracks
        .map(|(track, stays)| (0..stays.len()).map(|index| axis.verdict(track, stays, index)).collect())
        .collect();
    let known = PutDown::learn(recording, stays, &verdicts);
    for ((track, stays), verdicts) in recording.tracks.iter().zip(&mut stays.demonstrations).zip(verdicts) {
        for (stay, verdict) in stays.iter_mut().zip(verdicts).filter(|(stay, _)| stay.kind == Kind::Rest) {
            let is_long = frames_possible(track, &stay.dwell) >= known.long;
            let is_rest = match verdict {
                Verdict::PutDown => true,
                Verdict::Slid => is_long,
                Verdict::Unknown => is_long && known.is_near(&stay.dwell.center),
                Verdict::Held => false,
            };
            if !is_rest {
                stay.kind = Kind::Pause;
            }
        }
    }
}

/// What is seen of a thing that is put down for sure.
struct PutDown {
    centers: KdTree,
    /// Within this distance of a center it is the same place.
    near: f64,
    /// A stay of this many frames is no passing pause.
    long: f64,
}

impl PutDown {
    fn learn(recording: &SubsetRecording, stays: &SubsetStays, verdicts: &[Vec<Verdict>]) -> Self {
        let (mut centers, mut proper, mut left) = (Vec::new(), Vec::new(), Vec::new());
        for ((track, stays), verdicts) in recording.tracks.iter().zip(&stays.demonstrations).zip(verdicts) {
            for (stay, verdict) in stays.iter().zip(verdicts) {
                match (stay.kind, verdict) {
                    (Kind::LeftAlone, _) => left.push(frames_possible(track, &stay.dwell)),
                    (Kind::Rest, Verdict::PutDown) => proper.push(frames_possible(track, &stay.dwell)),
                    _ => continue,
                }
                centers.push(stay.dwell.center.as_slice());
            }
        }
        let long = BRIEF * median(if proper.is_empty() { left } else { proper });
        let centers = KdTree::new(recording.features.len(), &centers);
        Self { centers, near: 2.0 * stays.scales.stillness, long }
    }

    fn is_near(&self, point: &[f64]) -> bool {
        self.centers.has_within(point, self.near, 1)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{kinds, recording};
    use super::super::{Kind, stays};
    use super::typical_of_most_time;

    #[test]
    fn a_dwell_that_is_brief_beside_the_others_is_a_pause() {
        let track: &[(f64, usize)] =
            &[(0.0, 20), (0.4, 1), (0.8, 4), (1.4, 1), (2.0, 30), (2.5, 1), (3.0, 30), (3.5, 1), (4.0, 30)];
        let expected = [Kind::Start, Kind::Pause, Kind::Rest, Kind::Rest, Kind::LeftAlone];
        assert_eq!(kinds(&stays(&[recording("red", &[track])])[0]), [expected]);
    }

    #[test]
    fn a_stay_that_runs_into_a_longer_one_is_a_creep() {
        let track: &[(f64, usize)] =
            &[(0.0, 20), (0.9, 1), (1.85, 15), (2.0, 31), (3.0, 1), (4.0, 30), (5.0, 1), (6.0, 30)];
        let expected = [Kind::Start, Kind::Pause, Kind::Rest, Kind::Rest, Kind::LeftAlone];
        assert_eq!(kinds(&stays(&[recording("red", &[track])])[0]), [expected]);
    }

    #[test]
    fn many_pauses_do_not_make_rests_look_brief() {
        assert!((typical_of_most_time(vec![3.0, 3.0, 60.0, 3.0, 3.0, 3.0, 3.0, 3.0]) - 60.0).abs() < 1e-12);
        assert!(typical_of_most_time(Vec::new()).abs() < 1e-12);
    }

    #[test]
    fn a_short_stop_near_a_longer_one_is_a_step_on_the_way() {
        let track: &[(f64, usize)] =
            &[(0.0, 20), (0.9, 1), (1.9, 10), (2.0, 31), (3.0, 1), (4.0, 30), (5.0, 1), (6.0, 30)];
        let expected = [Kind::Start, Kind::Pause, Kind::Rest, Kind::Rest, Kind::LeftAlone];
        assert_eq!(kinds(&stays(&[recording("red", &[track])])[0]), [expected]);
    }
}
