//! What is left alone rests: nobody holds a thing while something else is moved, or when the demonstration is over.

use std::ops::RangeInclusive;

use super::{Kind, Stay, SubsetRecording, SubsetStays};
use crate::points::{Track, distance, quantile};

/// A thing has moved when it is further than this share of its travel from where it was: less may be a hand that brushes
/// past it, or a block that is pushed a little by its neighbor.
const MOVED: f64 = 0.1;

/// The shortest of these stays of a subset, so that one chance does not decide.
const SHORT_QUANTILE: f64 = 0.2;

/// Tells which of the rests of all subsets are left alone.
pub(super) fn tell_left_alone(recordings: &[SubsetRecording], subsets: &mut [SubsetStays]) {
    let left_alone: Vec<Vec<Vec<bool>>> =
        (0..subsets.len()).map(|subset| left_alone(recordings, subsets, subset)).collect();
    for (stays, left_alone) in subsets.iter_mut().zip(left_alone) {
        let stays = stays.demonstrations.iter_mut().flatten();
        for (stay, left_alone) in stays.zip(left_alone.into_iter().flatten()) {
            if left_alone && stay.kind == Kind::Rest {
                stay.kind = Kind::LeftAlone;
            }
        }
    }
}

/// For how many frames things are left alone at least; zero where there is one subset only, of which every stay but the
/// last of a demonstration could be a pause.
pub(super) fn shortest_left(recordings: &[SubsetRecording], subsets: &[SubsetStays]) -> f64 {
    if recordings.len() == 1 {
        return 0.0;
    }
    let lengths = recordings
        .iter()
        .zip(subsets)
        .map(|(recording, stays)| stays.lengths(recording, |stay| stay.kind == Kind::LeftAlone));
    let shortest = lengths.filter(|lengths| !lengths.is_empty()).map(|it| quantile(it, SHORT_QUANTILE));
    shortest.fold(f64::INFINITY, f64::min)
}

/// For each demonstration and stay of `subset` whether the thing was left alone.
fn left_alone(recordings: &[SubsetRecording], subsets: &[SubsetStays], subset: usize) -> Vec<Vec<bool>> {
    let of_demonstration = |demonstration: usize| {
        let stays = &subsets[subset].demonstrations[demonstration];
        let frames = &recordings[subset].tracks[demonstration].frames;
        let others = || (0..subsets.len()).filter(|&other| other != subset);
        let is_left_alone = |(index, stay): (usize, &Stay)| {
            let frame_span = frames[stay.dwell.span.start]..=frames[stay.dwell.span.end - 1];
            let moved = |other: usize| {
                let track = &recordings[other].tracks[demonstration];
                moves_within(track, &subsets[other], demonstration, &frame_span)
            };
            index + 1 == stays.len() || others().any(moved)
        };
        stays.iter().enumerate().map(is_left_alone).collect()
    };
    (0..subsets[subset].demonstrations.len()).map(of_demonstration).collect()
}

/// Whether the thing moves from one dwell to another mostly within `frame_span`.
fn moves_within(
    track: &Track,
    subset: &SubsetStays,
    demonstration: usize,
    frame_span: &RangeInclusive<usize>,
) -> bool {
    let far = (4.0 * subset.scales.stillness).max(MOVED * subset.scales.travel);
    subset.demonstrations[demonstration].windows(2).any(|pair| {
        let leaves = track.frames[pair[0].dwell.span.end - 1];
        let arrives = track.frames[pair[1].dwell.span.start];
        let middle = usize::midpoint(leaves, arrives);
        distance(&pair[0].dwell.center, &pair[1].dwell.center) > far && frame_span.contains(&middle)
    })
}

#[cfg(test)]
mod tests {
    use super::super::first_look::first_look;
    use super::super::tests::{kinds, recording};
    use super::*;

    #[test]
    fn a_thing_that_stays_while_another_is_moved_is_left_alone() {
        let red = recording("red", &[&[(0.0, 10), (1.0, 30), (2.0, 10), (3.0, 30)]]);
        let blue = recording("blue", &[&[(0.0, 25), (1.0, 55)]]);
        let recordings = [red, blue];
        let mut subsets: Vec<SubsetStays> = recordings.iter().map(first_look).collect();
        tell_left_alone(&recordings, &mut subsets);
        assert_eq!(kinds(&subsets[0]), [[Kind::Start, Kind::LeftAlone, Kind::Rest, Kind::LeftAlone]]);
        assert_eq!(kinds(&subsets[1]), [[Kind::Start, Kind::LeftAlone]]);
    }
}
