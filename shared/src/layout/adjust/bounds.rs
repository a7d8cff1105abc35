//! Bounds: the frame around everything.

use super::curves::hull;
use crate::layout::graph::Graph;
use crate::layout::pack::MARGIN;
use crate::layout::{Layout, NodeBox, Point, Rect};

/// The layout with the frame that fits it; a side that is where it was before stays there to the last bit.
pub(super) fn bounded(graph: &Graph, before: &Layout, layout: Layout) -> Layout {
    let point = |point: Point| Rect::centered(point, 0.0, 0.0);
    let node = |node: &NodeBox| Rect::centered(Point::new(node.x, node.y), node.width, node.height);
    let nodes = layout.nodes.iter().map(node);
    let paths = layout.edges.iter().filter_map(|edge| hull(&edge.path));
    let heads = layout.edges.iter().map(|edge| point(edge.arrow.tip));
    let labels = layout.edges.iter().zip(&graph.edges);
    let labels =
        labels.map(|(edge, asked)| Rect::centered(edge.label, asked.label.width, asked.label.height));
    let start = layout.start.iter().map(|start| point(start.from));
    let all = nodes.chain(paths).chain(heads).chain(labels).chain(start).reduce(|all, part| all.union(&part));
    let all = all.map_or_else(|| point(Point::default()), |all| all.grown(MARGIN));
    let left = same_or(before.left, all.left);
    let top = same_or(before.top, all.top);
    let right = same_or(before.left + before.width, all.right);
    let bottom = same_or(before.top + before.height, all.bottom);
    Layout { left, top, width: right - left, height: bottom - top, ..layout }
}

fn same_or(before: f64, after: f64) -> f64 {
    const SAME: f64 = 1e-6;
    if (before - after).abs() < SAME { before } else { after }
}
