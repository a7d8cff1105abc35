//! How things are moved: by a steady hand or a hesitant one, over the table or through the air.

use crate::motion::Profile;

/// Lengths in metres (radians for an arm), durations in seconds, spans as (least, most).
#[derive(Clone, Debug)]
pub(crate) struct Manner {
    pub(crate) rate_hz: f64,
    pub(crate) route: Route,
    pub(crate) profile: Profile,
    /// Mean speed of a move.
    pub(crate) speed: (f64, f64),
    /// How high a thing is lifted, or how far an arc bulges.
    pub(crate) lift: f64,
    pub(crate) hesitation: Hesitation,
    /// Probability that a move leads straight through another place of the same thing.
    pub(crate) pass_probability: f64,
    /// How far from its place, along each axis, a thing is put down.
    pub(crate) jitter: f64,
    /// Whether there is no table to keep things from being off along z: a drone, an arm.
    pub(crate) is_airborne: bool,
    /// Places closer than this to where a hand would stop make it stop elsewhere.
    pub(crate) clearance: f64,
    pub(crate) timing: Timing,
}

/// The way from one rest to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Route {
    /// Along the straight line: pushed over the table, or flown.
    Straight,
    /// Along a curve.
    Arc,
    /// Up, across and down without a stop.
    Bridge,
    /// Up, stop, across, stop, down.
    Lift,
}

/// What a hand does besides moving and resting.
#[derive(Clone, Debug)]
pub(crate) struct Hesitation {
    /// How long it holds still above where it picked a thing up.
    pub(crate) hover_at_pick: (f64, f64),
    /// How long it holds still above where it is about to put a thing down.
    pub(crate) hover_at_place: (f64, f64),
    /// Amplitude of its trembling meanwhile.
    pub(crate) tremor: f64,
    /// Probability of a brief stop somewhere on the way.
    pub(crate) pause_probability: f64,
    /// Mean speed of the last bit of the way.
    pub(crate) approach_speed: f64,
    /// Steps in which a thing is lowered.
    pub(crate) approach_steps: usize,
    /// Length of the last bit of a way that does not end with lowering.
    pub(crate) approach_length: f64,
}

/// How long nothing moves.
#[derive(Clone, Debug)]
pub(crate) struct Timing {
    /// Before the first move.
    pub(crate) lead: (f64, f64),
    /// After each placing.
    pub(crate) dwell: (f64, f64),
    /// After the last placing.
    pub(crate) tail: (f64, f64),
}

/// No true rest is shorter than this, in seconds, or than this many frames.
pub(crate) const SHORTEST_REST: (f64, usize) = (0.6, 4);

impl Hesitation {
    /// A sure hand.
    pub(crate) const NONE: Self = Self {
        hover_at_pick: (0.0, 0.0),
        hover_at_place: (0.0, 0.0),
        tremor: 0.0,
        pause_probability: 0.0,
        approach_speed: 0.1,
        approach_steps: 1,
        approach_length: 0.0,
    };
}
