//! For how long a thing stays at one place at least.

use super::Scales;
use crate::points::{Track, median, squared_distance};

/// Shortest dwell in frames.
const SHORTEST_DWELL: usize = 3;

/// For how many observed frames a thing stays at one place at least: clearly longer than a passage through that place at
/// the usual speed takes, and at least three.
///
/// # Complexity
///
/// O(frames x features).
pub fn min_dwell(tracks: &[Track], scales: Scales) -> usize {
    let Some(speed) = usual_speed(tracks, scales) else {
        return SHORTEST_DWELL;
    };
    SHORTEST_DWELL.max((5.0 * scales.stillness / speed) as usize)
}

/// How far a moving thing usually gets in a frame, measured over as few frames as the noise allows.
fn usual_speed(tracks: &[Track], scales: Scales) -> Option<f64> {
    for frames in [1, 2, 4, 8, 16, 32, 64] {
        let mut pairs = 0;
        let mut moving = Vec::new();
        for track in tracks {
            for (from, to) in (frames..track.len()).map(|index| (index - frames, index)) {
                if track.frame(to) - track.frame(from) == frames {
                    pairs += 1;
                    let moved = squared_distance(track.points.point(from), track.points.point(to)).sqrt();
                    moving.extend(Some(moved).filter(|&moved| moved > 2.0 * scales.stillness));
                }
            }
        }
        if 20 * moving.len() > pairs {
            return Some(median(moving) / frames as f64);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::tests::{SCALES, track};
    use super::*;

    #[test]
    fn a_dwell_takes_clearly_longer_than_a_passage() {
        let x: Vec<f64> = (0..40).map(|index| 0.004 * f64::from(index)).collect();
        // Eight frames show the speed of 4 thousandths a frame.
        assert_eq!(min_dwell(&[track(&x)], SCALES), 12);
    }

    #[test]
    fn of_what_never_moves_three_frames_are_a_dwell() {
        let still = [track(&[0.5; 20]), track(&[])];
        assert_eq!(min_dwell(&still, Scales { noise: 0.0, travel: 0.0, stillness: 0.0 }), SHORTEST_DWELL);
    }
}
