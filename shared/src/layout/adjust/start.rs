//! The start arrow: where it was, or before its box, or where there is room.

use super::sides::Side;
use super::spots::Spot;
use crate::layout::graph::Graph;
use crate::layout::{ArrowHead, Layout, Point, Rect, START_LENGTH, StartArrow};

/// The arrow from nowhere to the initial node.
pub(super) fn start(graph: &Graph, before: &Layout, spots: &[Spot]) -> Option<StartArrow> {
    let node = graph.initial?;
    let spot = spots.get(node)?;
    let kept = before.start.filter(|start| is_on_border(&spot.rect(), start));
    if kept.is_some() && !spot.is_changed() {
        return kept;
    }
    let arrow = |side: Side| {
        let (tip, out) = (side.point(&spot.rect(), 0.0), side.outward());
        let from = Point::new(tip.x + START_LENGTH * out.x, tip.y + START_LENGTH * out.y);
        StartArrow { from, arrow: ArrowHead { tip, direction: Point::new(-out.x, -out.y) } }
    };
    let is_free = |start: &StartArrow| {
        let room = Rect::centered(start.from, 0.0, 0.0).union(&Rect::centered(start.arrow.tip, 0.0, 0.0));
        let others = spots.iter().enumerate().filter(|(other, _)| *other != node);
        others.into_iter().all(|(_, other)| other.rect().overlap(&room.grown(3.0)) <= 0.0)
    };
    let arrows = [Side::Left, Side::Up, Side::Down].map(arrow);
    Some(arrows.into_iter().find(is_free).unwrap_or(arrows[0]))
}

/// Whether an arrow ends on the left, upper or lower side of the box.
fn is_on_border(rect: &Rect, start: &StartArrow) -> bool {
    const NEAR: f64 = 1e-6;
    let tip = start.arrow.tip;
    let is_finite = [tip.x, tip.y, start.from.x, start.from.y].iter().all(|value| value.is_finite());
    is_finite && rect.grown(NEAR).contains(tip) && !rect.grown(-NEAR).contains(tip)
}
