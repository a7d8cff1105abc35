//! Who moves the things, and with what habits.

use std::fmt;

use super::dice::Dice;
use super::point::{Point, add, scale, subtract};
use super::scene::Scene;
use super::session::{Kind, Session};
use super::tape::{Stroke, Tape};
use crate::task::Rest;

/// Habits, in metres (radians) and seconds.
pub(super) struct Operator {
    kind: Kind,
    lift: f64,
    /// Relative spread of lift heights between carries.
    looseness: f64,
    /// Largest sideways detour on the way.
    bow: f64,
    /// Share of a lift that is already transport, when there is no hover between them.
    blend: f64,
    hover: f64,
    jiggle: f64,
    transport_s: (f64, f64),
    pause_s: (f64, f64),
}

/// One demonstration as it truly happened.
pub(super) struct Take {
    /// Frames by things.
    pub(super) frames: Vec<Vec<Point>>,
    pub(super) rests: Vec<Rest>,
    /// The thing of each rest.
    pub(super) resting: Vec<usize>,
}

impl Operator {
    pub(super) fn draw(dice: &mut Dice, kind: Kind) -> Self {
        let (slowest, pause_s) = match kind {
            Kind::Drone => (3.5, (1.0, 3.0)),
            _ if kind.is_arm() => (2.5, (0.8, 2.5)),
            _ => (2.5, (0.6, 2.0)),
        };
        let fast = dice.between(0.8, 1.6);
        Operator {
            kind,
            lift: dice.between(0.06, 0.17),
            looseness: dice.between(0.02, 0.15),
            bow: dice.between(0.0, if kind.has_hand() { 0.05 } else { 0.25 }),
            blend: dice.between(0.0, 0.7),
            hover: dice.pick(&[0.0, 0.3, 0.9]),
            jiggle: if kind.has_hand() { dice.pick(&[0.0, 0.001, 0.002]) } else { 0.0 },
            transport_s: (fast, dice.between(fast, slowest)),
            pause_s,
        }
    }

    /// Shows `word`; `targets` has the point where each spot of the scene is hit this time.
    pub(super) fn perform(
        &self,
        dice: &mut Dice,
        session: &Session,
        scene: &Scene,
        word: &[usize],
        starts: &[Point],
        targets: &[Point],
    ) -> Take {
        let resting: Vec<usize> = word.iter().map(|&place| scene.spots[place].thing).collect();
        let mut tape = Tape::new(session.rate_hz, starts);
        let mut rests: Vec<Rest> = Vec::new();
        tape.wait(dice.between(0.5, 2.0));
        for (rank, (&place, &thing)) in word.iter().zip(&resting).enumerate() {
            self.grasp(dice, &mut tape, thing);
            if let Some(left) = resting[..rank].iter().rposition(|&earlier| earlier == thing) {
                rests[left].frames.end = tape.next_frame();
            }
            let strokes = self.strokes(dice, tape.position(thing), targets[place]);
            tape.play(thing, &strokes);
            rests.push(Rest { place, frames: tape.next_frame()..usize::MAX });
            let last = rank + 1 == word.len();
            let rest_s = if last { (self.pause_s.0.max(0.8), 3.0) } else { self.pause_s };
            tape.wait(dice.within(rest_s));
        }
        let end = tape.next_frame();
        for rest in &mut rests {
            rest.frames.end = rest.frames.end.min(end);
        }
        Take { frames: tape.into_frames(), rests, resting }
    }

    /// The fingers close, which may nudge the thing.
    fn grasp(&self, dice: &mut Dice, tape: &mut Tape, thing: usize) {
        if self.kind.has_hand() {
            let offset = scale(dice.direction([1.0, 1.0, 0.2]), self.jiggle * dice.between(0.5, 1.0));
            tape.wait(dice.between(0.1, 0.2));
            tape.play(thing, &[Stroke { start_s: 0.0, duration_s: dice.between(0.1, 0.3), offset }]);
        }
    }

    fn strokes(&self, dice: &mut Dice, from: Point, to: Point) -> Vec<Stroke> {
        if self.kind.has_hand() { self.carry(dice, from, to) } else { self.glide(dice, from, to) }
    }

    /// Up, perhaps hover, across, perhaps hover, down.
    fn carry(&self, dice: &mut Dice, from: Point, to: Point) -> Vec<Stroke> {
        let height = self.lift * (1.0 + self.looseness * dice.between(-1.0, 1.0));
        let lean = dice.normal_point([0.006, 0.006, 0.0]);
        let lift = Stroke {
            start_s: 0.0,
            duration_s: dice.between(0.35, 0.9),
            offset: add(lean, [0.0, 0.0, height + f64::max(to[2] - from[2], 0.0)]),
        };
        let over = subtract([to[0], to[1], 0.0], [from[0] + lean[0], from[1] + lean[1], 0.0]);
        let (start_s, first_hover) = self.after(dice, &lift);
        let across = Stroke {
            start_s,
            duration_s: dice.within(self.transport_s),
            offset: add(over, dice.normal_point([0.004, 0.004, 0.006])),
        };
        let (start_s, second_hover) = self.after(dice, &across);
        let mut strokes = vec![lift, across];
        strokes.extend(first_hover);
        strokes.extend(second_hover);
        strokes.extend(self.detour(dice, &across));
        let done = strokes.iter().fold(from, |point, stroke| add(point, stroke.offset));
        strokes.push(Stroke { start_s, duration_s: dice.between(0.35, 1.0), offset: subtract(to, done) });
        strokes
    }

    /// When to go on after `stroke`, and how the hand sways if it hovers until then.
    fn after(&self, dice: &mut Dice, stroke: &Stroke) -> (f64, Option<Stroke>) {
        if !dice.chance(self.hover) {
            return (stroke.end_s() - self.blend * 0.35, None);
        }
        let duration_s = dice.between(0.1, 0.5);
        let offset = dice.normal_point([0.003, 0.003, 0.004]);
        let sway = Stroke { start_s: stroke.end_s(), duration_s, offset };
        (sway.end_s(), Some(sway))
    }

    /// Straight there, but for a detour.
    fn glide(&self, dice: &mut Dice, from: Point, to: Point) -> Vec<Stroke> {
        let duration_s = dice.within(self.transport_s);
        let straight = Stroke { start_s: 0.0, duration_s, offset: subtract(to, from) };
        let mut strokes = vec![straight];
        strokes.extend(self.detour(dice, &straight));
        strokes
    }

    /// Out and back while `stroke` lasts.
    fn detour(&self, dice: &mut Dice, stroke: &Stroke) -> [Stroke; 2] {
        let offset = scale(dice.direction(self.kind.freedom()), self.bow * dice.between(0.0, 1.0));
        let duration_s = stroke.duration_s / 2.0;
        let out = Stroke { start_s: stroke.start_s, duration_s, offset };
        [out, Stroke { start_s: out.end_s(), duration_s, offset: scale(offset, -1.0) }]
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.kind.has_hand() {
            write!(f, "lift {:.3} +- {:.2}, blend {:.2}, ", self.lift, self.looseness, self.blend)?;
            write!(f, "hover {}, jiggle {}, ", self.hover, self.jiggle)?;
        }
        write!(f, "bow {:.3}, transport {:.2}-{:.2} s", self.bow, self.transport_s.0, self.transport_s.1)
    }
}
