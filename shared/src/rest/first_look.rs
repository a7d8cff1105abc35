//! The dwells of a subset before anything is known of them but where they are.

use super::{Kind, Stay, SubsetRecording, SubsetStays};
use crate::dwell::{Dwell, Scales, dwells, min_dwell, start_point};
use crate::parallel;
use crate::points::{Track, distance};

/// Dwells of a subset in all demonstrations, all but the starts taken for rests.
///
/// # Complexity
///
/// O(frames x features).
pub fn first_look(recording: &SubsetRecording) -> SubsetStays {
    let scales = recording.scales;
    let min_dwell = min_dwell(&recording.tracks, scales);
    let tracks = &recording.tracks;
    let stays = parallel::map(tracks.len(), |index| stays_of_track(&tracks[index], scales, min_dwell));
    SubsetStays::first(scales, min_dwell, stays)
}

impl SubsetStays {
    /// The stays of a first look at each track.
    pub(crate) fn first(scales: Scales, min_dwell: usize, demonstrations: Vec<Vec<Stay>>) -> Self {
        Self { scales, min_dwell, shortest_left: 0.0, axis: None, demonstrations }
    }
}

/// The stays of a [`first_look`] at one track.
pub(crate) fn stays_of_track(track: &Track, scales: Scales, min_dwell: usize) -> Vec<Stay> {
    let start = start_point(track);
    let mut stays: Vec<Stay> = Vec::new();
    for dwell in dwells(track, scales, min_dwell) {
        let is_start = stays.is_empty() && distance(&dwell.center, &start) <= 2.0 * scales.stillness;
        stays.push(Stay { dwell, kind: if is_start { Kind::Start } else { Kind::Rest } });
    }
    stays.extend(last_moment(track, &stays, scales));
    stays
}

/// The end of a demonstration that ends as soon as the thing arrives: too short for a dwell, but where it is left.
fn last_moment(track: &Track, stays: &[Stay], scales: Scales) -> Option<Stay> {
    let last_end = stays.last().map_or(0, |stay| stay.dwell.span.end);
    if track.len() < 2 || track.len() == last_end {
        return None;
    }
    let end = track.points.point(track.len() - 1);
    let is_far = |&index: &usize| distance(track.points.point(index), end) > scales.stillness;
    let first = (last_end..track.len() - 1).rev().find(is_far).map_or(last_end, |index| index + 1);
    let known = stays.iter().any(|stay| distance(&stay.dwell.center, end) <= scales.stillness);
    let dwell = Dwell { span: first..track.len(), center: end.to_vec() };
    (!known).then_some(Stay { dwell, kind: Kind::Rest })
}

#[cfg(test)]
mod tests {
    use super::super::tests::recording;
    use super::*;

    #[test]
    fn the_first_dwell_is_the_start_and_the_last_moment_is_a_rest() {
        let stays = first_look(&recording("red", &[&[(0.0, 10), (0.5, 1), (1.0, 10), (1.5, 1), (2.0, 1)]]));
        let kinds: Vec<_> =
            stays.demonstrations[0].iter().map(|it| (it.kind, it.dwell.span.clone())).collect();
        assert_eq!(kinds, [(Kind::Start, 0..10), (Kind::Rest, 11..21), (Kind::Rest, 22..23)]);
    }

    #[test]
    fn an_empty_track_has_no_stay() {
        assert_eq!(first_look(&recording("red", &[&[]])).demonstrations, [[]]);
    }
}
