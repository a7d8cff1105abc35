//! Layouts in flow space, and back: for a flow from top to bottom the axes are swapped.

use crate::layout::{ArrowHead, Direction, EdgePath, Layout, NodeBox, Point, StartArrow};

/// The layout with its axes swapped when the flow is from top to bottom; twice is the same layout again.
pub(super) fn turned(layout: &Layout, direction: Direction) -> Layout {
    if direction == Direction::LeftToRight {
        return layout.clone();
    }
    let node = |node: &NodeBox| {
        let NodeBox { id, x, y, width, height } = *node;
        NodeBox { id, x: y, y: x, width: height, height: width }
    };
    let edge = |edge: &EdgePath| EdgePath {
        source: edge.source,
        symbol: edge.symbol,
        target: edge.target,
        path: edge.path.iter().map(|curve| curve.map(Point::swapped)).collect(),
        label: edge.label.swapped(),
        arrow: head(edge.arrow),
    };
    Layout {
        nodes: layout.nodes.iter().map(node).collect(),
        edges: layout.edges.iter().map(edge).collect(),
        start: layout.start.map(|start| StartArrow { from: start.from.swapped(), arrow: head(start.arrow) }),
        left: layout.top,
        top: layout.left,
        width: layout.height,
        height: layout.width,
    }
}

/// The point with its axes swapped when the flow is from top to bottom.
pub(super) fn point(point: Point, direction: Direction) -> Point {
    match direction {
        Direction::LeftToRight => point,
        Direction::TopToBottom => point.swapped(),
    }
}

fn head(arrow: ArrowHead) -> ArrowHead {
    ArrowHead { tip: arrow.tip.swapped(), direction: arrow.direction.swapped() }
}
