//! Spots that keep their distance.

use crate::chance::Chance;
use crate::geometry::{Point, add, nearest};

/// A box: the least and the greatest value along each axis.
pub(crate) type Space = [(f64, f64); 3];

/// Spots in the space at least `gap` apart, or as far apart as could be found.
pub(crate) fn scatter(count: usize, space: Space, gap: f64, chance: &mut Chance) -> Vec<Point> {
    let mut spots: Vec<Point> = Vec::with_capacity(count);
    for _ in 0..count {
        let mut best = space.map(|span| chance.within(span));
        for _ in 0..300 {
            if nearest(best, spots.iter().copied()) >= gap {
                break;
            }
            let candidate = space.map(|span| chance.within(span));
            if nearest(candidate, spots.iter().copied()) > nearest(best, spots.iter().copied()) {
                best = candidate;
            }
        }
        spots.push(best);
    }
    spots
}

/// A spot `near` from the given one along x or y, on the side that has most room.
pub(crate) fn beside(spot: Point, near: f64, others: &[Point]) -> Point {
    let sides = [[near, 0.0, 0.0], [-near, 0.0, 0.0], [0.0, near, 0.0], [0.0, -near, 0.0]];
    let spots = sides.map(|side| add(spot, side));
    let room = |spot: &Point| nearest(*spot, others.iter().copied());
    spots.into_iter().max_by(|a, b| room(a).total_cmp(&room(b))).unwrap_or(spot)
}
