//! Ways around boxes: shortest paths over the corners of those that are in the way.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use super::field::Field;
use crate::layout::{CubicBezier, Point, Rect};

/// How many lines are tried at most for one way.
const MAX_LINES: usize = 160;

/// How far beyond the room around a box its corners are passed.
const BESIDE: f64 = 1.5;

/// The way from `from` to `to` that keeps `room` from all boxes, except those that an end is closer to: a polyline, ends
/// included. None when it is not found within bounded work; `lines` is what all ways together may still try.
///
/// A* over a visibility graph that is discovered as it is searched: only corners of boxes that were in the way of a line
/// are looked at.
pub(super) fn around(
    boxes: &Field,
    from: Point,
    to: Point,
    room: f64,
    lines: &mut usize,
) -> Option<Vec<Point>> {
    let most = MAX_LINES.min(*lines);
    let mut search = Search { boxes, from, to, room, lines: 0, nodes: Vec::new(), open: BinaryHeap::new() };
    search.reach(from, 0.0, None);
    let way = search.run(most);
    *lines -= search.lines.min(*lines);
    way
}

/// A point that is reached.
struct Node {
    point: Point,
    length: f64,
    before: Option<usize>,
    /// The box and which of its corners.
    corner: Option<(usize, usize)>,
}

/// A point to go on from, shortest first.
struct Open {
    estimate: f64,
    node: usize,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.estimate.total_cmp(&self.estimate).then(other.node.cmp(&self.node))
    }
}

struct Search<'a> {
    boxes: &'a Field,
    from: Point,
    to: Point,
    room: f64,
    lines: usize,
    nodes: Vec<Node>,
    open: BinaryHeap<Open>,
}

impl Search<'_> {
    fn run(&mut self, most: usize) -> Option<Vec<Point>> {
        let mut closed: BTreeSet<(usize, usize)> = BTreeSet::new();
        while let Some(Open { node, .. }) = self.open.pop() {
            if let Some(corner) = self.nodes[node].corner
                && !closed.insert(corner)
            {
                continue;
            }
            if self.nodes[node].point == self.to {
                return Some(self.way(node));
            }
            self.expand(node, &closed);
            if self.lines > most {
                return None;
            }
        }
        None
    }

    fn reach(&mut self, point: Point, length: f64, before: Option<(usize, Option<(usize, usize)>)>) {
        let node = self.nodes.len();
        self.open.push(Open { estimate: length + distance(point, self.to), node });
        let (before, corner) = (before.map(|(before, _)| before), before.and_then(|(_, corner)| corner));
        self.nodes.push(Node { point, length, before, corner });
    }

    /// Goes on to the end, or to the corners of what is in the way, and of what is in the way to them.
    fn expand(&mut self, node: usize, closed: &BTreeSet<(usize, usize)>) {
        const MAX_BOXES: usize = 10;
        let Node { point, length, .. } = self.nodes[node];
        let mut blocking = self.blocking(point, self.to);
        if blocking.is_empty() {
            self.reach(self.to, length + distance(point, self.to), Some((node, None)));
            return;
        }
        blocking.truncate(MAX_BOXES);
        let mut at = 0;
        while let Some(&(owner, rect)) = blocking.get(at) {
            at += 1;
            for (which, corner) in corners(&rect.grown(self.room + BESIDE)).into_iter().enumerate() {
                if closed.contains(&(owner, which)) || corner == point {
                    continue;
                }
                let between = self.blocking(point, corner);
                if between.is_empty() {
                    let corner_id = Some((owner, which));
                    self.reach(corner, length + distance(point, corner), Some((node, corner_id)));
                }
                for other in between {
                    if blocking.len() < MAX_BOXES && blocking.iter().all(|known| known.0 != other.0) {
                        blocking.push(other);
                    }
                }
            }
        }
    }

    /// The boxes in the way of a line, in the order of their owners.
    fn blocking(&mut self, a: Point, b: Point) -> Vec<(usize, Rect)> {
        const PIECE: f64 = 160.0;
        self.lines += 1;
        let pieces = (distance(a, b) / PIECE).clamp(1.0, 64.0).ceil();
        let part = |share: f64| Point::new(a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share);
        let mut found: Vec<(usize, Rect)> = Vec::new();
        for piece in 0..pieces as usize {
            let (a, b) = (part(piece as f64 / pieces), part((piece + 1) as f64 / pieces));
            let piece = Rect::centered(a, 0.0, 0.0).union(&Rect::centered(b, 0.0, 0.0));
            self.boxes.visit(&piece.grown(self.room), |owner, rect| {
                let near = rect.grown(self.room);
                let is_end = near.contains(self.from) || near.contains(self.to);
                if crosses(a, b, &if is_end { rect.grown(1.0) } else { near }) {
                    found.push((owner, *rect));
                }
            });
        }
        found.sort_by_key(|(owner, _)| *owner);
        found.dedup_by_key(|(owner, _)| *owner);
        found
    }

    fn way(&self, node: usize) -> Vec<Point> {
        let mut way = Vec::new();
        let mut next = Some(node);
        while let Some(node) = next {
            way.push(self.nodes[node].point);
            next = self.nodes[node].before;
        }
        way.reverse();
        way
    }
}

fn distance(a: Point, b: Point) -> f64 {
    let (x, y) = (b.x - a.x, b.y - a.y);
    (x * x + y * y).sqrt()
}

fn corners(rect: &Rect) -> [Point; 4] {
    let Rect { left, top, right, bottom } = *rect;
    [Point::new(left, top), Point::new(right, top), Point::new(right, bottom), Point::new(left, bottom)]
}

/// Whether the line from `a` to `b` meets the rectangle, by Liang and Barsky (1984).
pub(super) fn crosses(a: Point, b: Point, rect: &Rect) -> bool {
    let (x, y) = (b.x - a.x, b.y - a.y);
    let sides = [(-x, a.x - rect.left), (x, rect.right - a.x), (-y, a.y - rect.top), (y, rect.bottom - a.y)];
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (speed, room) in sides {
        if speed == 0.0 {
            if room < 0.0 {
                return false;
            }
        } else if speed < 0.0 {
            enter = enter.max(room / speed);
        } else {
            leave = leave.min(room / speed);
        }
    }
    enter <= leave
}

/// The polyline with its corners rounded off from up to `radius` away.
pub(super) fn rounded(way: &[Point], radius: f64) -> Vec<CubicBezier> {
    /// Shorter lines are left out.
    const NOTHING: f64 = 0.01;
    let mut curves = Vec::new();
    let (Some(&first), Some(&last)) = (way.first(), way.last()) else {
        return curves;
    };
    let mut at = first;
    for (index, corner) in way.windows(3).enumerate() {
        let share = |is_end: bool| if is_end { 1.0 } else { 0.5 };
        let before = distance(corner[0], corner[1]) * share(index == 0);
        let after = distance(corner[1], corner[2]) * share(index + 3 == way.len());
        let cut = radius.min(before).min(after);
        let (enter, leave) = (towards(corner[1], corner[0], cut), towards(corner[1], corner[2], cut));
        if distance(at, enter) > NOTHING {
            curves.push(CubicBezier::line(at, enter));
            at = enter;
        }
        let (control_1, control_2) =
            (towards(at, corner[1], cut * 2.0 / 3.0), towards(leave, corner[1], cut * 2.0 / 3.0));
        curves.push(CubicBezier { start: at, control_1, control_2, end: leave });
        at = leave;
    }
    if curves.is_empty() || distance(at, last) > NOTHING {
        curves.push(CubicBezier::line(at, last));
    } else if let Some(curve) = curves.last_mut() {
        curve.end = last;
    }
    curves
}

/// The point `length` from `from` on the way to `to`.
fn towards(from: Point, to: Point, length: f64) -> Point {
    let whole = distance(from, to);
    let share = if whole > 0.0 { (length / whole).min(1.0) } else { 0.0 };
    Point::new(from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share)
}
