//! Requests and what holds for every adjusted layout.

use std::collections::BTreeMap;

use goalgraph::layout::{
    CubicBezier, Direction, EdgePath, EdgeRequest, Layout, LayoutRequest, NodeBox, NodeRequest, Point, Rect,
};
use goalgraph::pdfa::{StateId, Symbol};

pub(super) const LABEL: (f64, f64) = (52.0, 28.0);

pub(super) fn node(id: u32) -> NodeRequest {
    let (width, height) = (60.0 + f64::from(id % 5) * 20.0, 40.0 + f64::from(id % 3) * 12.0);
    NodeRequest { id: StateId(id), width, height }
}

pub(super) fn edge(source: u32, symbol: u32, target: u32) -> EdgeRequest {
    let (source, symbol, target) = (StateId(source), Symbol(symbol), StateId(target));
    EdgeRequest { source, symbol, target, label_width: LABEL.0, label_height: LABEL.1 }
}

pub(super) fn request(nodes: u32, edges: &[(u32, u32)]) -> LayoutRequest {
    let numbered = edges.iter().zip(0..);
    LayoutRequest {
        nodes: (0..nodes).map(node).collect(),
        edges: numbered.map(|(&(source, target), symbol)| edge(source, symbol, target)).collect(),
        initial: StateId(0),
        direction: Direction::LeftToRight,
    }
}

pub(super) fn held<const N: usize>(places: [(u32, f64, f64); N]) -> BTreeMap<StateId, Point> {
    places.into_iter().map(|(id, x, y)| (StateId(id), Point::new(x, y))).collect()
}

pub(super) fn nobody() -> BTreeMap<StateId, Point> {
    BTreeMap::new()
}

pub(super) fn node_at(layout: &Layout, id: u32) -> &NodeBox {
    layout.nodes.iter().find(|node| node.id == StateId(id)).unwrap()
}

pub(super) fn rect(node: &NodeBox) -> Rect {
    Rect::centered(Point::new(node.x, node.y), node.width, node.height)
}

pub(super) fn label(edge: &EdgePath) -> Rect {
    Rect::centered(edge.label, LABEL.0, LABEL.1)
}

pub(super) fn inner(rect: &Rect, by: f64) -> Rect {
    Rect { left: rect.left + by, top: rect.top + by, right: rect.right - by, bottom: rect.bottom - by }
}

pub(super) fn points(edge: &EdgePath) -> Vec<Point> {
    let on = |curve: &CubicBezier| (0..=40).map(|step| curve.at(f64::from(step) / 40.0)).collect::<Vec<_>>();
    edge.path.iter().flat_map(on).collect()
}

pub(super) fn is_on_border(point: Point, rect: &Rect) -> bool {
    const NEAR: f64 = 1e-6;
    inner(rect, -NEAR).contains(point) && !inner(rect, NEAR).contains(point)
}

/// The states whose boxes an edge runs through that are not its own.
pub(super) fn met(layout: &Layout, edge: &EdgePath) -> Vec<StateId> {
    let others = layout.nodes.iter().filter(|node| node.id != edge.source && node.id != edge.target);
    let meets = |node: &&NodeBox| {
        let inside = inner(&rect(node), 0.5);
        points(edge).into_iter().any(|point| inside.contains(point))
    };
    others.filter(meets).map(|node| node.id).collect()
}

/// Checks everything that holds for every layout, overlapping or not.
pub(super) fn assert_sound(layout: &Layout, request: &LayoutRequest) {
    assert!(layout.nodes.iter().map(|node| node.id).eq(request.nodes.iter().map(|node| node.id)));
    let key = |edge: &EdgePath| (edge.source, edge.symbol, edge.target);
    let asked = request.edges.iter().map(|edge| (edge.source, edge.symbol, edge.target));
    assert!(layout.edges.iter().map(key).eq(asked));
    let boxes: BTreeMap<StateId, Rect> = layout.nodes.iter().map(|node| (node.id, rect(node))).collect();
    let frame = Rect {
        left: layout.left,
        top: layout.top,
        right: layout.left + layout.width,
        bottom: layout.top + layout.height,
    };
    let frame = inner(&frame, -1e-6);
    for edge in &layout.edges {
        assert!(is_on_border(edge.path[0].start, &boxes[&edge.source]), "{edge:?} {:?}", boxes[&edge.source]);
        assert!(is_on_border(edge.arrow.tip, &boxes[&edge.target]), "{edge:?} {:?}", boxes[&edge.target]);
        let end = edge.path[edge.path.len() - 1].end;
        assert!(Rect::centered(edge.arrow.base(), 1e-6, 1e-6).contains(end), "{edge:?}");
        for pair in edge.path.windows(2) {
            assert_eq!(pair[0].end, pair[1].start, "{edge:?}");
        }
        for point in points(edge).into_iter().chain([edge.label, edge.arrow.tip]) {
            assert!(
                point.x.is_finite() && point.y.is_finite() && frame.contains(point),
                "{point:?} {edge:?} {frame:?}"
            );
        }
    }
    for rect in boxes.values() {
        assert!(frame.contains(Point::new(rect.left, rect.top)));
        assert!(frame.contains(Point::new(rect.right, rect.bottom)));
    }
    if let Some(start) = layout.start {
        assert!(is_on_border(start.arrow.tip, &boxes[&request.initial]));
        assert!(frame.contains(start.from));
    }
}

pub(super) fn overlapping(layout: &Layout) -> Vec<(StateId, StateId)> {
    let pairs = layout.nodes.iter().enumerate();
    let pairs = pairs.flat_map(|(at, node)| layout.nodes[at + 1..].iter().map(move |other| (node, other)));
    let overlap = pairs.filter(|(node, other)| rect(node).overlap(&rect(other)) > 0.0);
    overlap.map(|(node, other)| (node.id, other.id)).collect()
}
