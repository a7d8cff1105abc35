//! The canvas: what is drawn already, found by where it is, and what it costs to draw over it.

use super::around::crosses;
use super::curves::{HEAD_ROOM, INK_SIDE, INK_STEP, chords, hull, length, samples};
use super::fates::Fate;
use super::field::Field;
use super::near::Near;
use super::spots::Spot;
use crate::layout::graph::{Graph, Size};
use crate::layout::{ArrowHead, CubicBezier, EdgePath, Point, Rect, StartArrow};

/// Owner of what is no node's or edge's.
pub(super) const NOBODY: usize = usize::MAX;

/// How close to a box that is not its own an edge may run.
const CLEARANCE: f64 = 5.0;

/// Distance of the points at which the cost of a path is taken, and how many there are at most about.
const STEP: f64 = 9.0;
const MAX_SAMPLES: f64 = 140.0;

/// What a point of a path costs on a box, on a label and on another edge.
const BOX_COST: f64 = 1_000.0;
const LABEL_COST: f64 = 8.0;
const INK_COST: f64 = 3.0;

/// What a pixel of a label costs on a box, head or label; on another edge it costs 1.
const COVER_COST: f64 = 12.0;

/// Room around a label.
const LABEL_MARGIN: f64 = 2.0;

/// Sides of the cells in which boxes and ink are found.
const BOX_CELL: f64 = 64.0;
const INK_CELL: f64 = 24.0;

/// How far from the edges that are routed anew anything matters.
const SURROUNDINGS: f64 = 240.0;

/// How far from the line between its ends an edge looks for other edges.
const NEAR: f64 = 160.0;

/// All that is drawn near the edges that are routed anew.
#[derive(Debug)]
pub(super) struct Canvas {
    /// By node.
    pub(super) boxes: Field,
    /// Strips along edges, by edge.
    ink: Field,
    /// By edge.
    labels: Field,
    /// Room of arrow heads, by edge.
    heads: Field,
    /// Where anything matters.
    near: Near,
    /// What each edge's label was added as.
    label_items: Vec<Option<usize>>,
}

impl Canvas {
    /// The boxes, and the edges that stay.
    pub(super) fn new(
        graph: &Graph,
        spots: &[Spot],
        fates: &[Fate],
        old: &[Option<&EdgePath>],
        start: Option<&StartArrow>,
    ) -> Self {
        let concerned = concerned(graph, spots, fates);
        let near = near(graph, spots, fates, concerned);
        let mut canvas = Self {
            boxes: Field::new(concerned, BOX_CELL),
            ink: Field::new(concerned, INK_CELL),
            labels: Field::new(concerned, BOX_CELL),
            heads: Field::new(concerned, BOX_CELL),
            near,
            label_items: vec![None; fates.len()],
        };
        for (node, spot) in spots.iter().enumerate() {
            canvas.boxes.add(node, spot.rect());
        }
        if let Some(start) = start {
            let from = Rect::centered(start.from, HEAD_ROOM / 2.0, HEAD_ROOM / 2.0);
            canvas.heads.add(NOBODY, from.union(&Rect::centered(start.arrow.tip, 0.0, 0.0)));
        }
        for (edge, fate) in fates.iter().enumerate() {
            let (Some(shift), Some(old)) = (fate.shift(), old[edge]) else {
                continue;
            };
            let near = hull(&old.path).is_some_and(|hull| hull.grown(CLEARANCE).overlap(&concerned) > 0.0);
            if near {
                let path: Vec<CubicBezier> =
                    old.path.iter().map(|curve| curve.map(|point| point.shifted(shift))).collect();
                let tip = old.arrow.tip.shifted(shift);
                canvas.add_path(edge, &path, ArrowHead { tip, ..old.arrow });
                if *fate != Fate::Relabeled {
                    canvas.set_label(edge, old.label.shifted(shift), graph.edges[edge].label);
                }
            }
        }
        canvas
    }

    pub(super) fn add_path(&mut self, edge: usize, path: &[CubicBezier], arrow: ArrowHead) {
        for point in path.iter().flat_map(|curve| samples(curve, INK_STEP)) {
            if self.near.contains(point) {
                self.ink.add(edge, Rect::centered(point, INK_SIDE, INK_SIDE));
            }
        }
        self.heads.add(edge, Rect::centered(arrow.base(), HEAD_ROOM, HEAD_ROOM));
    }

    /// Puts the label of an edge to `center`, or takes it from where it was.
    pub(super) fn set_label(&mut self, edge: usize, center: Point, size: Size) {
        self.take_label(edge);
        if size.width > 0.0 && size.height > 0.0 {
            self.label_items[edge] = Some(self.labels.add(edge, label_rect(center, size)));
        }
    }

    pub(super) fn take_label(&mut self, edge: usize) {
        if let Some(item) = self.label_items[edge].take() {
            self.labels.remove(item);
        }
    }

    /// What it costs to draw `edge`, which joins `ends`, along `path`; once it is above `limit`, some of that.
    pub(super) fn path_cost(&self, edge: usize, ends: [usize; 2], path: &[CubicBezier], limit: f64) -> f64 {
        let mut cost = 0.0;
        for [a, b] in path.iter().flat_map(chords) {
            let chord = Rect::centered(a, 0.0, 0.0).union(&Rect::centered(b, 0.0, 0.0));
            self.boxes.visit(&chord.grown(CLEARANCE), |node, rect| {
                // Edges start and end on their own boxes' borders.
                let room = if ends.contains(&node) { -1.0 } else { CLEARANCE };
                cost += if crosses(a, b, &rect.grown(room)) { BOX_COST } else { 0.0 };
            });
            if cost > limit {
                return cost;
            }
        }
        let step = STEP.max(path.iter().map(length).sum::<f64>() / MAX_SAMPLES);
        let (label_cost, ink_cost) = (LABEL_COST * step / STEP, INK_COST * step / STEP);
        for point in path.iter().flat_map(|curve| samples(curve, step)) {
            let spot = Rect::centered(point, 0.0, 0.0);
            self.labels.visit(&spot, |owner, _| cost += if owner == edge { 0.0 } else { label_cost });
            let mut is_on_edge = false;
            self.ink.visit(&spot, |owner, _| is_on_edge |= owner != edge);
            cost += if is_on_edge { ink_cost } else { 0.0 };
            if cost > limit {
                return cost;
            }
        }
        cost
    }

    /// Whether a path of this cost meets no box.
    pub(super) fn is_clear(cost: f64) -> bool {
        cost < BOX_COST
    }

    /// What it costs to put the label of `edge` to `center`.
    pub(super) fn label_cost(&self, edge: usize, center: Point, size: Size) -> f64 {
        if size.width <= 0.0 || size.height <= 0.0 {
            return 0.0;
        }
        let rect = label_rect(center, size);
        let (mut covered, mut ink) = (0.0, 0.0);
        self.boxes.visit(&rect, |_, other| covered += other.overlap(&rect));
        for field in [&self.labels, &self.heads] {
            field.visit(&rect, |_, other| covered += other.overlap(&rect));
        }
        self.ink.visit(&rect, |owner, other| ink += if owner == edge { 0.0 } else { other.overlap(&rect) });
        COVER_COST * covered + ink
    }
}

fn label_rect(center: Point, size: Size) -> Rect {
    Rect::centered(center, size.width, size.height).grown(LABEL_MARGIN)
}

/// The part of the drawing in which edges are routed anew.
fn concerned(graph: &Graph, spots: &[Spot], fates: &[Fate]) -> Rect {
    let routed = graph.edges.iter().zip(fates);
    let routed = routed.filter(|(_, fate)| fate.is_routed() || **fate == Fate::Relabeled);
    let ends = routed.flat_map(|(edge, _)| [edge.source, edge.target]).map(|node| spots[node].rect());
    let all = ends.reduce(|all, rect| all.union(&rect));
    all.map_or_else(|| Rect::centered(Point::default(), 1.0, 1.0), |all| all.grown(SURROUNDINGS))
}

/// The surroundings of the edges that are routed anew.
fn near(graph: &Graph, spots: &[Spot], fates: &[Fate], concerned: Rect) -> Near {
    let mut near = Near::new(concerned);
    for (edge, fate) in graph.edges.iter().zip(fates) {
        if fate.is_routed() || *fate == Fate::Relabeled {
            near.mark(spots[edge.source].center, spots[edge.target].center, NEAR);
        }
    }
    near
}
