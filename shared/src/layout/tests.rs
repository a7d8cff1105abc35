//! Layouts of small graphs, and what holds for the layout of any graph.

mod any_graph;
mod small_graphs;

use std::collections::BTreeMap;

use super::*;

fn node(id: u32) -> NodeRequest {
    NodeRequest {
        id: StateId(id),
        width: 60.0 + f64::from(id % 5) * 20.0,
        height: 40.0 + f64::from(id % 3) * 12.0,
    }
}

fn edge(source: u32, symbol: u32, target: u32) -> EdgeRequest {
    let (source, symbol, target) = (StateId(source), Symbol(symbol), StateId(target));
    EdgeRequest { source, symbol, target, label_width: 52.0, label_height: 28.0 }
}

fn request(nodes: u32, edges: &[(u32, u32)], direction: Direction) -> LayoutRequest {
    let numbered = edges.iter().zip(0..);
    LayoutRequest {
        nodes: (0..nodes).map(node).collect(),
        edges: numbered.map(|(&(source, target), symbol)| edge(source, symbol, target)).collect(),
        initial: StateId(0),
        direction,
    }
}

/// The automaton of `goals` sub-goals in any order.
fn lattice(goals: u32) -> LayoutRequest {
    let steps = (0..1_u32 << goals).flat_map(|set| (0..goals).map(move |goal| (set, set | 1 << goal)));
    let edges: Vec<(u32, u32)> = steps.filter(|(from, to)| from != to).collect();
    request(1 << goals, &edges, Direction::LeftToRight)
}

fn rect(node: &NodeBox) -> Rect {
    Rect::centered(Point::new(node.x, node.y), node.width, node.height)
}

fn is_on_border(point: Point, rect: &Rect) -> bool {
    const NEAR: f64 = 1e-6;
    rect.grown(NEAR).contains(point) && !rect.grown(-NEAR).contains(point)
}

/// Everything that holds for every layout; returns the layout.
fn checked(request: &LayoutRequest) -> Layout {
    let layout = layout(request);
    assert_eq!(layout, super::layout(request), "the same request gives the same layout");
    let placed = layout.nodes.iter().map(|node| node.id);
    assert!(placed.eq(request.nodes.iter().map(|node| node.id)));
    assert_eq!(layout.edges.len(), request.edges.len());
    assert_no_overlap(&layout);
    let boxes: BTreeMap<StateId, Rect> = layout.nodes.iter().map(|node| (node.id, rect(node))).collect();
    for edge in &layout.edges {
        assert_edge(edge, &boxes, &layout);
    }
    for node in &layout.nodes {
        assert_within(Point::new(rect(node).left, rect(node).top), &layout);
        assert_within(Point::new(rect(node).right, rect(node).bottom), &layout);
    }
    layout
}

fn assert_no_overlap(layout: &Layout) {
    for (at, node) in layout.nodes.iter().enumerate() {
        for other in &layout.nodes[at + 1..] {
            assert!(rect(node).overlap(&rect(other)) <= 0.0, "{node:?} overlaps {other:?}");
        }
    }
}

fn assert_edge(edge: &EdgePath, boxes: &BTreeMap<StateId, Rect>, layout: &Layout) {
    assert!(is_on_border(edge.path[0].start, &boxes[&edge.source]), "{edge:?}");
    assert!(is_on_border(edge.arrow.tip, &boxes[&edge.target]), "{edge:?}");
    let end = edge.path[edge.path.len() - 1].end;
    assert!(Rect::centered(edge.arrow.base(), 1e-6, 1e-6).contains(end), "{edge:?}");
    for pair in edge.path.windows(2) {
        assert_eq!(pair[0].end, pair[1].start, "{edge:?}");
    }
    let points = edge.path.iter().flat_map(CubicBezier::points);
    points.chain([edge.label, edge.arrow.tip]).for_each(|point| assert_within(point, layout));
}

fn assert_within(point: Point, layout: &Layout) {
    let page = Rect { left: 0.0, top: 0.0, right: layout.width, bottom: layout.height };
    assert!(page.contains(point), "{point:?} is not within {} x {}", layout.width, layout.height);
}
