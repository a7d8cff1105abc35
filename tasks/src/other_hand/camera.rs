//! What the camera makes of a take: noise, drift, wild detections and occlusions.

use std::ops::Range;

use super::dice::Dice;
use super::operator::Take;
use super::point::{Point, add, scale, subtract};
use super::session::Session;

/// Seconds between two independent values of the drift.
const DRIFT_S: f64 = 4.0;

/// How one thing is detected in one frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sight {
    Seen,
    Wild,
    Hidden,
}

/// Frames by features, in the unit of the session; NaN where a thing is hidden.
pub(super) fn film(dice: &mut Dice, session: &Session, take: &Take) -> Vec<Vec<f64>> {
    let things = take.frames.first().map_or(0, Vec::len);
    let mut sights = vec![vec![Sight::Seen; take.frames.len()]; things];
    for thing in 0..things {
        hide(dice, session, take, &mut sights, thing);
        mislead(dice, session, take, &mut sights, thing);
    }
    let drifts: Vec<Vec<Point>> = (0..things).map(|_| drift(dice, session, take.frames.len())).collect();
    let mut film = Vec::with_capacity(take.frames.len());
    for (frame, points) in take.frames.iter().enumerate() {
        let mut row = Vec::new();
        for (thing, &point) in points.iter().enumerate() {
            let point = detect(dice, session, add(point, drifts[thing][frame]), sights[thing][frame]);
            let axes = session.kind.axes().len();
            row.extend(point[..axes].iter().map(|value| value * session.unit.per_base()));
        }
        film.push(row);
    }
    film
}

/// Occlusions at random times.
fn hide(dice: &mut Dice, session: &Session, take: &Take, sights: &mut [Vec<Sight>], thing: usize) {
    let frames = take.frames.len();
    let expected = session.occlusion * frames as f64 / session.rate_hz;
    let count = (expected + dice.between(0.0, 1.0)) as usize;
    for _ in 0..count {
        let length = (dice.between(0.2, 1.5) * session.rate_hz).max(1.0) as usize;
        let first = dice.count(0..=frames - 1);
        attempt(take, sights, thing, first..(first + length).min(frames), Sight::Hidden);
    }
}

/// Single detections somewhere else.
fn mislead(dice: &mut Dice, session: &Session, take: &Take, sights: &mut [Vec<Sight>], thing: usize) {
    for frame in 0..take.frames.len() {
        let single = frame == 0 || sights[thing][frame - 1] != Sight::Wild;
        if dice.chance(session.wild) && single && sights[thing][frame] == Sight::Seen {
            attempt(take, sights, thing, frame..frame + 1, Sight::Wild);
        }
    }
}

/// Changes how `thing` is seen, unless that would leave the word unreadable.
fn attempt(take: &Take, sights: &mut [Vec<Sight>], thing: usize, frames: Range<usize>, sight: Sight) {
    let before = sights[thing][frames.clone()].to_vec();
    sights[thing][frames.clone()].fill(sight);
    if !is_readable(take, sights) {
        sights[thing][frames].copy_from_slice(&before);
    }
}

/// Whether every rest is seen long enough, and the rests come into sight in order.
fn is_readable(take: &Take, sights: &[Vec<Sight>]) -> bool {
    let mut latest = None;
    take.rests.iter().zip(&take.resting).all(|(rest, &thing)| {
        let seen = |frame: &usize| sights[thing][*frame] == Sight::Seen;
        let length = rest.frames.len();
        let needed = (length * 2).div_ceil(5).max(6).min(length);
        let first = rest.frames.clone().find(seen);
        let in_order = first > latest;
        latest = first;
        in_order && rest.frames.clone().filter(seen).count() >= needed
    })
}

/// The slow error in each frame: straight lines between values drawn now and then.
fn drift(dice: &mut Dice, session: &Session, frames: usize) -> Vec<Point> {
    let seconds = frames as f64 / session.rate_hz;
    let knots: Vec<Point> = (0..(seconds / DRIFT_S) as usize + 2)
        .map(|_| [session.drift; 3].map(|extent| dice.between(-extent, extent)))
        .collect();
    let at = |frame: usize| {
        let position = frame as f64 / session.rate_hz / DRIFT_S;
        let knot = position as usize;
        let step = subtract(knots[knot + 1], knots[knot]);
        add(knots[knot], scale(step, position - knot as f64))
    };
    (0..frames).map(at).collect()
}

fn detect(dice: &mut Dice, session: &Session, truth: Point, sight: Sight) -> Point {
    let noisy = add(truth, dice.normal_point([session.noise; 3]));
    match sight {
        Sight::Seen => noisy,
        Sight::Wild => {
            let freedom = session.kind.freedom().map(f64::sqrt);
            add(noisy, scale(dice.direction(freedom), dice.between(0.08, 0.8)))
        }
        Sight::Hidden => [f64::NAN; 3],
    }
}
