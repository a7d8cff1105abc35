//! Which dwells are rests: places where a thing was put down, not places where it is held or passes.
//!
//! A hand that carries a thing pauses above where it picks and above where it places. Three kinds of evidence tell such a
//! pause from a rest, none of which needs to know what a hand, a table or a height is:
//!
//! 1. What is left alone rests: the thing stays while something else is moved, or to the end of the demonstration.
//! 2. What is known to rest shows how things are put down and taken up: where all arrivals come from one direction and all
//!    departures go back into it (down to the table, up from it), a pause from which the thing goes on *down*, or to which
//!    it came *up*, is a pause in the hand.
//!    Where one thing alone shows the direction, that must account for its other stays, too: its way may bend back by
//!    chance.
//! 3. Where there is no such direction there is no hovering either, and every dwell is a rest that is not brief beside
//!    those that take most of the time, a step on the way, or a creep into the next.

mod axis;
mod first_look;
mod late_starts;
mod left_alone;
mod pauses;

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::dwell::{Dwell, Scales, scales, wild_detections};
use crate::parallel;
use crate::points::Track;
pub use axis::Axis;
pub use first_look::first_look;
pub(crate) use first_look::stays_of_track;
use late_starts::forgive_late_starts;
use left_alone::{shortest_left, tell_left_alone};
use pauses::tell_pauses;

/// One feature subset in all demonstrations.
#[derive(Clone, Debug, Default)]
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
        let scales = scales(&tracks);
        Self { name: name.to_owned(), features: features.to_vec(), tracks, scales }
    }

    /// The recording without the wild detections in its tracks.
    ///
    /// # Complexity
    ///
    /// O(frames x features); tracks in which nothing is wild stay where they are.
    #[must_use]
    pub fn cleaned(self) -> Self {
        let wild =
            parallel::map(self.tracks.len(), |index| wild_detections(&self.tracks[index], self.scales));
        if wild.iter().all(Vec::is_empty) {
            return self;
        }
        let clean = |(track, wild): (Track, Vec<usize>)| track.without(&wild);
        let tracks: Vec<Track> = self.tracks.into_iter().zip(wild).map(clean).collect();
        Self { scales: scales(&tracks), tracks, ..self }
    }
}

/// What a dwell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stay {
    /// Where and when.
    pub dwell: Dwell,
    /// What it is.
    pub kind: Kind,
}

/// The stays of one subset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

impl SubsetStays {
    /// The possible lengths in frames of the stays that `is_wanted`.
    fn lengths(&self, recording: &SubsetRecording, is_wanted: impl Fn(&Stay) -> bool) -> Vec<f64> {
        let in_all = recording.tracks.iter().zip(&self.demonstrations);
        let wanted = in_all.flat_map(|(track, stays)| {
            stays.iter().filter(|stay| is_wanted(stay)).map(|stay| frames_possible(track, &stay.dwell))
        });
        wanted.collect()
    }
}

/// For how many frames the thing may have been there, those included in which it was not observed just before and after.
fn frames_possible(track: &Track, dwell: &Dwell) -> f64 {
    let before = dwell.span.start.checked_sub(1).map_or(0, |position| track.frame(position) + 1);
    let Range { end, .. } = dwell.span;
    let after = if end < track.len() { track.frame(end) } else { track.frame(end - 1) + 1 };
    (after - before) as f64
}

/// All stays of all subsets, one entry per recording; the recordings have the same demonstrations.
///
/// # Complexity
///
/// O(frames x features) and, per demonstration, the product of the numbers of dwells of two subsets.
pub fn stays(recordings: &[SubsetRecording]) -> Vec<SubsetStays> {
    tell_kinds(recordings, recordings.iter().map(first_look).collect())
}

/// The stays of a [first look](first_look) at each of `recordings`, told apart by what all subsets together show.
///
/// Of the tracks it looks at the frames around the dwells and on the ways between them.
///
/// # Complexity
///
/// Per demonstration, the product of the numbers of dwells of two subsets.
pub fn tell_kinds(recordings: &[SubsetRecording], mut subsets: Vec<SubsetStays>) -> Vec<SubsetStays> {
    tell_left_alone(recordings, &mut subsets);
    let axes = axis::learn(recordings, &subsets);
    let shortest_left = shortest_left(recordings, &subsets);
    for (stays, (recording, axis)) in subsets.iter_mut().zip(recordings.iter().zip(axes)) {
        stays.axis = axis;
        stays.shortest_left = shortest_left;
        tell_pauses(recording, stays);
        forgive_late_starts(recording, stays);
    }
    subsets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Points;

    /// A thing on a line: in each demonstration, where it is and for how many frames.
    pub(super) fn recording(name: &str, demonstrations: &[&[(f64, usize)]]) -> SubsetRecording {
        let track = |stretches: &&[(f64, usize)]| {
            let x: Vec<f64> = stretches.iter().flat_map(|&(x, frames)| vec![x; frames]).collect();
            Track::observed_throughout(Points::from_rows(1, x))
        };
        SubsetRecording::new(name, &[format!("{name}.x")], demonstrations.iter().map(track).collect())
    }

    pub(super) fn kinds(stays: &SubsetStays) -> Vec<Vec<Kind>> {
        stays.demonstrations.iter().map(|stays| stays.iter().map(|stay| stay.kind).collect()).collect()
    }

    #[test]
    fn a_thing_that_never_moves_only_starts() {
        let stays = stays(&[recording("red", &[&[(1.0, 30)], &[(2.0, 1)]])]);
        assert_eq!(kinds(&stays[0]), [vec![Kind::Start], vec![]]);
    }
}
