//! Where states and transitions are drawn: plain geometry.
//!
//! [`LayoutRequest`] goes in, [`Layout`] comes out; nothing is drawn here. All lengths are pixels of the *drawing space*:
//! its origin is the top left corner of the drawing, x points right and y points down. Whoever shows a layout maps the
//! drawing space to a viewport.
//!
//! The method is that of Sugiyama, Tagawa and Toda (*Methods for Visual Understanding of Hierarchical System Structures*,
//! 1981), one pass a file:
//!
//! ```text
//! graph -> acyclic -> ranks -> layers -> order -> coordinates -> route -> labels -> pack
//! ```
//!
//! The crate `layout-rs` assigns the ranks and gives a first order within them; its placer and router are not used: they
//! assert what is not always so, and labels need more room than they leave.
//!
//! The passes themselves only know a flow from left to right; [`Direction::TopToBottom`] swaps the axes on the way in and
//! on the way out.

mod acyclic;
mod adjust;
mod coordinates;
pub mod drawing;
mod extents;
mod geometry;
mod graph;
mod grid;
mod labels;
mod layers;
mod order;
mod pack;
mod ranks;
mod route;
mod self_loops;
mod straighten;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::pdfa::{StateId, Symbol};

pub use adjust::adjust;
pub use geometry::{CubicBezier, Point, Rect};

/// What is to be laid out. Equal requests give equal layouts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LayoutRequest {
    /// The boxes. Of several with one id only the first is placed.
    pub nodes: Vec<NodeRequest>,
    /// The arrows between them. One with an end that is not among the nodes is left out.
    pub edges: Vec<EdgeRequest>,
    /// The node that the start arrow leads to; none is drawn when it is not among the nodes.
    pub initial: StateId,
    /// Which way the edges point.
    pub direction: Direction,
}

/// A box, with its size in pixels of the drawing space. A size that is negative or not finite counts as zero.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NodeRequest {
    /// The state it stands for.
    pub id: StateId,
    /// Width of the box.
    pub width: f64,
    /// Height of the box.
    pub height: f64,
}

/// An arrow, with the size of its label in pixels of the drawing space. A size that is negative or not finite counts as
/// zero; a label without width or height is not kept clear of others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EdgeRequest {
    /// Where it starts.
    pub source: StateId,
    /// The symbol that tells it from others with the same ends.
    pub symbol: Symbol,
    /// Where it ends.
    pub target: StateId,
    /// Width of its label.
    pub label_width: f64,
    /// Height of its label.
    pub label_height: f64,
}

/// Which way the edges point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// The initial state is on the left.
    #[default]
    LeftToRight,
    /// The initial state is at the top.
    TopToBottom,
}

/// Where everything is. All of it lies between `left` and `left + width` and between `top` and `top + height`; [`layout`]
/// leaves both at 0, [`adjust`] goes beyond where states were moved there.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Layout {
    /// The boxes, in the order of the request. No two of them overlap.
    pub nodes: Vec<NodeBox>,
    /// The arrows, in the order of the request.
    pub edges: Vec<EdgePath>,
    /// The arrow from nowhere to the initial state.
    pub start: Option<StartArrow>,
    /// Left side of the drawing.
    pub left: f64,
    /// Upper side of the drawing.
    pub top: f64,
    /// Width of the drawing.
    pub width: f64,
    /// Height of the drawing.
    pub height: f64,
}

/// Where a box is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NodeBox {
    /// The state it stands for.
    pub id: StateId,
    /// Center.
    pub x: f64,
    /// Center.
    pub y: f64,
    /// Width, as requested.
    pub width: f64,
    /// Height, as requested.
    pub height: f64,
}

/// Where an arrow is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EdgePath {
    /// Where it starts.
    pub source: StateId,
    /// Its symbol.
    pub symbol: Symbol,
    /// Where it ends.
    pub target: StateId,
    /// The shaft, from the border of the source's box to the base of the arrow head; each curve starts where the one before
    /// it ends. There is at least one.
    pub path: Vec<CubicBezier>,
    /// Center of the label.
    pub label: Point,
    /// The head.
    pub arrow: ArrowHead,
}

/// The head of an arrow: [`ARROW_LENGTH`] long, its base where the shaft ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ArrowHead {
    /// The tip, on the border of the target's box.
    pub tip: Point,
    /// Unit vector in which the head points.
    pub direction: Point,
}

/// The arrow from nowhere to the initial state: a straight line from `from` to the base of the head.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartArrow {
    /// Where it begins.
    pub from: Point,
    /// The head.
    pub arrow: ArrowHead,
}

impl ArrowHead {
    /// Where the shaft meets the head.
    pub fn base(&self) -> Point {
        Point::new(self.tip.x - ARROW_LENGTH * self.direction.x, self.tip.y - ARROW_LENGTH * self.direction.y)
    }
}

/// Length of an arrow head.
pub const ARROW_LENGTH: f64 = 9.0;

/// Length of the arrow from nowhere to the initial state, head included.
pub const START_LENGTH: f64 = 34.0;

/// Places the nodes of `request`, routes its edges around them and finds room for the labels.
///
/// Every node is placed, no two boxes overlap, every edge starts and ends on the border of its box, and everything is
/// finite and within the drawing. Edges point in the direction of the request, except those that close a cycle. Labels lie
/// on their edges and are kept apart from boxes and other labels where there is room.
///
/// # Complexity
///
/// O((N + E) log E) for N nodes and E edges that join neighboring ranks, times a constant number of sweeps; up to
/// 20,000 bends are added for edges that skip ranks.
///
/// # Example
///
/// ```
/// use goalgraph::layout::{Direction, LayoutRequest, NodeRequest, layout};
/// use goalgraph::pdfa::StateId;
///
/// let node = NodeRequest { id: StateId(0), width: 60.0, height: 40.0 };
/// let initial = StateId(0);
/// let request = LayoutRequest { nodes: vec![node], edges: vec![], initial, direction: Direction::LeftToRight };
/// assert_eq!(layout(&request).nodes.len(), 1);
/// ```
pub fn layout(request: &LayoutRequest) -> Layout {
    let graph = graph::Graph::new(request);
    let pieces: Vec<pack::Piece> = graph.components().iter().map(|nodes| piece(&graph, nodes)).collect();
    pack::pack(request, &graph, pieces)
}

/// Lays out one connected component, in a flow space of its own.
fn piece(graph: &graph::Graph, nodes: &[usize]) -> pack::Piece {
    let component = acyclic::acyclic(graph, nodes);
    let ranks = ranks::ranks(&component);
    let mut layers = layers::layers(graph, &component, &ranks);
    order::order(&mut layers);
    let place = coordinates::coordinates(graph, &layers);
    let routes = route::route(graph, &layers, &place);
    let labels = labels::labels(graph, &layers, &place, &routes);
    pack::Piece::new(graph, &layers, &place, routes, labels)
}
