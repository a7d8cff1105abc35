//! Fates: which edges keep their paths.

use super::curves::{hull, samples};
use super::spots::Spot;
use crate::layout::graph::Graph;
use crate::layout::{EdgePath, Point, Rect};

/// Two shifts that differ by less are one.
const SAME: f64 = 1e-6;

/// How close a box that moved may come to an edge that stays.
const CLEARANCE: f64 = 3.0;

/// What becomes of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fate {
    /// Path and label are what they were.
    Kept,
    /// The path is what it was, but a box is on the label now.
    Relabeled,
    /// Path and label moved with both ends.
    Shifted(Point),
    /// It gets a new path.
    Routed,
}

impl Fate {
    pub(super) fn is_routed(self) -> bool {
        self == Self::Routed
    }

    /// How far the path of before is moved, unless there is a new one.
    pub(super) fn shift(self) -> Option<Point> {
        match self {
            Self::Kept | Self::Relabeled => Some(Point::default()),
            Self::Shifted(shift) => Some(shift),
            Self::Routed => None,
        }
    }
}

/// The fate of every edge of the graph; `old` are the edges of before.
///
/// # Complexity
///
/// O(E · B) for E edges and B boxes that moved, changed size or are new, and O(N) for each edge that is shifted.
pub(super) fn fates(graph: &Graph, spots: &[Spot], old: &[Option<&EdgePath>]) -> Vec<Fate> {
    let changed: Vec<usize> = (0..spots.len()).filter(|&node| spots[node].is_changed()).collect();
    let all: Vec<usize> = (0..spots.len()).collect();
    let fate = |(at, old): (usize, Option<&EdgePath>)| {
        let Some(old) = old else {
            return Fate::Routed;
        };
        let edge = &graph.edges[at];
        let (source, target) = (&spots[edge.source], &spots[edge.target]);
        let label = Rect::centered(old.label, edge.label.width, edge.label.height);
        let ends = [edge.source, edge.target];
        if !source.is_changed() && !target.is_changed() {
            let met = Met { spots, nodes: &changed, ends };
            return match () {
                () if met.path(old, Point::default()) => Fate::Routed,
                () if met.label(&label) => Fate::Relabeled,
                () => Fate::Kept,
            };
        }
        let shift = source.shift().zip(target.shift()).filter(|(a, b)| is_same(*a, *b));
        let met = Met { spots, nodes: &all, ends };
        match shift {
            Some((shift, _)) if !met.path(old, shift) && !met.label(&moved(&label, shift)) => {
                Fate::Shifted(shift)
            }
            _ => Fate::Routed,
        }
    };
    old.iter().copied().enumerate().map(fate).collect()
}

fn is_same(a: Point, b: Point) -> bool {
    (a.x - b.x).abs() < SAME && (a.y - b.y).abs() < SAME
}

fn moved(rect: &Rect, by: Point) -> Rect {
    Rect {
        left: rect.left + by.x,
        top: rect.top + by.y,
        right: rect.right + by.x,
        bottom: rect.bottom + by.y,
    }
}

/// The boxes that an edge may meet.
struct Met<'a> {
    spots: &'a [Spot],
    nodes: &'a [usize],
    ends: [usize; 2],
}

impl Met<'_> {
    fn rects(&self) -> impl Iterator<Item = Rect> {
        let others = self.nodes.iter().filter(|node| !self.ends.contains(node));
        others.map(|&node| self.spots[node].rect().grown(CLEARANCE))
    }

    /// Whether the path, moved by `shift`, runs through one of them.
    fn path(&self, edge: &EdgePath, shift: Point) -> bool {
        const STEP: f64 = 6.0;
        let Some(hull) = hull(&edge.path).map(|hull| moved(&hull, shift)) else {
            return true;
        };
        let through = |rect: Rect| {
            let mut points = edge.path.iter().flat_map(|curve| samples(curve, STEP)).chain([edge.arrow.tip]);
            points.any(|point| rect.contains(point.shifted(shift)))
        };
        // A straight line has a hull without area, which overlaps nothing.
        self.rects().filter(|rect| rect.overlap(&hull.grown(1.0)) > 0.0).any(through)
    }

    fn label(&self, label: &Rect) -> bool {
        self.rects().any(|rect| rect.overlap(label) > 0.0)
    }
}
