//! Routes: edges from border to border, around what stands between.

use super::ArrowHead;
use super::coordinates::Place;
use super::geometry::{CubicBezier, Point};
use super::graph::Graph;
use super::layers::{Chain, Layers, Vertex};
use super::self_loops::self_loops;

/// Largest distance of two edges on the border of a box, and least distance of an edge from the box's corner.
const PORT_GAP: f64 = 16.0;
pub(super) const CORNER: f64 = 9.0;

/// Room between the labels of edges with the same ends.
pub(super) const FAN_GAP: f64 = 8.0;

/// An edge in the flow space of its component.
#[derive(Clone, Debug)]
pub(super) struct Route {
    /// Index of the edge in the graph.
    pub(super) edge: usize,
    /// From the border of the source to the base of the head.
    pub(super) path: Vec<CubicBezier>,
    pub(super) arrow: ArrowHead,
    /// Where the label could stand, best place first; never empty.
    pub(super) label_places: Vec<Point>,
}

/// Routes all edges of the component, self-loops last.
///
/// Edges leave a box on its right border and enter on its left, those that close a cycle the other way round. Between two
/// rows an edge is one curve that is level at both ends; through a row it runs level in its own place, so that it meets no box.
///
/// # Complexity
///
/// O(V + E log E) for V vertices and E edges, bends included.
pub(super) fn route(graph: &Graph, layers: &Layers, place: &Place) -> Vec<Route> {
    let ports = ports(graph, layers, place);
    let fans = fans(graph, layers);
    let mut routes: Vec<Route> = layers
        .chains
        .iter()
        .zip(ports.iter().zip(fans))
        .map(|(chain, (ports, fan))| Track { graph, layers, place, chain, ports: *ports, fan }.route())
        .collect();
    routes.extend(self_loops(graph, layers, place));
    routes
}

/// Where each edge meets the borders of its two boxes, across the flow: at its lower rank, at its higher rank.
fn ports(graph: &Graph, layers: &Layers, place: &Place) -> Vec<[f64; 2]> {
    let mut sides = vec![[const { Vec::new() }; 2]; layers.vertices.len()];
    for (at, chain) in layers.chains.iter().enumerate() {
        let ends = &chain.vertices;
        let last = ends.len() - 1;
        sides[ends[0]][0].push((place.centers[ends[1]].y, at));
        sides[ends[last]][1].push((place.centers[ends[last - 1]].y, at));
    }
    let mut ports = vec![[0.0; 2]; layers.chains.len()];
    for (vertex, sides) in sides.iter_mut().enumerate() {
        let Vertex::Node(node) = layers.vertices[vertex] else {
            continue;
        };
        let y = place.centers[vertex].y;
        if graph.initial == Some(node) {
            sides[1].push((y, usize::MAX));
        }
        for (side, others) in sides.iter_mut().enumerate() {
            others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let first = (others.len().max(1) - 1) as f64 / 2.0;
            let gap = port_gap(graph.sizes[node].height, others.len());
            for (at, &(_, chain)) in others.iter().enumerate().filter(|(_, other)| other.1 != usize::MAX) {
                ports[chain][side] = y + (at as f64 - first) * gap;
            }
        }
    }
    for (chain, ports) in layers.chains.iter().zip(&mut ports) {
        snap(graph, layers, place, chain, ports);
    }
    ports
}

/// Moves ports a little where that makes an edge level.
fn snap(graph: &Graph, layers: &Layers, place: &Place, chain: &Chain, ports: &mut [f64; 2]) {
    const LITTLE: f64 = 4.0;
    let ends = &chain.vertices;
    let last = ends.len() - 1;
    let wishes = match last {
        1 => [f64::midpoint(ports[0], ports[1]); 2],
        _ => [place.centers[ends[1]].y, place.centers[ends[last - 1]].y],
    };
    let fits = |side: usize, vertex: usize| {
        let Vertex::Node(node) = layers.vertices[vertex] else {
            return false;
        };
        let from_center = (wishes[side] - place.centers[vertex].y).abs();
        (wishes[side] - ports[side]).abs() < LITTLE && from_center < graph.sizes[node].height / 2.0 - LITTLE
    };
    let fit = [fits(0, ends[0]), fits(1, ends[last])];
    for side in [0, 1] {
        if fit[side] && (last > 1 || fit[1 - side]) {
            ports[side] = wishes[side];
        }
    }
}

pub(super) fn port_gap(height: f64, count: usize) -> f64 {
    let room = (height - 2.0 * CORNER).max(height / 2.0);
    if count < 2 { 0.0 } else { (room / (count - 1) as f64).min(PORT_GAP) }
}

/// How far each edge bows out so that the labels of edges with the same ends stand apart.
fn fans(graph: &Graph, layers: &Layers) -> Vec<f64> {
    let ends = |chain: &Chain| (chain.vertices[0], chain.vertices[chain.vertices.len() - 1]);
    let direct = |chain: &&Chain| chain.vertices.len() == 2;
    let mut groups = std::collections::BTreeMap::new();
    for (at, chain) in layers.chains.iter().enumerate().filter(|(_, chain)| direct(chain)) {
        groups.entry(ends(chain)).or_insert_with(Vec::new).push(at);
    }
    let mut fans = vec![0.0; layers.chains.len()];
    for group in groups.values().filter(|group| group.len() > 1) {
        let label = |at: &usize| graph.edges[layers.chains[*at].edge].label.height;
        let apart = group.iter().map(label).fold(0.0, f64::max) + FAN_GAP;
        let first = (group.len() - 1) as f64 / 2.0;
        for (at, &chain) in group.iter().enumerate() {
            fans[chain] = (at as f64 - first) * apart;
        }
    }
    fans
}

/// One edge on its way.
struct Track<'a> {
    graph: &'a Graph,
    layers: &'a Layers,
    place: &'a Place,
    chain: &'a Chain,
    ports: [f64; 2],
    fan: f64,
}

impl Track<'_> {
    fn route(&self) -> Route {
        let edge = &self.graph.edges[self.chain.edge];
        let forward = self.layers.vertices[self.chain.vertices[0]] == Vertex::Node(edge.source);
        let (start, end) = (self.border(0), self.border(self.chain.vertices.len() - 1));
        let (tip, direction) = if forward { (end, 1.0) } else { (start, -1.0) };
        let arrow = ArrowHead { tip, direction: Point::new(direction, 0.0) };
        let (start, end) = if forward { (start, arrow.base()) } else { (arrow.base(), end) };
        let (mut curves, gaps) = self.curves(start, end);
        let label_places = label_places(&gaps, forward);
        if !forward {
            curves.reverse();
            for curve in &mut curves {
                *curve = curve.reversed();
            }
        }
        Route { edge: self.chain.edge, path: curves, arrow, label_places }
    }

    /// Where the edge meets the border of the box at one of its ends.
    fn border(&self, at: usize) -> Point {
        let vertex = self.chain.vertices[at];
        let side = usize::from(at > 0);
        let half = match self.layers.vertices[vertex] {
            Vertex::Node(node) => self.graph.sizes[node].width / 2.0,
            Vertex::Bend => 0.0,
        };
        let x = self.place.centers[vertex].x;
        Point::new(if side == 0 { x + half } else { x - half }, self.ports[side])
    }

    /// The whole edge, and of it the curves between rows.
    fn curves(&self, start: Point, end: Point) -> (Vec<CubicBezier>, Vec<Vec<CubicBezier>>) {
        let column = |vertex: usize| self.place.columns[self.layers.ranks[vertex]];
        let vertices = &self.chain.vertices;
        let last = vertices.len() - 1;
        let (mut curves, mut gaps) = (Vec::new(), Vec::new());
        let mut at = start;
        level(&mut curves, &mut at, column(vertices[0]).right);
        for (step, &vertex) in vertices.iter().enumerate().skip(1) {
            let (left, y) = if step == last {
                (column(vertex).left.min(end.x), end.y)
            } else {
                (column(vertex).left, self.place.centers[vertex].y)
            };
            let entry = Point::new(left, y);
            let gap = self.gap_curves(at, entry);
            curves.extend(&gap);
            gaps.push(gap);
            at = entry;
            let right = if step == last { end.x } else { column(vertex).right };
            level(&mut curves, &mut at, right);
        }
        (curves, gaps)
    }

    /// From one row to the next: one curve, or two when the edge bows out.
    fn gap_curves(&self, start: Point, end: Point) -> Vec<CubicBezier> {
        if self.fan.abs() < f64::EPSILON {
            return vec![level_ended(start, end)];
        }
        let middle = Point::new(f64::midpoint(start.x, end.x), f64::midpoint(start.y, end.y) + self.fan);
        vec![level_ended(start, middle), level_ended(middle, end)]
    }
}

/// The curve that is level at both ends.
pub(super) fn level_ended(start: Point, end: Point) -> CubicBezier {
    let middle = f64::midpoint(start.x, end.x);
    let (control_1, control_2) = (Point::new(middle, start.y), Point::new(middle, end.y));
    CubicBezier { start, control_1, control_2, end }
}

/// Adds the level line from `at` to `x`, unless it is already there.
fn level(curves: &mut Vec<CubicBezier>, at: &mut Point, x: f64) {
    const NOTHING: f64 = 0.01;
    if x - at.x > NOTHING {
        let end = Point::new(x, at.y);
        curves.push(CubicBezier::line(*at, end));
        *at = end;
    }
}

/// Places on the curves between rows: the middle of the middle one first, then further and further out.
fn label_places(gaps: &[Vec<CubicBezier>], forward: bool) -> Vec<Point> {
    const STEPS: [f64; 15] =
        [0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65, 0.3, 0.7, 0.25, 0.75, 0.2, 0.8, 0.15, 0.85];
    const MAX_GAPS: usize = 5;
    let middle = (gaps.len() - 1) / 2;
    let mut order: Vec<usize> = (0..gaps.len()).collect();
    order.sort_by_key(|&at| at.abs_diff(middle));
    let turned = |t: f64| if forward { t } else { 1.0 - t };
    order.iter().take(MAX_GAPS).flat_map(|&gap| STEPS.map(|t| point_on(&gaps[gap], turned(t)))).collect()
}

/// The point at `share` of the way along curves that follow each other, each of which counts alike.
fn point_on(curves: &[CubicBezier], share: f64) -> Point {
    let along = share * curves.len() as f64;
    let at = (along as usize).min(curves.len().saturating_sub(1));
    curves.get(at).map_or_else(Point::default, |curve| curve.at(along - at as f64))
}
