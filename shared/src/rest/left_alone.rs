//! What is left alone rests: nobody holds a thing while something else is moved, or when the demonstration is over.

use std::ops::RangeInclusive;

use super::{Kind, Stay, SubsetRecording, SubsetStays};
use crate::dwell::Dwell;
use crate::points::{Track, distance, quantile};

/// A thing has moved when it is further than this share of its travel from where it was: less may be a hand that brushes
/// past it, or a block that is pushed a little by its neighbor.
const MOVED: f64 = 0.1;

/// The shortest of these stays of a subset, so that one chance does not decide.
const SHORT_QUANTILE: f64 = 0.2;

/// Tells which of the rests of all subsets are left alone.
pub(super) fn tell_left_alone(recordings: &[SubsetRecording], subsets: &mut [SubsetStays]) {
    let moves: Vec<_> =
        recordings.iter().zip(&*subsets).map(|(recording, stays)| moves(recording, stays)).collect();
    let left_alone: Vec<Vec<Vec<bool>>> =
        (0..subsets.len()).map(|subset| left_alone(recordings, subsets, &moves, subset)).collect();
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

/// For each demonstration and stay of `subset` whether the thing was left alone; `moves` are those of each subset.
fn left_alone(
    recordings: &[SubsetRecording],
    subsets: &[SubsetStays],
    moves: &[Vec<Vec<usize>>],
    subset: usize,
) -> Vec<Vec<bool>> {
    let of_demonstration = |demonstration: usize| {
        let stays = &subsets[subset].demonstrations[demonstration];
        let track = &recordings[subset].tracks[demonstration];
        let others = || moves.iter().enumerate().filter(|&(other, _)| other != subset);
        let is_left_alone = |(index, stay): (usize, &Stay)| {
            let frame_span = track.frame(stay.dwell.span.start)..=track.frame(stay.dwell.span.end - 1);
            let has_moved = |moves: &[Vec<usize>]| is_any_within(&moves[demonstration], &frame_span);
            index + 1 == stays.len() || others().any(|(_, moves)| has_moved(moves))
        };
        stays.iter().enumerate().map(is_left_alone).collect()
    };
    (0..subsets[subset].demonstrations.len()).map(of_demonstration).collect()
}

/// For each demonstration the frames in the middle of the moves from one dwell to another, ascending.
fn moves(recording: &SubsetRecording, subset: &SubsetStays) -> Vec<Vec<usize>> {
    let far = (4.0 * subset.scales.stillness).max(MOVED * subset.scales.travel);
    let in_demonstration = |(track, stays): (&Track, &Vec<Stay>)| {
        let pairs = stays.windows(2).map(|pair| [&pair[0].dwell, &pair[1].dwell]);
        let moves = pairs.filter(|[from, to]| distance(&from.center, &to.center) > far);
        let middle = |[from, to]: [&Dwell; 2]| {
            usize::midpoint(track.frame(from.span.end - 1), track.frame(to.span.start))
        };
        moves.map(middle).collect()
    };
    recording.tracks.iter().zip(&subset.demonstrations).map(in_demonstration).collect()
}

/// Whether one of the `ascending` frames is in `span`.
fn is_any_within(ascending: &[usize], span: &RangeInclusive<usize>) -> bool {
    let first = ascending.partition_point(|frame| frame < span.start());
    ascending.get(first).is_some_and(|frame| frame <= span.end())
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
