//! Components side by side, in the drawing space.

use super::coordinates::Place;
use super::geometry::{Point, Rect};
use super::graph::Graph;
use super::layers::{Layers, Vertex};
use super::route::Route;
use super::{ArrowHead, Direction, EdgePath, Layout, LayoutRequest, NodeBox, START_LENGTH, StartArrow};

/// Room around the drawing.
pub(super) const MARGIN: f64 = 16.0;

/// Room between components.
const COMPONENT_GAP: f64 = 36.0;

/// How wide a shelf of components may get when the first component is smaller.
const SHELF_WIDTH: f64 = 900.0;

/// A component that is laid out in a flow space of its own.
#[derive(Debug)]
pub(super) struct Piece {
    /// Nodes of the graph with their centers.
    nodes: Vec<(usize, Point)>,
    routes: Vec<Route>,
    /// Center of every route's label.
    labels: Vec<Point>,
    start: Option<StartArrow>,
    bounds: Rect,
}

impl Piece {
    pub(super) fn new(
        graph: &Graph,
        layers: &Layers,
        place: &Place,
        routes: Vec<Route>,
        labels: Vec<Point>,
    ) -> Self {
        let node = |(vertex, kind): (usize, &Vertex)| match kind {
            Vertex::Node(node) => Some((*node, place.centers[vertex])),
            Vertex::Bend => None,
        };
        let nodes: Vec<(usize, Point)> = layers.vertices.iter().enumerate().filter_map(node).collect();
        let initial = nodes.iter().find(|(node, _)| graph.initial == Some(*node));
        let start = initial.map(|&(node, center)| start_arrow(center, graph.sizes[node].width));
        let mut piece =
            Self { nodes, routes, labels, start, bounds: Rect::centered(Point::default(), 0.0, 0.0) };
        piece.bounds = piece.measured(graph);
        piece
    }

    /// The smallest box that holds everything.
    fn measured(&self, graph: &Graph) -> Rect {
        let around =
            |center: Point, size: super::graph::Size| Rect::centered(center, size.width, size.height);
        let point = |point: Point| Rect::centered(point, 0.0, 0.0);
        let nodes = self.nodes.iter().map(|&(node, center)| around(center, graph.sizes[node]));
        let labels = self.routes.iter().zip(&self.labels);
        let labels = labels.map(|(route, &label)| around(label, graph.edges[route.edge].label));
        let curves = self
            .routes
            .iter()
            .flat_map(|route| &route.path)
            .flat_map(super::geometry::CubicBezier::points)
            .map(point);
        let heads = self.routes.iter().map(|route| point(route.arrow.tip));
        let start = self.start.iter().map(|start| point(start.from));
        let parts = nodes.chain(labels).chain(curves).chain(heads).chain(start);
        parts.reduce(|all, part| all.union(&part)).unwrap_or(self.bounds)
    }
}

fn start_arrow(center: Point, width: f64) -> StartArrow {
    let tip = Point::new(center.x - width / 2.0, center.y);
    let from = Point::new(tip.x - START_LENGTH, tip.y);
    StartArrow { from, arrow: ArrowHead { tip, direction: Point::new(1.0, 0.0) } }
}

/// Puts the pieces on shelves, the first one on top, and turns flow space into drawing space.
pub(super) fn pack(request: &LayoutRequest, graph: &Graph, pieces: Vec<Piece>) -> Layout {
    let (shifts, width, height) = shelves(&pieces);
    let mut picture = Picture { request, nodes: vec![None; graph.ids.len()], edges: Vec::new(), start: None };
    for (piece, shift) in pieces.into_iter().zip(shifts) {
        picture.add(graph, piece, shift);
    }
    let mut edges = picture.edges;
    edges.sort_by_key(|(at, _)| *at);
    let extent = oriented(request.direction, Point::new(width, height));
    Layout {
        nodes: picture.nodes.into_iter().flatten().collect(),
        edges: edges.into_iter().map(|(_, edge)| edge).collect(),
        start: picture.start,
        left: 0.0,
        top: 0.0,
        width: extent.x,
        height: extent.y,
    }
}

/// How far each piece is moved, and the size of all together.
fn shelves(pieces: &[Piece]) -> (Vec<Point>, f64, f64) {
    let size =
        |piece: &Piece| (piece.bounds.right - piece.bounds.left, piece.bounds.bottom - piece.bounds.top);
    let widest = pieces.first().map_or(0.0, |piece| size(piece).0).max(SHELF_WIDTH);
    let (mut x, mut y, mut shelf, mut right) = (MARGIN, MARGIN, 0.0_f64, MARGIN);
    let mut shifts = Vec::with_capacity(pieces.len());
    for (at, piece) in pieces.iter().enumerate() {
        let (width, height) = size(piece);
        if at == 1 || (at > 1 && x + width > widest) {
            (x, y, shelf) = (MARGIN, y + shelf + COMPONENT_GAP, 0.0);
        }
        shifts.push(Point::new(x - piece.bounds.left, y - piece.bounds.top));
        right = right.max(x + width);
        shelf = shelf.max(height);
        x += width + COMPONENT_GAP;
    }
    (shifts, right + MARGIN, y + shelf + MARGIN)
}

/// The drawing as it is put together.
struct Picture<'a> {
    request: &'a LayoutRequest,
    nodes: Vec<Option<NodeBox>>,
    /// With their positions in the request.
    edges: Vec<(usize, EdgePath)>,
    start: Option<StartArrow>,
}

impl Picture<'_> {
    fn add(&mut self, graph: &Graph, piece: Piece, shift: Point) {
        let direction = self.request.direction;
        let moved = |point: Point| oriented(direction, point.shifted(shift));
        let head = |arrow: ArrowHead| ArrowHead {
            tip: moved(arrow.tip),
            direction: oriented(direction, arrow.direction),
        };
        for (node, center) in piece.nodes {
            let (center, size) = (moved(center), graph.sizes[node]);
            let size = oriented(direction, Point::new(size.width, size.height));
            let (id, x, y, width, height) = (graph.ids[node], center.x, center.y, size.x, size.y);
            self.nodes[node] = Some(NodeBox { id, x, y, width, height });
        }
        for (route, label) in piece.routes.into_iter().zip(piece.labels) {
            let at = graph.edges[route.edge].request;
            let asked = &self.request.edges[at];
            let path = route.path.iter().map(|curve| curve.map(moved)).collect();
            let (source, symbol, target) = (asked.source, asked.symbol, asked.target);
            let (label, arrow) = (moved(label), head(route.arrow));
            self.edges.push((at, EdgePath { source, symbol, target, path, label, arrow }));
        }
        if let Some(start) = piece.start {
            self.start = Some(StartArrow { from: moved(start.from), arrow: head(start.arrow) });
        }
    }
}

fn oriented(direction: Direction, point: Point) -> Point {
    match direction {
        Direction::LeftToRight => point,
        Direction::TopToBottom => point.swapped(),
    }
}
