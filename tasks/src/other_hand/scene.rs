//! Which things there are, where they are meant to go, and in which orders.

use std::fmt;

use super::dice::Dice;
use super::point::{Point, distance, scale};
use super::sequence;
use super::session::{Kind, Session};
use super::table;

/// A spot that a thing is put at on purpose.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spot {
    /// Index into [`Scene::things`].
    pub(super) thing: usize,
    /// Unique for the thing.
    pub(super) label: String,
    pub(super) center: Point,
}

/// What all demonstrations of a task have in common.
pub(super) struct Scene {
    pub(super) things: Vec<&'static str>,
    pub(super) spots: Vec<Spot>,
    /// The distinct words: indices into `spots`; every spot is in one of them.
    pub(super) orders: Vec<Vec<usize>>,
    pub(super) area: Area,
}

/// The box that spots are drawn from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    low: Point,
    high: Point,
    /// How often a spot is not at the lower end of the third axis.
    raised: f64,
}

impl Scene {
    pub(super) fn draw(dice: &mut Dice, session: &Session) -> Self {
        let area = Area::draw(dice, session.kind);
        match session.kind {
            Kind::OwnPlaces => table::own_places(dice, session, area),
            Kind::Stacks => table::stacks(dice, session, area),
            Kind::Parking => table::parking(dice, session, area),
            Kind::Carried => table::carried(dice, session, area),
            Kind::Drone | Kind::Arm | Kind::ArmOfThree => traveller(dice, session, area),
        }
    }

    /// The spots that things start from in every demonstration, if those are fixed.
    pub(super) fn starts(&self, dice: &mut Dice, session: &Session) -> Option<Vec<Point>> {
        session.fixed_starts.then(|| self.free_starts(dice, session))
    }

    /// One start for each thing: clear of its own places, and of everything else if there is room.
    pub(super) fn free_starts(&self, dice: &mut Dice, session: &Session) -> Vec<Point> {
        let mut starts: Vec<Point> = Vec::new();
        for thing in 0..self.things.len() {
            let (own, other): (Vec<&Spot>, Vec<&Spot>) =
                self.spots.iter().partition(|spot| spot.thing == thing);
            let own: Vec<Point> = own.iter().map(|spot| spot.center).collect();
            let mut crowd = starts.clone();
            crowd.extend(other.iter().map(|spot| spot.center));
            starts.push(self.area.clear_spot(dice, &own, session.start_gap(), &crowd));
        }
        starts
    }
}

impl Area {
    fn draw(dice: &mut Dice, kind: Kind) -> Self {
        let (low, high, raised) = match kind {
            Kind::Drone => {
                let size = [dice.between(2.0, 6.0), dice.between(2.0, 5.0), dice.between(1.5, 2.5)];
                ([-size[0] / 2.0, -size[1] / 2.0, 0.3], [size[0] / 2.0, size[1] / 2.0, size[2]], 1.0)
            }
            Kind::Arm => ([-2.5, -1.8, 0.0], [2.5, 1.8, 0.0], 0.0),
            Kind::ArmOfThree => ([-2.5, -1.8, -1.5], [2.5, 1.8, 1.5], 1.0),
            _ => {
                let corner = [dice.between(-0.4, 0.4), dice.between(-0.4, 0.4)];
                let size = [dice.between(0.4, 0.8), dice.between(0.4, 0.6)];
                let raised = dice.pick(&[0.0, 0.25]);
                ([corner[0], corner[1], 0.02], [corner[0] + size[0], corner[1] + size[1], 0.2], raised)
            }
        };
        Area { low, high, raised }
    }

    /// A spot that keeps `gap` from `own`, and a hand's breadth from the `crowd` as far as there is room.
    pub(super) fn clear_spot(self, dice: &mut Dice, own: &[Point], gap: f64, crowd: &[Point]) -> Point {
        let mut elbow_room = 0.08;
        loop {
            let spot = self.point(dice);
            if keeps(spot, own, gap) && keeps(spot, crowd, elbow_room) {
                return spot;
            }
            elbow_room *= 0.99;
        }
    }

    /// Like [`Area::clear_spot`], but now and then barely farther than `gap` from one of `own`.
    pub(super) fn place(self, dice: &mut Dice, own: &[Point], gap: f64, crowd: &[Point]) -> Point {
        if !own.is_empty() && dice.chance(0.35) {
            let [x, y, z] = dice.pick(own);
            let [dx, dy, _] = scale(dice.direction([1.0, 1.0, 0.0]), gap * dice.between(1.02, 1.6));
            let beside = [x + dx, y + dy, z];
            if keeps(beside, own, gap) && keeps(beside, crowd, 0.05) && self.holds(beside) {
                return beside;
            }
        }
        self.clear_spot(dice, own, gap, crowd)
    }

    fn point(self, dice: &mut Dice) -> Point {
        let [x, y, z] = [0, 1, 2].map(|axis| dice.between(self.low[axis], self.high[axis]));
        [x, y, if dice.chance(self.raised) { z } else { self.low[2] }]
    }

    fn holds(self, point: Point) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&point[axis]))
    }
}

impl fmt::Display for Scene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, depth, _] = [0, 1, 2].map(|axis| self.area.high[axis] - self.area.low[axis]);
        write!(f, "{} things, {} places, ", self.things.len(), self.spots.len())?;
        write!(f, "area {width:.2} x {depth:.2}, orders {:?}", self.orders)
    }
}

fn keeps(spot: Point, from: &[Point], gap: f64) -> bool {
    from.iter().all(|&other| distance(spot, other) >= gap)
}

/// A drone that visits places in several orders, or an arm that takes its poses forwards or backwards.
fn traveller(dice: &mut Dice, session: &Session, area: Area) -> Scene {
    let mut centers: Vec<Point> = Vec::new();
    for _ in 0..dice.count(3..=4) {
        let next = area.place(dice, &centers, session.separation(), &[]);
        centers.push(next);
    }
    let forwards: Vec<usize> = (0..centers.len()).collect();
    let orders = if session.kind.is_arm() {
        vec![forwards.clone(), forwards.into_iter().rev().collect()]
    } else {
        sequence::several(dice, session.demonstrations, |dice| sequence::respecting(dice, centers.len(), &[]))
    };
    let spots = centers
        .into_iter()
        .enumerate()
        .map(|(index, center)| Spot { thing: 0, label: format!("stop-{}", index + 1), center })
        .collect();
    Scene { things: vec![if session.kind.is_arm() { "arm" } else { "drone" }], spots, orders, area }
}
