//! The automaton's geometry, as the page draws it.

use std::fmt::Write;

use goalgraph::layout::drawing::layout_request;
use goalgraph::layout::{
    ArrowHead, CubicBezier, Direction, EdgePath, Layout, LayoutRequest, NodeBox, Point, StartArrow, layout,
};
use goalgraph::specification::Specification;

use crate::protocol::{PlacedArrow, PlacedState, PlacedTransition, Placement};

/// Half the width of an arrow head at its base.
const ARROW_HALF_WIDTH: f64 = 4.0;

/// Where the states and transitions of `specification` are, from left to right and from top to bottom.
pub(super) fn place(specification: &Specification) -> Vec<Placement> {
    let request = layout_request(specification);
    let directions = [Direction::LeftToRight, Direction::TopToBottom];
    directions.map(|direction| placement(layout(&LayoutRequest { direction, ..request.clone() }))).into()
}

fn placement(Layout { nodes, edges, start, width, height }: Layout) -> Placement {
    Placement {
        width,
        height,
        start: start.as_ref().map(start_arrow),
        states: nodes.iter().map(state).collect(),
        transitions: edges.iter().map(transition).collect(),
    }
}

fn state(node: &NodeBox) -> PlacedState {
    let NodeBox { id, x, y, width, height } = *node;
    PlacedState { id: id.to_string(), x, y, width, height }
}

fn transition(edge: &EdgePath) -> PlacedTransition {
    PlacedTransition {
        source: edge.source.to_string(),
        symbol: edge.symbol.to_string(),
        target: edge.target.to_string(),
        arrow: PlacedArrow { shaft: shaft(&edge.path), head: head(&edge.arrow) },
        label_x: edge.label.x,
        label_y: edge.label.y,
    }
}

fn start_arrow(start: &StartArrow) -> PlacedArrow {
    let base = start.arrow.base();
    let shaft = format!("M{:.1} {:.1}L{:.1} {:.1}", start.from.x, start.from.y, base.x, base.y);
    PlacedArrow { shaft, head: head(&start.arrow) }
}

fn shaft(curves: &[CubicBezier]) -> String {
    let mut path = String::new();
    for (index, CubicBezier { start, control_1, control_2, end }) in curves.iter().enumerate() {
        if index == 0 {
            let _ = write!(path, "M{:.1} {:.1}", start.x, start.y);
        }
        let _ = write!(
            path,
            "C{:.1} {:.1} {:.1} {:.1} {:.1} {:.1}",
            control_1.x, control_1.y, control_2.x, control_2.y, end.x, end.y
        );
    }
    path
}

fn head(arrow: &ArrowHead) -> String {
    let ArrowHead { tip, direction } = *arrow;
    let base = arrow.base();
    let side = |sign: f64| {
        Point::new(
            base.x - sign * ARROW_HALF_WIDTH * direction.y,
            base.y + sign * ARROW_HALF_WIDTH * direction.x,
        )
    };
    let (left, right) = (side(1.0), side(-1.0));
    format!("M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}Z", tip.x, tip.y, left.x, left.y, right.x, right.y)
}
