//! Labels: on their edges, apart from boxes, other labels and, where possible, other edges.

use super::ARROW_LENGTH;
use super::coordinates::Place;
use super::geometry::{CubicBezier, Point, Rect};
use super::graph::Graph;
use super::grid::Grid;
use super::layers::{Layers, Vertex};
use super::route::Route;

/// How often all labels look for a better place.
const PASSES: usize = 4;

/// Room kept around a label.
const MARGIN: f64 = 2.0;

/// Up to how many edges labels also stay clear of other edges.
const MAX_CLEAR_OF_EDGES: usize = 3_000;

/// What it costs to cover one square pixel of a box or label; that of a strip along an edge costs 1.
const COVER_COST: f64 = 12.0;

/// What each step away from the best place costs.
const STEP_COST: f64 = 2.5;

/// Side of the square around an arrow head that labels leave free.
const HEAD_ROOM: f64 = 2.0 * ARROW_LENGTH;

/// Id of obstacles that are no edge's.
const BOX: usize = usize::MAX;

/// Center of the label of every route.
///
/// One label after the other takes the cheapest place on its edge while the others stay; that is repeated a few times.
///
/// # Complexity
///
/// O(E) for E edges as long as few of them share a place.
pub(super) fn labels(graph: &Graph, layers: &Layers, place: &Place, routes: &[Route]) -> Vec<Point> {
    let obstacles = obstacles(graph, layers, place, routes);
    let mut labels = Grid::default();
    let mut chosen: Vec<Option<Point>> = vec![None; routes.len()];
    for _ in 0..PASSES {
        let before = chosen.clone();
        for (at, route) in routes.iter().enumerate() {
            let size = graph.edges[route.edge].label;
            let rect = |center| Rect::centered(center, size.width, size.height).grown(MARGIN);
            if let Some(old) = chosen[at] {
                labels.remove(at, &rect(old));
            }
            let cost = |center: Point| {
                let rect = rect(center);
                let edges = obstacles.edges.overlap(at, &rect);
                COVER_COST * (labels.overlap(at, &rect) + obstacles.boxes.overlap(BOX - 1, &rect)) + edges
            };
            let best = cheapest(&route.label_places, cost);
            labels.add(at, rect(best));
            chosen[at] = Some(best);
        }
        if chosen == before {
            break;
        }
    }
    chosen.into_iter().map(Option::unwrap_or_default).collect()
}

fn cheapest(places: &[Point], cost: impl Fn(Point) -> f64) -> Point {
    let mut best = (f64::INFINITY, Point::default());
    for (step, &place) in places.iter().enumerate() {
        let least = step as f64 * STEP_COST;
        if least >= best.0 {
            break;
        }
        let cost = least + cost(place);
        if cost < best.0 {
            best = (cost, place);
        }
    }
    best.1
}

/// What labels stay clear of.
#[derive(Default)]
struct Obstacles {
    boxes: Grid,
    edges: Grid,
}

fn obstacles(graph: &Graph, layers: &Layers, place: &Place, routes: &[Route]) -> Obstacles {
    let mut obstacles = Obstacles::default();
    for (vertex, kind) in layers.vertices.iter().enumerate() {
        if let Vertex::Node(node) = kind {
            let size = graph.sizes[*node];
            obstacles.boxes.add(BOX, Rect::centered(place.centers[vertex], size.width, size.height));
        }
    }
    for route in routes {
        obstacles.boxes.add(BOX, Rect::centered(route.arrow.base(), HEAD_ROOM, HEAD_ROOM));
    }
    let few = routes.len() <= MAX_CLEAR_OF_EDGES;
    for (at, route) in routes.iter().enumerate().filter(|_| few) {
        for strip in route.path.iter().flat_map(strips) {
            obstacles.edges.add(at, strip);
        }
    }
    obstacles
}

/// Small boxes along a curve.
fn strips(curve: &CubicBezier) -> impl Iterator<Item = Rect> + use<> {
    const SIDE: f64 = 5.0;
    const MAX_STRIPS: f64 = 60.0;
    let length = (curve.end.x - curve.start.x).abs() + (curve.end.y - curve.start.y).abs();
    let count = (length / SIDE / 1.5).clamp(4.0, MAX_STRIPS) as usize;
    let curve = *curve;
    (0..count).map(move |at| Rect::centered(curve.at((at as f64 + 0.5) / count as f64), SIDE, SIDE))
}
