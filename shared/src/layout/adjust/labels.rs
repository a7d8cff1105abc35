//! Labels of edges that are routed anew: the cheapest place on the edge.

use super::canvas::Canvas;
use super::curves::point_along;
use crate::layout::graph::Size;
use crate::layout::{CubicBezier, Point};

/// Shares of the way at which a label may stand, best first.
const PLACES: [f64; 21] = [
    0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65, 0.3, 0.7, 0.25, 0.75, 0.2, 0.8, 0.16, 0.84, 0.425, 0.575, 0.475,
    0.525, 0.375, 0.625,
];

/// What each step away from the best place costs.
const STEP_COST: f64 = 2.5;

/// Finds the place of the label of `edge` on `path`, and notes it on the canvas.
pub(super) fn place_label(canvas: &mut Canvas, edge: usize, path: &[CubicBezier], size: Size) -> Point {
    canvas.take_label(edge);
    let mut best = (f64::INFINITY, point_along(path, PLACES[0]));
    for (step, share) in PLACES.into_iter().enumerate() {
        let least = STEP_COST * step as f64;
        if least >= best.0 {
            break;
        }
        let center = point_along(path, share);
        let cost = least + canvas.label_cost(edge, center, size);
        if cost < best.0 {
            best = (cost, center);
        }
    }
    canvas.set_label(edge, best.1, size);
    best.1
}
