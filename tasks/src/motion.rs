//! How fast a thing moves along its path, and how a hand trembles.

use crate::chance::Chance;
use crate::geometry::{Point, mix};

/// The course of the speed over a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Profile {
    /// As people reach: slow at both ends (Flash and Hogan 1985).
    MinimumJerk,
    /// As conveyors and simple controllers move: the same speed all the way.
    ConstantSpeed,
    /// As servo drives move: a third of the time accelerating, a third braking.
    Trapezoid,
}

impl Profile {
    /// Share of the way done after a share of the time; both from 0 to 1.
    pub(crate) fn progress(self, time: f64) -> f64 {
        match self {
            Profile::MinimumJerk => time * time * time * (10.0 + time * (6.0 * time - 15.0)),
            Profile::ConstantSpeed => time,
            Profile::Trapezoid if time < 1.0 / 3.0 => 2.25 * time * time,
            Profile::Trapezoid if time > 2.0 / 3.0 => 1.0 - 2.25 * (1.0 - time) * (1.0 - time),
            Profile::Trapezoid => 1.5 * time - 0.25,
        }
    }
}

/// Smooth wandering of a hand that holds still: a new offset every 0.15 s.
///
/// Begins and ends at zero; no coordinate leaves `-amplitude..amplitude`.
pub(crate) fn tremor(frames: usize, rate_hz: f64, amplitude: f64, chance: &mut Chance) -> Vec<Point> {
    const KNOT_S: f64 = 0.15;
    let knots = (frames as f64 / rate_hz / KNOT_S).ceil() as usize + 1;
    let mut offsets = vec![[0.0; 3]; knots + 1];
    for offset in &mut offsets[1..knots.max(2) - 1] {
        *offset = std::array::from_fn(|_| chance.within((-amplitude, amplitude)));
    }
    let sample = |frame: usize| {
        let position = frame as f64 / frames as f64 * (knots - 1) as f64;
        let knot = position as usize;
        let share = Profile::MinimumJerk.progress(position - knot as f64);
        mix(offsets[knot], offsets[knot + 1], share)
    };
    (1..=frames).map(sample).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::distance;

    #[test]
    fn every_profile_starts_at_zero_ends_at_one_and_never_turns_back() {
        for profile in [Profile::MinimumJerk, Profile::ConstantSpeed, Profile::Trapezoid] {
            let course: Vec<f64> = (0..=90).map(|step| profile.progress(f64::from(step) / 90.0)).collect();
            assert!(course.is_sorted(), "{profile:?}");
            assert!(course[0].abs() < 1e-12, "{profile:?}");
            assert!((course[90] - 1.0).abs() < 1e-12, "{profile:?}");
            assert!((course[45] - 0.5).abs() < 1e-12, "{profile:?}");
        }
    }

    #[test]
    fn tremor_stays_within_its_amplitude_and_ends_at_zero() {
        for frames in [1, 2, 3, 10, 60] {
            let offsets = tremor(frames, 30.0, 0.002, &mut Chance::new(3, 0));
            assert_eq!(offsets.len(), frames);
            assert!(distance(offsets[frames - 1], [0.0; 3]) < 1e-12);
            assert!(offsets.iter().flatten().all(|value| value.abs() <= 0.002));
        }
    }
}
