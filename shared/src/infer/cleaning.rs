//! Tracks taken apart into wild detections and the rest, such that they can be put together again: the next inference may
//! draw the line elsewhere.

use crate::points::Track;

/// The wild detections of a track.
#[derive(Clone, Debug, Default)]
pub(super) struct Wild {
    /// Their positions in the whole track, ascending.
    pub(super) positions: Vec<usize>,
    observations: Track,
}

/// `track` without the observations at `wild_positions`, which are ascending, and those alone. Nothing is copied where
/// there are none.
pub(super) fn split(track: Track, wild_positions: &[usize]) -> (Track, Wild) {
    let mut observations = Track::unobserved(track.points.dimension());
    for &position in wild_positions {
        observations.push(track.frame(position), track.points.point(position));
    }
    (track.without(wild_positions), Wild { positions: wild_positions.to_vec(), observations })
}

/// The track that was [`split`]. Nothing is copied where nothing was wild.
pub(super) fn joined(tame: Track, wild: &Wild) -> Track {
    if wild.positions.is_empty() {
        return tame;
    }
    let mut track = Track::unobserved(tame.points.dimension());
    let (mut next_tame, mut next_wild) = (0, 0);
    for position in 0..tame.len() + wild.positions.len() {
        let is_wild = wild.positions.get(next_wild) == Some(&position);
        let (from, next) =
            if is_wild { (&wild.observations, &mut next_wild) } else { (&tame, &mut next_tame) };
        track.push(from.frame(*next), from.points.point(*next));
        *next += 1;
    }
    track
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
            let mut track = Track::unobserved(1);
            for &frame in frames.keys() {
                track.push(frame, &[frame as f64]);
            }
            let is_wild: Vec<bool> = frames.into_values().collect();
            let positions: Vec<usize> = (0..is_wild.len()).filter(|&position| is_wild[position]).collect();
            let (tame, wild) = split(track.clone(), &positions);
            prop_assert_eq!(tame.len() + positions.len(), track.len());
            prop_assert_eq!(joined(tame, &wild), track);
        }
    }
}
