//! For how long a thing stays at one place at least.

use super::Scales;
use super::classes::{Classes, Sum};
use crate::parallel;
use crate::points::{Track, squared_distance};

/// Shortest dwell in frames.
const SHORTEST_DWELL: usize = 3;

/// For how many observed frames a thing stays at one place at least: clearly longer than a passage through that place at
/// the usual speed takes, and at least three.
///
/// # Complexity
///
/// O(frames x features).
pub fn min_dwell(tracks: &[Track], scales: Scales) -> usize {
    let mut speeds = vec![Speeds::default(); tracks.len()];
    min_dwell_by(&mut tracks.iter().zip(&mut speeds).collect::<Vec<_>>(), scales)
}

/// The [`min_dwell`] of tracks, each with its speeds, which may be known from another time.
///
/// # Complexity
///
/// O(frames x features) in the tracks of which the speeds by these scales are not known; O(T log F) in T others of F frames.
pub fn min_dwell_by(tracks: &mut [(&Track, &mut Speeds)], scales: Scales) -> usize {
    let Some(speed) = usual_speed(tracks, scales) else {
        return SHORTEST_DWELL;
    };
    SHORTEST_DWELL.max((5.0 * scales.stillness / speed) as usize)
}

/// How far a moving thing usually gets in a frame, measured over as few frames as the noise allows.
fn usual_speed(tracks: &mut [(&Track, &mut Speeds)], scales: Scales) -> Option<f64> {
    for (step, frames) in [1, 2, 4, 8, 16, 32, 64].into_iter().enumerate() {
        parallel::each(tracks, |(track, speeds)| speeds.measure(step, frames, track, scales.stillness));
        let measured = || tracks.iter().map(|(_, speeds)| &speeds.steps[step]);
        let moving = Sum::of(measured().map(|step| &step.moving));
        if 20 * moving.total() > measured().map(|step| step.pairs).sum() {
            return Some(moving.quantile(0.5) / frames as f64);
        }
    }
    None
}

/// How fast the thing moves in one track, measured over one frame, two frames, four and so on, as far as anybody asked.
#[derive(Clone, Debug, Default)]
pub struct Speeds {
    stillness: f64,
    steps: Vec<Step>,
}

/// Pairs of frames that are so many apart.
#[derive(Clone, Debug)]
struct Step {
    pairs: usize,
    /// How far the thing gets in those in which it moves.
    moving: Classes,
}

impl Speeds {
    fn measure(&mut self, step: usize, frames: usize, track: &Track, stillness: f64) {
        if self.stillness.to_bits() != stillness.to_bits() {
            *self = Self { stillness, steps: Vec::new() };
        }
        if self.steps.len() <= step {
            self.steps.push(Step::measured(frames, track, stillness));
        }
    }
}

impl Step {
    fn measured(frames: usize, track: &Track, stillness: f64) -> Self {
        let ends = (frames..track.len()).map(|to| (to - frames, to));
        let observed = ends.filter(|&(from, to)| track.frame(to) - track.frame(from) == frames);
        let moved = |(from, to)| squared_distance(track.points.point(from), track.points.point(to)).sqrt();
        let mut pairs = 0;
        let moving = observed.map(moved).inspect(|_| pairs += 1).filter(|&moved| moved > 2.0 * stillness);
        Self { moving: Classes::of(moving), pairs }
    }
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
    fn speeds_that_are_known_are_not_measured_again() {
        let way = |step: f64| track(&(0..40).map(|index| step * f64::from(index)).collect::<Vec<_>>());
        let tracks = [way(0.004), way(0.05)];
        let mut speeds = vec![Speeds::default(); 2];
        let mut of = |tracks: &[Track], scales: Scales| {
            min_dwell_by(&mut tracks.iter().zip(&mut speeds).collect::<Vec<_>>(), scales)
        };
        let by_both = of(&tracks, SCALES);
        // Other tracks are not noticed where the speeds are there already.
        assert_eq!(of(&[way(0.9), way(0.9)], SCALES), by_both);
        let wider = Scales { stillness: 0.02, ..SCALES };
        assert_eq!(of(&tracks, wider), min_dwell(&tracks, wider));
    }

    #[test]
    fn of_what_never_moves_three_frames_are_a_dwell() {
        let still = [track(&[0.5; 20]), track(&[])];
        assert_eq!(min_dwell(&still, Scales { noise: 0.0, travel: 0.0, stillness: 0.0 }), SHORTEST_DWELL);
    }
}
