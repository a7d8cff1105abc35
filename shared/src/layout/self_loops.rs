//! Self-loops: arcs above their box, one around the other.

use super::ArrowHead;
use super::coordinates::Place;
use super::extents::{LOOP_LABEL_GAP, LOOP_RISE, loop_half_widths, loop_labels, loop_rises};
use super::geometry::{CubicBezier, Point};
use super::graph::{Graph, Size};
use super::layers::{Layers, Vertex};
use super::route::{CORNER, Route};

/// Routes the edges that join a node to itself.
pub(super) fn self_loops(graph: &Graph, layers: &Layers, place: &Place) -> Vec<Route> {
    let mut center_of = vec![Point::default(); graph.sizes.len()];
    for (vertex, kind) in layers.vertices.iter().enumerate() {
        if let Vertex::Node(node) = kind {
            center_of[*node] = place.centers[vertex];
        }
    }
    let labels = loop_labels(graph, layers);
    let mut drawn = vec![0; graph.sizes.len()];
    let mut routes = Vec::with_capacity(layers.loops.len());
    for &edge in &layers.loops {
        let node = graph.edges[edge].source;
        let around = Arc { size: graph.sizes[node], center: center_of[node], labels: &labels[node] };
        routes.push(around.route(edge, drawn[node]));
        drawn[node] += 1;
    }
    routes
}

/// The loops of one node.
struct Arc<'a> {
    size: Size,
    center: Point,
    labels: &'a [Size],
}

impl Arc<'_> {
    /// The loop `at`, counted from the box.
    fn route(&self, edge: usize, at: usize) -> Route {
        let share = (at + 1) as f64 / (self.labels.len() + 1) as f64;
        let half = (self.size.width / 2.0 - CORNER).max(self.size.width / 4.0).min(LARGEST_HALF) * share;
        let (rise, half_width) = (loop_rises(self.labels)[at], loop_half_widths(self.labels)[at].max(half));
        let shape = Loop { center: self.center, size: self.size, foot: half, half_width, rise };
        let (path, arrow) = loop_around(&shape);
        let top = self.center.y - self.size.height / 2.0;
        let label = Point::new(self.center.x, top - rise - LOOP_LABEL_GAP - self.labels[at].height / 2.0);
        Route { edge, path, arrow, label_places: vec![label] }
    }
}

/// The measures of a self-loop above a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Loop {
    /// Of the box.
    pub(super) center: Point,
    pub(super) size: Size,
    /// Half the distance of its ends.
    pub(super) foot: f64,
    /// Half its width.
    pub(super) half_width: f64,
    /// How far its top is above the box.
    pub(super) rise: f64,
}

/// Path and head of a self-loop.
pub(super) fn loop_around(shape: &Loop) -> (Vec<CubicBezier>, ArrowHead) {
    let Loop { center, size, foot, half_width, rise } = *shape;
    let top = center.y - size.height / 2.0;
    let (start, tip) = (Point::new(center.x - foot, top), Point::new(center.x + foot, top));
    let arrow = ArrowHead { tip, direction: Point::new(0.0, 1.0) };
    let left = Point::new(center.x - half_width, top - rise + LOOP_RISE / 2.0);
    let right = Point::new(center.x + half_width, left.y);
    let path = vec![upright(start, left), cap(left, right, top - rise), upright(right, arrow.base())];
    (path, arrow)
}

/// Half of the largest distance between the ends of a loop.
pub(super) const LARGEST_HALF: f64 = 40.0;

/// The curve that is upright at both ends.
fn upright(start: Point, end: Point) -> CubicBezier {
    let middle = f64::midpoint(start.y, end.y);
    let (control_1, control_2) = (Point::new(start.x, middle), Point::new(end.x, middle));
    CubicBezier { start, control_1, control_2, end }
}

/// The curve from `left` to `right` whose highest point is at `top`.
fn cap(left: Point, right: Point, top: f64) -> CubicBezier {
    // A cubic curve with both control points at one height reaches three quarters of it.
    const REACH: f64 = 0.75;
    let y = left.y - (left.y - top) / REACH;
    CubicBezier {
        start: left,
        control_1: Point::new(left.x, y),
        control_2: Point::new(right.x, y),
        end: right,
    }
}
