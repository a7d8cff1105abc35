//! Things that come into sight when they have been put down already.

use super::{Kind, SubsetRecording, SubsetStays};
use crate::kd_tree::KdTree;

/// A thing that is first observed when the demonstration is under way did not start where it is first seen, if a third of
/// the demonstrations put it down there: it was hidden while it was brought.
pub(super) fn forgive_late_starts(recording: &SubsetRecording, stays: &mut SubsetStays) {
    let reach = 2.0 * stays.scales.stillness;
    let all = stays.demonstrations.iter().flatten().filter(|stay| stay.kind.is_rest());
    let rests: Vec<&[f64]> = all.map(|stay| stay.dwell.center.as_slice()).collect();
    let rests = KdTree::new(recording.features.len(), &rests);
    let enough = recording.tracks.len().div_ceil(3);
    for (track, of_demonstration) in recording.tracks.iter().zip(&mut stays.demonstrations) {
        let is_late = !track.is_empty() && track.frame(0) >= stays.min_dwell;
        let first = of_demonstration.first_mut().filter(|first| is_late && first.kind == Kind::Start);
        if let Some(first) = first
            && rests.has_within(&first.dwell.center, reach, enough)
        {
            first.kind = Kind::Rest;
        }
    }
}
