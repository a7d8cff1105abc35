//! Which edge of the request is which of the layout before.

use crate::layout::graph::Graph;
use crate::layout::{CubicBezier, EdgePath, Layout, LayoutRequest, Point};
use crate::pdfa::{StateId, Symbol};

type Key = (StateId, Symbol, StateId);

/// For every edge of the graph the one of `before` with the same ends and symbol, of several in their order.
///
/// # Complexity
///
/// O(E log E) for E edges.
pub(super) fn old_edges<'a>(
    graph: &Graph,
    request: &LayoutRequest,
    before: &'a Layout,
) -> Vec<Option<&'a EdgePath>> {
    let sound = before.edges.iter().filter(|edge| is_sound(edge));
    let mut old: Vec<(Key, usize, &EdgePath)> =
        sound.enumerate().map(|(at, edge)| ((edge.source, edge.symbol, edge.target), at, edge)).collect();
    old.sort_unstable_by_key(|&(key, at, _)| (key, at));
    let key = |at: usize| {
        let asked = &request.edges[graph.edges[at].request];
        (asked.source, asked.symbol, asked.target)
    };
    let mut new: Vec<(Key, usize)> = (0..graph.edges.len()).map(|at| (key(at), at)).collect();
    new.sort_unstable();
    let mut found = vec![None; graph.edges.len()];
    let mut old = old.into_iter().peekable();
    for (key, at) in new {
        while old.next_if(|other| other.0 < key).is_some() {}
        found[at] = old.next_if(|other| other.0 == key).map(|(_, _, edge)| edge);
    }
    found
}

fn is_sound(edge: &EdgePath) -> bool {
    let finite = |point: Point| point.x.is_finite() && point.y.is_finite();
    let points = edge.path.iter().flat_map(CubicBezier::points);
    let others = [edge.label, edge.arrow.tip, edge.arrow.direction];
    !edge.path.is_empty() && points.chain(others).all(finite)
}
