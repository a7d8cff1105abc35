//! How a random task is moved and seen.

use crate::chance::Chance;
use crate::manner::{Hesitation, Manner, Route, Timing};
use crate::motion::Profile;
use crate::recipe::Notation;
use crate::sensing::Sensing;
use crate::task::Unit;

/// What a random task is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Two to five blocks, each with a place of its own.
    Apart,
    /// Blocks stacked in different orders, so that a block is found on different levels.
    Levels,
    /// Blocks some of which are put down at a first place and later moved to a second.
    Relay,
    /// One block that visits several places.
    Visits,
    /// A drone that stops at several places.
    Drone,
    /// A two-jointed arm that stops at several poses.
    Arm,
}

/// Everything drawn but the scene.
pub(crate) struct Knobs {
    pub(crate) kind: Kind,
    /// How much larger than a table the space is; 1 for tables.
    pub(crate) scale: f64,
    /// Least distance between places of one subset.
    pub(crate) separation: f64,
    pub(crate) manner: Manner,
    pub(crate) sensing: Sensing,
    pub(crate) notation: Notation,
    pub(crate) demonstrations: usize,
    /// Whether things start anywhere in a region, or at the same place each time.
    pub(crate) starts_vary: bool,
}

impl Kind {
    pub(crate) fn draw(chance: &mut Chance) -> Self {
        chance.pick(&[
            Kind::Apart,
            Kind::Apart,
            Kind::Levels,
            Kind::Levels,
            Kind::Relay,
            Kind::Relay,
            Kind::Visits,
            Kind::Visits,
            Kind::Drone,
            Kind::Arm,
        ])
    }

    fn is_agent(self) -> bool {
        matches!(self, Kind::Drone | Kind::Arm)
    }
}

impl Knobs {
    pub(crate) fn draw(kind: Kind, chance: &mut Chance) -> Self {
        let scale = if kind.is_agent() { 5.0 } else { 1.0 };
        let noise = chance.zero_or_up_to(0.2, 0.003);
        let jitter = chance.zero_or_up_to(0.2, 0.004) * if kind.is_agent() { 3.0 } else { 1.0 };
        let separation = (6.0 * (noise + jitter)).max(0.025 * if kind.is_agent() { 10.0 } else { 1.0 });
        Self {
            kind,
            scale,
            separation,
            manner: draw_manner(kind, jitter, separation, chance),
            sensing: draw_sensing(noise, scale, chance),
            notation: draw_notation(kind, chance),
            demonstrations: chance.whole(4, 40).min(chance.whole(4, 40)),
            starts_vary: chance.happens(0.5),
        }
    }
}

fn draw_manner(kind: Kind, jitter: f64, separation: f64, chance: &mut Chance) -> Manner {
    let scale = if kind.is_agent() { 4.0 } else { 1.0 };
    let hovers = !kind.is_agent() && chance.happens(0.5);
    let route = if hovers {
        Route::Lift
    } else if kind.is_agent() {
        chance.pick(&[Route::Straight, Route::Arc])
    } else if kind == Kind::Levels {
        chance.pick(&[Route::Bridge, Route::Lift])
    } else {
        chance.pick(&[Route::Straight, Route::Arc, Route::Bridge, Route::Lift])
    };
    let passes = kind != Kind::Apart && kind != Kind::Levels && chance.happens(0.2);
    let slowest = if kind == Kind::Levels { 0.12 } else { 0.06 };
    let slow = scale * chance.within((slowest, 0.3));
    Manner {
        rate_hz: chance.pick(&[5.0, 8.0, 10.0, 15.0, 20.0, 25.0, 30.0, 60.0]),
        route,
        profile: chance.pick(&[Profile::MinimumJerk, Profile::ConstantSpeed, Profile::Trapezoid]),
        speed: (slow, (slow * chance.within((1.1, 2.0))).max(0.15 * scale)),
        lift: scale * chance.within((0.06, 0.15)),
        hesitation: draw_hesitation(kind, hovers, chance),
        pass_probability: if passes { chance.within((0.1, 0.5)) } else { 0.0 },
        jitter,
        is_airborne: kind.is_agent(),
        clearance: separation.max(0.04 * scale),
        timing: draw_timing(kind, hovers, chance),
    }
}

fn draw_hesitation(kind: Kind, hovers: bool, chance: &mut Chance) -> Hesitation {
    let scale = if kind.is_agent() { 4.0 } else { 1.0 };
    let hover = |chance: &mut Chance| {
        let least = chance.within((0.3, 1.2));
        (least, (least * 1.5).min(1.5))
    };
    let (at_pick, at_place) = chance.pick(&[(true, true), (true, false), (false, true)]);
    // Lowering leads through the levels below which a block was put in other demonstrations; nobody could tell
    // creeping through them from resting there.
    let slowest = if kind == Kind::Levels { 0.1 } else { 0.015 };
    let creeps = kind != Kind::Levels && chance.happens(0.3);
    Hesitation {
        hover_at_pick: if hovers && at_pick { hover(chance) } else { (0.0, 0.0) },
        hover_at_place: if hovers && at_place { hover(chance) } else { (0.0, 0.0) },
        tremor: chance.zero_or_up_to(0.2, 0.003),
        pause_probability: chance.zero_or_up_to(0.6, 0.3),
        approach_speed: scale * chance.within((slowest, 0.15)),
        approach_steps: chance.pick(&[1, 1, 2, 3]),
        approach_length: if creeps { scale * chance.within((0.01, 0.03)) } else { 0.0 },
    }
}

fn draw_timing(kind: Kind, hovers: bool, chance: &mut Chance) -> Timing {
    let lead = chance.within((0.3, 1.5));
    // A block that hovers long before it rests briefly, alone on the table, would rest nowhere in particular.
    let shortest = if hovers && kind == Kind::Visits { 1.2 } else { 0.6 };
    let dwell = chance.within((shortest, 2.5));
    let tail = chance.within((0.3, 2.0));
    Timing {
        lead: (lead, lead * 1.5),
        dwell: (dwell, dwell * chance.within((1.0, 2.0))),
        tail: (tail, tail * 1.5),
    }
}

fn draw_sensing(noise: f64, scale: f64, chance: &mut Chance) -> Sensing {
    Sensing {
        noise,
        wild_probability: chance.zero_or_up_to(0.5, 0.01),
        wild_reach: 0.5 * scale,
        wild_clearance: 0.08 * scale,
        occlusions_per_second: chance.zero_or_up_to(0.5, 0.15),
        longest_occlusion: chance.within((0.1, 2.0)),
    }
}

fn draw_notation(kind: Kind, chance: &mut Chance) -> Notation {
    let is_flat = chance.happens(0.25) && matches!(kind, Kind::Apart | Kind::Relay | Kind::Visits);
    let in_millimetres = chance.happens(0.4);
    Notation {
        separator: chance.pick(&[".", "_"]),
        axes: match kind {
            Kind::Arm => &["q1", "q2"],
            _ if is_flat => &["x", "y"],
            _ => &["x", "y", "z"],
        },
        unit: match kind {
            Kind::Arm => Unit::Radian,
            _ if in_millimetres => Unit::Millimetre,
            _ => Unit::Metre,
        },
    }
}
