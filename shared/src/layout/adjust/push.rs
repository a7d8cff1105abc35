//! Boxes that grew push their neighbors aside.

use std::collections::VecDeque;

use super::free::{Room, free_place};
use super::spots::Spot;
use crate::layout::{Point, Rect};

/// Room that a pushed box gets.
const GAP: f64 = 12.0;

/// How often a box is pushed before another place is looked for.
const MAX_PUSHES: usize = 5;

/// Moves boxes that overlap one that grew, as little as clears it, and in turn those that they meet. A box whose neighbor is
/// held moves away itself; two that are held stay as they are.
///
/// # Complexity
///
/// O(N) for each of N boxes that grew or were pushed.
pub(super) fn push(spots: &mut [Option<Spot>]) {
    let grown = |at: &usize| spots[*at].is_some_and(|spot| spot.is_grown());
    let mut queue: VecDeque<(usize, Option<Way>)> =
        (0..spots.len()).filter(grown).map(|at| (at, None)).collect();
    let mut pushes = vec![0; spots.len()];
    let mut concerned: Vec<usize> = queue.iter().map(|&(at, _)| at).collect();
    while let Some((pusher, way)) = queue.pop_front() {
        for other in 0..spots.len() {
            let Some((mover, fixed)) = roles(spots, pusher, other) else {
                continue;
            };
            if pushes[mover] == MAX_PUSHES {
                continue;
            }
            let (Some(moving), Some(standing)) = (spots[mover], spots[fixed]) else {
                continue;
            };
            let (moving, standing) = (moving.rect(), standing.rect());
            let way = way.filter(|_| mover == other).unwrap_or_else(|| Way::shortest(&moving, &standing));
            let shift = way.shift(&moving, &standing);
            if let Some(spot) = &mut spots[mover] {
                spot.center = spot.center.shifted(shift);
            }
            pushes[mover] += 1;
            concerned.push(mover);
            queue.push_back((mover, Some(way)));
        }
    }
    concerned.sort_unstable();
    concerned.dedup();
    for at in concerned {
        settle(spots, at);
    }
}

/// Which of two boxes moves and which stands, when they overlap and one can move.
fn roles(spots: &[Option<Spot>], pusher: usize, other: usize) -> Option<(usize, usize)> {
    let (a, b) = (spots[pusher]?, spots[other]?);
    if pusher == other || a.rect().overlap(&b.rect()) <= 0.0 || (a.held && b.held) {
        return None;
    }
    Some(if b.held { (pusher, other) } else { (other, pusher) })
}

/// Looks for another place for a box that still overlaps one.
fn settle(spots: &mut [Option<Spot>], at: usize) {
    let Some(spot) = spots[at].filter(|spot| !spot.held) else {
        return;
    };
    let rect = spot.rect();
    let others = spots.iter().enumerate().filter(|(other, _)| *other != at);
    let others: Vec<Rect> = others.filter_map(|(_, other)| Some((*other)?.rect())).collect();
    if others.iter().any(|other| other.overlap(&rect) > 0.0) {
        let center = free_place(spot.center, spot.size, Room { above: 0.0 }, &others, |_| 0.0);
        if let Some(spot) = &mut spots[at] {
            spot.center = center;
        }
    }
}

/// Where a box is pushed to.
#[derive(Clone, Copy, Debug)]
enum Way {
    Right,
    Left,
    Down,
    Up,
}

impl Way {
    /// The way that takes `moving` off `standing` with the least shift.
    fn shortest(moving: &Rect, standing: &Rect) -> Self {
        let length = |way: &Self| {
            let shift = way.shift(moving, standing);
            shift.x.abs() + shift.y.abs()
        };
        let ways = [Self::Down, Self::Up, Self::Right, Self::Left];
        ways.into_iter().min_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or(Self::Down)
    }

    fn shift(self, moving: &Rect, standing: &Rect) -> Point {
        match self {
            Self::Right => Point::new(standing.right + GAP - moving.left, 0.0),
            Self::Left => Point::new(standing.left - GAP - moving.right, 0.0),
            Self::Down => Point::new(0.0, standing.bottom + GAP - moving.top),
            Self::Up => Point::new(0.0, standing.top - GAP - moving.bottom),
        }
    }
}
