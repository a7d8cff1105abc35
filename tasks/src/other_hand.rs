//! A second, independent hand: held-out tasks that share nothing with the other generator but [`Task`].
//!
//! ```text
//! Dice -> Session (unit, rate, errors) -> Scene (things, spots, orders)
//!      -> Operator performs each order on a Tape -> Camera films it -> Task
//! ```
//!
//! Everything is computed in metres (radians for an arm) and seconds; the last step changes the unit.

mod dice;
mod point;

mod session;

mod scene;
mod sequence;
mod table;

mod operator;
mod tape;

mod camera;

#[cfg(test)]
mod tests;

use crate::task::{Place, Recording, Task, TrueSubset};
use dice::Dice;
use operator::Operator;
use point::{Point, add};
use scene::Scene;
use session::Session;

/// A task as another laboratory might have recorded it, with the truth behind it.
///
/// Objects put at places of their own, stacked, parked and moved on, or one object carried about; a drone that
/// stops at several places; an arm that takes its poses forwards or backwards. Each place is visited in two
/// demonstrations or more. Every rest is seen in 40 % of its frames and in 6 of them (in all, if it has fewer),
/// and the rests come into sight in the order of the word. The same seed gives the same task.
pub fn held_out_task(seed: u64) -> Task {
    let mut dice = Dice::new(seed);
    let session = Session::draw(&mut dice);
    let scene = Scene::draw(&mut dice, &session);
    let operator = Operator::draw(&mut dice, session.kind);
    let orders = sequence::deal(&mut dice, scene.orders.len(), session.demonstrations);
    let starts = scene.starts(&mut dice, &session);
    let takes = orders.iter().enumerate().map(|(index, &order)| {
        let word = &scene.orders[order];
        let starts = match &starts {
            Some(fixed) => scattered(&mut dice, &session, fixed),
            None => scene.free_starts(&mut dice, &session),
        };
        let targets: Vec<Point> = scene.spots.iter().map(|spot| spot.center).collect();
        let targets = scattered(&mut dice, &session, &targets);
        let take = operator.perform(&mut dice, &session, &scene, word, &starts, &targets);
        Recording {
            name: format!("take-{:02}", index + 1),
            frames: camera::film(&mut dice, &session, &take),
            word: word.clone(),
            rests: take.rests,
        }
    });
    let demonstrations = takes.collect();
    Task {
        name: format!("held-out-{seed}"),
        description: format!("seed {seed}: {session}; {scene}; {operator}"),
        features: subsets(&session, &scene).flat_map(|subset| subset.features).collect(),
        unit: session.unit,
        rate_hz: session.rate_hz,
        subsets: subsets(&session, &scene).collect(),
        places: places(&session, &scene),
        demonstrations,
    }
}

/// Where things end up when `points` are aimed at.
fn scattered(dice: &mut Dice, session: &Session, points: &[Point]) -> Vec<Point> {
    let spread = session.kind.freedom().map(|share| share * session.scatter);
    points.iter().map(|&point| add(point, dice.normal_point(spread))).collect()
}

fn subsets(session: &Session, scene: &Scene) -> impl Iterator<Item = TrueSubset> {
    scene.things.iter().map(|thing| TrueSubset {
        name: (*thing).to_owned(),
        features: session.kind.axes().iter().map(|axis| format!("{thing}{}{axis}", session.joint)).collect(),
    })
}

fn places(session: &Session, scene: &Scene) -> Vec<Place> {
    let in_unit = |value: &f64| value * session.unit.per_base();
    scene
        .spots
        .iter()
        .map(|spot| Place {
            name: format!("{}-{}", scene.things[spot.thing], spot.label),
            subset: scene.things[spot.thing].to_owned(),
            center: spot.center[..session.kind.axes().len()].iter().map(in_unit).collect(),
        })
        .collect()
}
