//! Clouds of points for measuring how clustering grows, as large as one likes.
//!
//! All are coordinates in row-major order, and the first points of a longer cloud are not those of a shorter one unless
//! said so.

use crate::chance::Chance;
use crate::geometry::{Point, add};

/// Frames of a demonstration in [`resting_points`] and [`scattered_rests`].
pub const FRAMES_OF_A_DEMONSTRATION: usize = 300;

/// How often a thing is carried in a demonstration, and the frames that each way takes.
const WAYS: usize = 4;
const FRAMES_OF_A_WAY: usize = 20;

/// How high things are lifted, what the sensor adds along each axis (standard deviation), and how far from the spot aimed
/// at they are put down along x and y, in metres.
const LIFT: f64 = 0.12;
const NOISE: f64 = 0.0007;
const JITTER: f64 = 0.002;

/// Where the thing of [`resting_points`] starts, and where it is put down, one place after the other.
const START: Point = [0.0, -0.2, 0.02];
const START_REACH: f64 = 0.04;
const PLACES: [Point; WAYS] = [[0.3, -0.1, 0.02], [0.45, 0.1, 0.06], [0.2, 0.25, 0.02], [0.3, 0.0, 0.1]];

/// Positions in 3-D of one thing in demonstrations of 300 frames: it rests about 40 frames at its start, which varies by
/// centimetres, and at each of four places, which all demonstrations share; between them it is carried.
///
/// So the points pile up in four heaps and a loose one, each a fixed share of all: what makes textbook clustering
/// quadratic. `points` coordinates triples in the order of time; the first points of a longer cloud are those of a
/// shorter one of the same seed.
pub fn resting_points(points: usize, seed: u64) -> Vec<f64> {
    demonstrations(points, seed, |chance| (start(START, chance), PLACES))
}

/// Like [`resting_points`], but nothing rests where anything rested before: every demonstration happens somewhere else in
/// a hall that grows with the number of points, so that a heap is one rest and its size does not grow.
pub fn scattered_rests(points: usize, seed: u64) -> Vec<f64> {
    let side = (points.div_ceil(FRAMES_OF_A_DEMONSTRATION) as f64).sqrt();
    demonstrations(points, seed, |chance| {
        let corner = [chance.within((0.0, side)), chance.within((0.0, side)), 0.0];
        let mut place = |_| add(corner, [chance.within((0.0, 1.0)), chance.within((0.0, 1.0)), 0.02]);
        (place(0), [1, 2, 3, 4].map(place))
    })
}

/// `points` points, uniform in the unit cube of `dimension` axes.
pub fn uniform_points(points: usize, dimension: usize, seed: u64) -> Vec<f64> {
    let mut chance = Chance::new(seed, 0);
    (0..points * dimension).map(|_| chance.within((0.0, 1.0))).collect()
}

/// `points` points of `dimension` axes in twenty gaussian blobs of standard deviation 0.01 in the unit cube, in random
/// order.
pub fn shuffled_blobs(points: usize, dimension: usize, seed: u64) -> Vec<f64> {
    let mut chance = Chance::new(seed, 0);
    let centers: Vec<Vec<f64>> =
        (0..20).map(|_| (0..dimension).map(|_| chance.within((0.1, 0.9))).collect()).collect();
    let mut coordinates = Vec::with_capacity(points * dimension);
    for _ in 0..points {
        let center = &centers[chance.whole(0, centers.len() - 1)];
        coordinates.extend(center.iter().map(|x| x + 0.01 * chance.gaussian()));
    }
    coordinates
}

fn start(spot: Point, chance: &mut Chance) -> Point {
    let reach = (-START_REACH, START_REACH);
    add(spot, [chance.within(reach), chance.within(reach), 0.0])
}

/// Demonstrations, each with its start and places, until there are `points` frames.
fn demonstrations(
    points: usize,
    seed: u64,
    mut stops: impl FnMut(&mut Chance) -> (Point, [Point; WAYS]),
) -> Vec<f64> {
    let mut coordinates = Vec::with_capacity(3 * points);
    for demonstration in 0..points.div_ceil(FRAMES_OF_A_DEMONSTRATION) {
        let mut chance = Chance::new(seed, demonstration as u64);
        let (start, places) = stops(&mut chance);
        let wanted = 3 * points.min((demonstration + 1) * FRAMES_OF_A_DEMONSTRATION);
        demonstrate(start, &places, &mut chance, |frame| {
            if coordinates.len() < wanted {
                coordinates.extend(frame);
            }
            coordinates.len() < wanted
        });
    }
    coordinates
}

/// Gives `see` frame after frame until it has seen enough; the last rest has no end.
fn demonstrate(
    start: Point,
    places: &[Point; WAYS],
    chance: &mut Chance,
    mut see: impl FnMut(Point) -> bool,
) {
    let mut now = start;
    for &place in places {
        for _ in 0..chance.whole(30, 48) {
            see(observed(now, chance));
        }
        let put_down = add(place, [chance.within((-JITTER, JITTER)), chance.within((-JITTER, JITTER)), 0.0]);
        for frame in 1..=FRAMES_OF_A_WAY {
            see(observed(carried(now, put_down, frame as f64 / FRAMES_OF_A_WAY as f64), chance));
        }
        now = put_down;
    }
    while see(observed(now, chance)) {}
}

/// Where a thing is that has been carried this share of the time from one point to another.
fn carried(from: Point, to: Point, share: f64) -> Point {
    let progress = share * share * (3.0 - 2.0 * share);
    let mut point = [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * progress);
    point[2] += LIFT * 4.0 * progress * (1.0 - progress);
    point
}

fn observed(point: Point, chance: &mut Chance) -> Point {
    point.map(|x| x + NOISE * chance.gaussian())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::distance;

    fn rows(coordinates: &[f64]) -> Vec<Point> {
        coordinates.chunks_exact(3).map(|row| [row[0], row[1], row[2]]).collect()
    }

    #[test]
    fn clouds_have_as_many_points_as_asked_for_and_the_same_ones_every_time() {
        for points in [0, 1, 299, 300, 301, 1000] {
            assert_eq!(resting_points(points, 1).len(), 3 * points);
            assert_eq!(scattered_rests(points, 1), scattered_rests(points, 1));
            assert_eq!(uniform_points(points, 6, 1).len(), 6 * points);
            assert_eq!(shuffled_blobs(points, 2, 1), shuffled_blobs(points, 2, 1));
        }
        assert_eq!(resting_points(1000, 1)[..900], resting_points(300, 1));
    }

    #[test]
    fn every_demonstration_ends_at_rest_at_the_last_place() {
        for demonstration in rows(&resting_points(3000, 5)).chunks(FRAMES_OF_A_DEMONSTRATION) {
            let near = |point: &&Point| distance(**point, PLACES[WAYS - 1]) < 0.01;
            assert!(demonstration.iter().rev().take_while(near).count() >= 20);
        }
    }

    #[test]
    fn most_frames_are_at_one_of_the_shared_places() {
        let points = rows(&resting_points(30_000, 2));
        let resting =
            points.iter().filter(|&&point| PLACES.iter().any(|&place| distance(point, place) < 0.01));
        let share = resting.count() as f64 / points.len() as f64;
        assert!((0.5..0.75).contains(&share), "{share}");
    }
}
