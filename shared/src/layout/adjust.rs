//! Small changes to a layout: what nobody touched stays where it is.
//!
//! ```text
//! previous + request + held -> spots (boxes: kept, held, pushed, new)
//!                           -> fates (edges: kept, shifted, routed)
//!                           -> ports -> routes -> labels -> bounds
//! ```
//!
//! Like the passes of [`layout`], these know a flow from left to right only; `turned` swaps the axes on the way in and out.

mod around;
mod bounds;
mod canvas;
mod curves;
mod fates;
mod field;
mod free;
mod labels;
mod lanes;
mod loops;
mod near;
mod old;
mod ports;
mod push;
mod routes;
mod sides;
mod spots;
mod start;
mod turned;

use std::collections::BTreeMap;

use super::graph::Graph;
use super::{Layout, LayoutRequest, NodeBox, Point, layout};
use crate::pdfa::StateId;

/// Farthest from the origin that a box may be held.
const FARTHEST: f64 = 1_000_000.0;

/// Changes `previous`, a layout in the same direction, into a layout of `request` in which everything else stays where it
/// was, to the last bit.
///
/// - States of `held` have their centers exactly there, even where boxes overlap then. A place that is not finite counts as
///   none; one beyond a million pixels is taken as a million.
/// - All others that `previous` has stay. Only where a box has grown onto a neighbor that is not held, the neighbor (or the
///   box, when the neighbor is held) is pushed aside as little as clears it.
/// - States that are new get a free place near their neighbors, along the flow.
/// - Edges whose ends neither moved nor changed size keep their path and label, unless a box that did lies on them now.
///   Edges between states that moved alike move with them. All others are routed anew around boxes, with a label that is
///   kept clear of boxes and other labels where there is room.
///
/// An unchanged request with nothing held gives `previous` back; an empty `previous` gives [`layout`]. Coordinates do not
/// shift: the drawing may reach beyond the origin, which `left` and `top` tell. While a state is dragged, call it with the
/// layout from before the drag for `previous`, so that edges which made way return.
///
/// # Complexity
///
/// O((N + E) log (N + E)) for N nodes and E edges, and O(N) for every box that grew or is new; a route searches a bounded
/// number of ways around boxes.
///
/// # Example
///
/// ```
/// use std::collections::BTreeMap;
/// use goalgraph::layout::{Direction, LayoutRequest, NodeRequest, Point, adjust, layout};
/// use goalgraph::pdfa::StateId;
///
/// let node = NodeRequest { id: StateId(0), width: 60.0, height: 40.0 };
/// let initial = StateId(0);
/// let request = LayoutRequest { nodes: vec![node], edges: vec![], initial, direction: Direction::LeftToRight };
/// let before = layout(&request);
/// let after = adjust(&before, &request, &BTreeMap::from([(initial, Point::new(-40.0, 7.0))]));
/// assert_eq!((after.nodes[0].x, after.nodes[0].y), (-40.0, 7.0));
/// ```
pub fn adjust(previous: &Layout, request: &LayoutRequest, held: &BTreeMap<StateId, Point>) -> Layout {
    if previous.nodes.is_empty() && !request.nodes.is_empty() {
        let whole = layout(request);
        return if held.is_empty() { whole } else { adjust(&whole, request, held) };
    }
    let before = turned::turned(previous, request.direction);
    let graph = Graph::new(request);
    let held = sound(held, request);
    let spots = spots::spots(&graph, request, &before, &held);
    let nodes = graph.ids.iter().zip(&spots).map(|(&id, spot)| {
        let (center, size) = (spot.center, spot.size);
        NodeBox { id, x: center.x, y: center.y, width: size.width, height: size.height }
    });
    let nodes = nodes.collect();
    let start = start::start(&graph, &before, &spots);
    let edges = routes::routes(&graph, request, &before, &spots, start.as_ref());
    let after = Layout { nodes, edges, start, ..before.clone() };
    let after = if after == before { after } else { bounds::bounded(&graph, &before, after) };
    turned::turned(&after, request.direction)
}

/// The places that are finite, not too far and in flow space.
fn sound(held: &BTreeMap<StateId, Point>, request: &LayoutRequest) -> BTreeMap<StateId, Point> {
    let finite = held.iter().filter(|(_, at)| at.x.is_finite() && at.y.is_finite());
    let near = |value: f64| value.clamp(-FARTHEST, FARTHEST);
    finite
        .map(|(&id, at)| (id, turned::point(Point::new(near(at.x), near(at.y)), request.direction)))
        .collect()
}
