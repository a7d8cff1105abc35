//! Tracks taken apart into wild detections and the rest, such that they can be put together again: the next inference may
//! draw the line elsewhere.

use crate::dwell::{Scales, without_wild_detections};
use crate::points::{Points, Track};

/// The frames of `track` that are wild detections on these scales, ascending.
pub(super) fn wild_frames(track: &Track, scales: Scales) -> Vec<usize> {
    let tame = without_wild_detections(track, scales).frames;
    if tame.len() == track.len() {
        return Vec::new();
    }
    let mut tame = tame.into_iter().peekable();
    track.frames.iter().copied().filter(|frame| tame.next_if_eq(frame).is_none()).collect()
}

/// `track` without `wild_frames`, and those alone. Nothing is copied where there are none.
pub(super) fn split(track: Track, wild_frames: &[usize]) -> (Track, Track) {
    let dimension = track.points.dimension();
    if wild_frames.is_empty() {
        return (track, none(dimension));
    }
    let (mut tame, mut wild) = (none(dimension), none(dimension));
    let mut next_wild = wild_frames.iter().peekable();
    for (frame, point) in track.frames.iter().zip(track.points.iter()) {
        let part = if next_wild.next_if_eq(&frame).is_some() { &mut wild } else { &mut tame };
        part.frames.push(*frame);
        part.points.push(point);
    }
    (tame, wild)
}

/// The track that was [`split`]. Nothing is copied where nothing was wild.
pub(super) fn joined(tame: Track, wild: &Track) -> Track {
    if wild.is_empty() {
        return tame;
    }
    let mut track = none(wild.points.dimension());
    let mut wild_points = wild.frames.iter().zip(wild.points.iter()).peekable();
    for (frame, point) in tame.frames.iter().zip(tame.points.iter()) {
        while let Some((frame, point)) = wild_points.next_if(|(wild_frame, _)| *wild_frame < frame) {
            track.frames.push(*frame);
            track.points.push(point);
        }
        track.frames.push(*frame);
        track.points.push(point);
    }
    for (frame, point) in wild_points {
        track.frames.push(*frame);
        track.points.push(point);
    }
    track
}

fn none(dimension: usize) -> Track {
    Track { frames: Vec::new(), points: Points::new(dimension) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn what_was_split_is_joined_again(
            frames in proptest::collection::btree_map(0_usize..99, any::<bool>(), 0..20),
        ) {
            let coordinates = frames.keys().map(|&frame| frame as f64).collect();
            let points = Points::from_rows(1, coordinates);
            let track = Track { frames: frames.keys().copied().collect(), points };
            let wild: Vec<usize> = frames.iter().filter(|(_, is_wild)| **is_wild).map(|(&frame, _)| frame).collect();
            let (tame, wild_track) = split(track.clone(), &wild);
            prop_assert_eq!(&wild_track.frames, &wild);
            prop_assert_eq!(joined(tame, &wild_track), track);
        }
    }

    #[test]
    fn the_wild_frames_are_those_that_cleaning_leaves_out() {
        let x = [0.0, 0.0, 0.0, 0.7, 0.0, 0.0, 0.0];
        let track = Track { frames: (10..17).collect(), points: Points::from_rows(1, x.to_vec()) };
        assert_eq!(wild_frames(&track, Scales { noise: 0.001, travel: 1.0, stillness: 0.01 }), [13]);
    }
}
