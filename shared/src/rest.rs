//! Which dwells are rests: places where a thing was put down, not places where it is held or passes.
//!
//! A hand that carries a thing pauses above where it picks and above where it places. Three kinds of evidence tell such a
//! pause from a rest, none of which needs to know what a hand, a table or a height is:
//!
//! 1. What is left alone rests: the thing stays while something else is moved, or to the end of the demonstration.
//! 2. What is known to rest shows how things are put down and taken up: where all arrivals come from one direction and all
//!    departures go back into it (down to the table, up from it), a pause from which the thing goes on *down*, or to which
//!    it came *up*, is a pause in the hand.
//! 3. Where there is no such direction there is no hovering either, and every dwell is a rest.

mod axis;

use crate::dwell::{Dwell, Scales, dwells, min_dwell, scales, start_point, without_wild_detections};
use crate::points::{Track, distance, median, quantile};
pub use axis::Axis;
use axis::{Axes, Verdict};

/// One feature subset in all demonstrations.
#[derive(Clone, Debug)]
pub struct SubsetRecording {
    /// The subset's name.
    pub name: String,
    /// Its features, one per coordinate.
    pub features: Vec<String>,
    /// Its track in each demonstration.
    pub tracks: Vec<Track>,
    /// The scales of its tracks.
    pub scales: Scales,
}

impl SubsetRecording {
    /// The tracks of a subset with their scales.
    pub fn new(name: &str, features: &[String], tracks: Vec<Track>) -> Self {
        let scales = scales(tracks.iter());
        Self { name: name.to_owned(), features: features.to_vec(), tracks, scales }
    }

    /// The recording without the wild detections in its tracks.
    #[must_use]
    pub fn cleaned(&self) -> Self {
        let clean = |track: &Track| without_wild_detections(track, self.scales);
        Self::new(&self.name, &self.features, self.tracks.iter().map(clean).collect())
    }
}

/// What a dwell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The thing has been there from the start of the demonstration.
    Start,
    /// The thing was put down there: it stayed while something else was moved, or to the end of the demonstration.
    LeftAlone,
    /// Nothing speaks against the thing having been put down there.
    Rest,
    /// The thing was held there on its way.
    Pause,
}

impl Kind {
    /// Whether the thing was put down there during the demonstration.
    pub fn is_rest(self) -> bool {
        matches!(self, Self::LeftAlone | Self::Rest)
    }
}

/// A dwell with what it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Stay {
    /// Where and when.
    pub dwell: Dwell,
    /// What it is.
    pub kind: Kind,
}

/// The stays of one subset.
#[derive(Clone, Debug, PartialEq)]
pub struct SubsetStays {
    /// Its scales.
    pub scales: Scales,
    /// For how many observed frames it stays at least.
    pub min_dwell: usize,
    /// The shortest that any thing is seen to be left alone, in frames; zero where this subset is alone.
    pub shortest_left: f64,
    /// The direction in which it is put down, where there is one.
    pub axis: Option<Axis>,
    /// Its stays in each demonstration, in the order of time.
    pub demonstrations: Vec<Vec<Stay>>,
}

/// All stays of all subsets, one entry per recording; the recordings have the same demonstrations.
///
/// # Complexity
///
/// O(frames x features) and, per demonstration, the product of the numbers of dwells of two subsets.
pub fn stays(recordings: &[SubsetRecording]) -> Vec<SubsetStays> {
    let mut subsets: Vec<SubsetStays> = recordings.iter().map(all_dwells).collect();
    let left_alone: Vec<Vec<Vec<bool>>> =
        (0..subsets.len()).map(|subset| left_alone(recordings, &subsets, subset)).collect();
    for (stays, left_alone) in subsets.iter_mut().zip(left_alone) {
        for (stay, left_alone) in
            stays.demonstrations.iter_mut().flatten().zip(left_alone.into_iter().flatten())
        {
            if left_alone && stay.kind == Kind::Rest {
                stay.kind = Kind::LeftAlone;
            }
        }
    }
    let axes = Axes::learn(recordings, &subsets);
    let left = |(recording, stays)| frames_of(recording, stays, |stay| stay.kind == Kind::LeftAlone);
    let left_alone = recordings.iter().zip(&subsets).map(left).filter(|frames| !frames.is_empty());
    let shortest_left = match recordings.len() {
        1 => 0.0,
        _ => left_alone.map(|frames| quantile(frames, 0.2)).fold(f64::INFINITY, f64::min),
    };
    for (stays, (recording, axis)) in subsets.iter_mut().zip(recordings.iter().zip(axes)) {
        stays.axis = axis;
        stays.shortest_left = shortest_left;
        tell_pauses(recording, stays);
        forgive_late_starts(recording, stays);
    }
    subsets
}

/// Dwells of a subset in all demonstrations, all but the starts taken for rests.
fn all_dwells(recording: &SubsetRecording) -> SubsetStays {
    let scales = recording.scales;
    let min_dwell = min_dwell(&recording.tracks, scales);
    let of_track = |track: &Track| {
        let mut stays: Vec<Stay> = Vec::new();
        let start = start_point(track);
        for dwell in dwells(track, scales, min_dwell) {
            let is_start = stays.is_empty() && distance(&dwell.center, &start) <= 2.0 * scales.stillness;
            stays.push(Stay { dwell, kind: if is_start { Kind::Start } else { Kind::Rest } });
        }
        stays.extend(last_moment(track, &stays, scales));
        stays
    };
    let demonstrations = recording.tracks.iter().map(of_track).collect();
    SubsetStays { scales, min_dwell, shortest_left: 0.0, axis: None, demonstrations }
}

/// A thing that is first observed when the demonstration is under way did not start where it is first seen, if other
/// demonstrations put it down there.
fn forgive_late_starts(recording: &SubsetRecording, stays: &mut SubsetStays) {
    let rests: Vec<Vec<f64>> = stays
        .demonstrations
        .iter()
        .flatten()
        .filter(|stay| stay.kind.is_rest())
        .map(|stay| stay.dwell.center.clone())
        .collect();
    for (track, of_demonstration) in recording.tracks.iter().zip(&mut stays.demonstrations) {
        let late = track.frames.first().is_some_and(|&first| first >= stays.min_dwell);
        let Some(first) = of_demonstration.first_mut().filter(|first| late && first.kind == Kind::Start)
        else {
            continue;
        };
        let reach = 2.0 * stays.scales.stillness;
        let near = rests.iter().filter(|rest| distance(rest, &first.dwell.center) <= reach).count();
        if 3 * near >= recording.tracks.len() {
            first.kind = Kind::Rest;
        }
    }
}

/// The end of a demonstration that ends as soon as the thing arrives: too short for a dwell, but where it is left.
fn last_moment(track: &Track, stays: &[Stay], scales: Scales) -> Option<Stay> {
    let last_end = stays.last().map_or(0, |stay| stay.dwell.span.end);
    if track.len() < 2 || track.len() - last_end < 1 {
        return None;
    }
    let end = track.points.point(track.len() - 1);
    let mut first = track.len() - 1;
    while first > last_end && distance(track.points.point(first - 1), end) <= scales.stillness {
        first -= 1;
    }
    let known = stays.iter().any(|stay| distance(&stay.dwell.center, end) <= scales.stillness);
    let dwell = Dwell { span: first..track.len(), center: end.to_vec() };
    (!known).then_some(Stay { dwell, kind: Kind::Rest })
}

/// For each demonstration and stay of `subset` whether the thing was left alone: something else moved meanwhile, or the
/// demonstration ended.
fn left_alone(recordings: &[SubsetRecording], subsets: &[SubsetStays], subset: usize) -> Vec<Vec<bool>> {
    let of_demonstration = |demonstration: usize| {
        let stays = &subsets[subset].demonstrations[demonstration];
        let frames = &recordings[subset].tracks[demonstration].frames;
        let is_left_alone = |(index, stay): (usize, &Stay)| {
            let frame_span = frames[stay.dwell.span.start]..=frames[stay.dwell.span.end - 1];
            let others = (0..subsets.len()).filter(|&other| other != subset);
            let moved = |other: usize| {
                moved_within(
                    &recordings[other].tracks[demonstration],
                    &subsets[other],
                    demonstration,
                    &frame_span,
                )
            };
            index + 1 == stays.len() || others.into_iter().any(moved)
        };
        stays.iter().enumerate().map(is_left_alone).collect()
    };
    (0..subsets[subset].demonstrations.len()).map(of_demonstration).collect()
}

/// Whether the thing moves from one dwell to another mostly within `frame_span`.
fn moved_within(
    track: &Track,
    subset: &SubsetStays,
    demonstration: usize,
    frame_span: &std::ops::RangeInclusive<usize>,
) -> bool {
    let far = (4.0 * subset.scales.stillness).max(0.1 * subset.scales.travel);
    subset.demonstrations[demonstration].windows(2).any(|pair| {
        let leaves = track.frames[pair[0].dwell.span.end - 1];
        let arrives = track.frames[pair[1].dwell.span.start];
        let middle = usize::midpoint(leaves, arrives);
        distance(&pair[0].dwell.center, &pair[1].dwell.center) > far && frame_span.contains(&middle)
    })
}

/// A dwell that is shorter than this share of a typical one is a pause, unless the thing was left alone.
const BRIEF: f64 = 0.3;

/// A dwell that is shorter than this share of a long one, or that share of the shortest time for which things are left
/// alone, and no further from a longer neighbor than this share of the travel, is a step on the way to that.
const STEP: f64 = 0.35;
const STEP_LEFT_ALONE: f64 = 0.6;
const STEP_REACH: f64 = 0.15;

/// Turns into pauses what is not known to be left alone and is brief, a step, or held by what its ways say.
fn tell_pauses(recording: &SubsetRecording, stays: &mut SubsetStays) {
    if let Some(axis) = stays.axis.clone() {
        tell_held(recording, stays, &axis);
    }
    let unclear: Vec<f64> = frames_of(recording, stays, |stay| stay.kind == Kind::Rest);
    let brief = BRIEF * quantile(unclear.clone(), 0.75);
    let step = (STEP * quantile(unclear, 0.75)).max(STEP_LEFT_ALONE * stays.shortest_left);
    let step_reach = STEP_REACH * stays.scales.travel;
    for (track, stays) in recording.tracks.iter().zip(&mut stays.demonstrations) {
        let is_pause = |index: usize| {
            frames_possible(track, &stays[index].dwell) < brief
                || is_step(track, stays, index, step, step_reach)
        };
        let pauses: Vec<bool> = (0..stays.len()).map(is_pause).collect();
        for (stay, is_pause) in stays.iter_mut().zip(pauses) {
            if is_pause && stay.kind == Kind::Rest {
                stay.kind = Kind::Pause;
            }
        }
    }
}

/// Turns into pauses what is held by the ways to it and from it. What those leave open is decided by how long it lasts
/// and whether the thing is known to be put down at that place.
fn tell_held(recording: &SubsetRecording, stays: &mut SubsetStays, axis: &Axis) {
    let verdicts: Vec<Vec<Verdict>> = recording
        .tracks
        .iter()
        .zip(&stays.demonstrations)
        .map(|(track, stays)| (0..stays.len()).map(|index| axis.verdict(track, stays, index)).collect())
        .collect();
    let (mut known, mut proper, mut left) = (Vec::new(), Vec::new(), Vec::new());
    for ((track, stays), verdicts) in recording.tracks.iter().zip(&stays.demonstrations).zip(&verdicts) {
        for (stay, verdict) in stays.iter().zip(verdicts) {
            match (stay.kind, verdict) {
                (Kind::LeftAlone, _) => left.push(frames_possible(track, &stay.dwell)),
                (Kind::Rest, Verdict::PutDown) => proper.push(frames_possible(track, &stay.dwell)),
                _ => continue,
            }
            known.push(stay.dwell.center.clone());
        }
    }
    let long = BRIEF * median(if proper.is_empty() { left } else { proper });
    let near = 2.0 * stays.scales.stillness;
    for ((track, stays), verdicts) in recording.tracks.iter().zip(&mut stays.demonstrations).zip(verdicts) {
        for (stay, verdict) in stays.iter_mut().zip(verdicts).filter(|(stay, _)| stay.kind == Kind::Rest) {
            let is_long = frames_possible(track, &stay.dwell) >= long;
            let is_known = || known.iter().any(|center| distance(center, &stay.dwell.center) <= near);
            let is_rest = match verdict {
                Verdict::PutDown => true,
                Verdict::Slid => is_long,
                Verdict::Unknown => is_long && is_known(),
                Verdict::Held => false,
            };
            if !is_rest {
                stay.kind = Kind::Pause;
            }
        }
    }
}

/// The possible lengths in frames of the stays that `is_wanted`.
fn frames_of(
    recording: &SubsetRecording,
    stays: &SubsetStays,
    is_wanted: impl Fn(&Stay) -> bool,
) -> Vec<f64> {
    let in_all = recording.tracks.iter().zip(&stays.demonstrations);
    let wanted = in_all.flat_map(|(track, stays)| {
        stays.iter().filter(|stay| is_wanted(stay)).map(|stay| frames_possible(track, &stay.dwell))
    });
    wanted.collect()
}

/// For how many frames the thing may have been there, those included in which it was not observed just before and after.
fn frames_possible(track: &Track, dwell: &Dwell) -> f64 {
    let before = dwell.span.start.checked_sub(1).map_or(0, |index| track.frames[index] + 1);
    let after = track.frames.get(dwell.span.end).copied().unwrap_or(track.frames[dwell.span.end - 1] + 1);
    (after - before) as f64
}

/// Whether a stay is a short stop near a longer one.
fn is_step(track: &Track, stays: &[Stay], index: usize, step: f64, reach: f64) -> bool {
    let frames = frames_possible(track, &stays[index].dwell);
    let neighbors =
        [index.checked_sub(1), Some(index + 1)].into_iter().flatten().filter_map(|at| stays.get(at));
    neighbors.into_iter().any(|neighbor| {
        distance(&neighbor.dwell.center, &stays[index].dwell.center) <= reach
            && frames < step.min(STEP_LEFT_ALONE * neighbor.dwell.span.len() as f64)
    })
}
