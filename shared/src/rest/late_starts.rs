//! Things that come into sight when they have been put down already.

use super::{Kind, SubsetRecording, SubsetStays};
use crate::points::distance;

/// A thing that is first observed when the demonstration is under way did not start where it is first seen, if a third of
/// the demonstrations put it down there: it was hidden while it was brought.
pub(super) fn forgive_late_starts(recording: &SubsetRecording, stays: &mut SubsetStays) {
    let reach = 2.0 * stays.scales.stillness;
    let all = stays.demonstrations.iter().flatten();
    let rests: Vec<Vec<f64>> =
        all.filter(|stay| stay.kind.is_rest()).map(|stay| stay.dwell.center.clone()).collect();
    for (track, of_demonstration) in recording.tracks.iter().zip(&mut stays.demonstrations) {
        let is_late = track.frames.first().is_some_and(|&first| first >= stays.min_dwell);
        let first = of_demonstration.first_mut().filter(|first| is_late && first.kind == Kind::Start);
        let Some(first) = first else {
            continue;
        };
        let near = rests.iter().filter(|rest| distance(rest, &first.dwell.center) <= reach).count();
        if 3 * near >= recording.tracks.len() {
            first.kind = Kind::Rest;
        }
    }
}
