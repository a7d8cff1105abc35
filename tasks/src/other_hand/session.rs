//! What is fixed while one task is recorded: what is shown, how often, in what unit, and how well it is seen.

use std::fmt;

use super::dice::Dice;
use super::point::Point;
use crate::task::Unit;

/// What the demonstrations show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Every object goes to a place of its own.
    OwnPlaces,
    /// Objects are stacked, and not always in the same order.
    Stacks,
    /// Objects are parked at an intermediate place and moved on later.
    Parking,
    /// One object is put down at several places.
    Carried,
    /// A drone stops at several places.
    Drone,
    /// An arm takes its poses forwards or backwards.
    Arm,
    /// The same with a third joint.
    ArmOfThree,
}

impl Kind {
    pub(super) fn axes(self) -> &'static [&'static str] {
        match self {
            Kind::Arm => &["j1", "j2"],
            Kind::ArmOfThree => &["j1", "j2", "j3"],
            _ => &["x", "y", "z"],
        }
    }

    /// How freely each axis varies: a table leaves little room upwards.
    pub(super) fn freedom(self) -> Point {
        match self {
            Kind::Arm => [1.0, 1.0, 0.0],
            Kind::Drone | Kind::ArmOfThree => [1.0, 1.0, 1.0],
            _ => [1.0, 1.0, 0.2],
        }
    }

    pub(super) fn is_arm(self) -> bool {
        matches!(self, Kind::Arm | Kind::ArmOfThree)
    }

    /// Whether a hand picks things up from a table.
    pub(super) fn has_hand(self) -> bool {
        !self.is_arm() && self != Kind::Drone
    }
}

/// The knobs of a recording session, in metres (radians) and seconds.
pub(super) struct Session {
    pub(super) kind: Kind,
    pub(super) unit: Unit,
    pub(super) rate_hz: f64,
    pub(super) demonstrations: usize,
    /// What joins the name of a thing to that of an axis.
    pub(super) joint: char,
    /// Deviation of a placement from the spot aimed at, per axis.
    pub(super) scatter: f64,
    /// Deviation of a detection from the truth, per axis.
    pub(super) noise: f64,
    /// Largest slow error of the detections, per axis.
    pub(super) drift: f64,
    /// Share of the frames in which a thing is detected elsewhere.
    pub(super) wild: f64,
    /// Occlusions a second for each thing.
    pub(super) occlusion: f64,
    /// Whether things start from the same spots in every demonstration.
    pub(super) fixed_starts: bool,
}

impl Session {
    pub(super) fn draw(dice: &mut Dice) -> Self {
        let kind = draw_kind(dice);
        Session {
            kind,
            unit: if kind.is_arm() { Unit::Radian } else { dice.pick(&[Unit::Metre, Unit::Millimetre]) },
            rate_hz: dice.pick(&[5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 50.0, 60.0]),
            demonstrations: dice.count(4..=30),
            joint: dice.pick(&['.', '_']),
            scatter: perhaps(dice, 0.85, 0.004),
            noise: perhaps(dice, 0.85, 0.0025),
            drift: perhaps(dice, 0.5, 0.001),
            wild: perhaps(dice, 0.7, 0.008),
            occlusion: perhaps(dice, 0.7, 0.08),
            fixed_starts: dice.chance(0.5),
        }
    }

    /// Least distance between two places of one thing.
    pub(super) fn separation(&self) -> f64 {
        let least = if self.kind.has_hand() { 0.03 } else { 0.3 };
        f64::max(least, 8.0 * (self.scatter + self.noise))
    }

    /// Least distance between the spot a thing starts from and its places.
    pub(super) fn start_gap(&self) -> f64 {
        let least = if self.kind.has_hand() { 0.06 } else { 0.4 };
        least + 8.0 * self.scatter
    }
}

impl fmt::Display for Session {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}, {:?}, {} Hz, ", self.kind, self.unit, self.rate_hz)?;
        write!(f, "{} demonstrations, scatter {:.4}, ", self.demonstrations, self.scatter)?;
        write!(f, "noise {:.4}, drift {:.4}, wild {:.4}, ", self.noise, self.drift, self.wild)?;
        write!(f, "{:.3} occlusions/s, fixed starts {}", self.occlusion, self.fixed_starts)
    }
}

fn draw_kind(dice: &mut Dice) -> Kind {
    let families = [Kind::OwnPlaces, Kind::Stacks, Kind::Parking, Kind::Carried, Kind::Drone, Kind::Arm];
    match dice.pick(&families) {
        Kind::Arm if dice.chance(0.3) => Kind::ArmOfThree,
        kind => kind,
    }
}

/// Uniform up to `most`, or nothing at all.
fn perhaps(dice: &mut Dice, probability: f64, most: f64) -> f64 {
    if dice.chance(probability) { dice.between(0.0, most) } else { 0.0 }
}
