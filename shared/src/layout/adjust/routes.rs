//! Routes: every edge where it was, or on a new way.

use std::collections::BTreeMap;

use super::around::{around, rounded};
use super::canvas::Canvas;
use super::curves::{Ends, direct, length};
use super::fates::{Fate, fates};
use super::labels::place_label;
use super::lanes::{Lane, lanes};
use super::loops::Loops;
use super::old::old_edges;
use super::ports::{Port, ports};
use super::sides::Side;
use super::spots::Spot;
use crate::layout::graph::Graph;
use crate::layout::{
    ARROW_LENGTH, ArrowHead, CubicBezier, EdgePath, Layout, LayoutRequest, Point, StartArrow,
};

/// Up to how many edges are routed with all care; a box on a thick bundle must not make dragging it slow.
const MAX_CAREFUL: usize = 16;

/// How many lanes are tried to each side of that of an edge, with all care and without, and what a pixel beside it costs.
const MAX_LANES: [i32; 2] = [4, 2];
const LANE_COST: f64 = 0.4;

/// How many lines are tried at most for all ways around boxes: what is left then crosses boxes.
const MAX_LINES: usize = 1_600;

/// What a pixel of a way around boxes costs.
const LENGTH_COST: f64 = 0.1;

/// All edges of the graph, in its order.
pub(super) fn routes(
    graph: &Graph,
    request: &LayoutRequest,
    before: &Layout,
    spots: &[Spot],
    start: Option<&StartArrow>,
) -> Vec<EdgePath> {
    let old = old_edges(graph, request, before);
    let fates = fates(graph, spots, &old);
    let mut edges: Vec<Option<EdgePath>> =
        fates.iter().zip(&old).map(|(fate, old)| Some(shifted((*old)?, fate.shift()?))).collect();
    if fates.iter().any(|fate| matches!(fate, Fate::Routed | Fate::Relabeled)) {
        let lanes = lanes(graph, spots, &fates);
        let ports = ports(graph, spots, &fates, &old, &lanes, start);
        let canvas = Canvas::new(graph, spots, &fates, &old, start);
        let is_hasty = fates.iter().filter(|fate| fate.is_routed()).count() > MAX_CAREFUL;
        Router { graph, request, spots, fates: &fates, ports, lanes, canvas, lines: MAX_LINES, is_hasty }
            .fill(&mut edges);
    }
    edges.into_iter().flatten().collect()
}

fn shifted(edge: &EdgePath, shift: Point) -> EdgePath {
    if shift == Point::default() {
        return edge.clone();
    }
    let path = edge.path.iter().map(|curve| curve.map(|point| point.shifted(shift))).collect();
    let arrow = ArrowHead { tip: edge.arrow.tip.shifted(shift), ..edge.arrow };
    EdgePath { path, label: edge.label.shifted(shift), arrow, ..*edge }
}

/// All that routing one edge needs to know.
struct Router<'a> {
    graph: &'a Graph,
    request: &'a LayoutRequest,
    spots: &'a [Spot],
    fates: &'a [Fate],
    ports: Vec<[Port; 2]>,
    lanes: Vec<Lane>,
    canvas: Canvas,
    /// How many lines may still be tried for ways around boxes.
    lines: usize,
    /// Whether there are too many edges to try much for each.
    is_hasty: bool,
}

impl Router<'_> {
    /// Routes what has no path, and finds labels for what needs one.
    fn fill(mut self, edges: &mut [Option<EdgePath>]) {
        let mut loops: BTreeMap<usize, Loops> = self.loops(edges);
        for (at, edge) in edges.iter_mut().enumerate() {
            let label_size = self.graph.edges[at].label;
            match self.fates[at] {
                Fate::Kept | Fate::Shifted(_) => {}
                Fate::Relabeled => {
                    if let Some(edge) = edge {
                        edge.label = place_label(&mut self.canvas, at, &edge.path, label_size);
                    }
                }
                Fate::Routed => {
                    let asked = &self.request.edges[self.graph.edges[at].request];
                    let (source, symbol, target) = (asked.source, asked.symbol, asked.target);
                    let node = self.graph.edges[at].source;
                    let (path, arrow, label) = if let Some(loops) = loops.get_mut(&node)
                        && self.graph.is_loop(at)
                    {
                        let (path, arrow, label) = loops.add(&self.canvas, label_size);
                        self.canvas.add_path(at, &path, arrow);
                        self.canvas.set_label(at, label, label_size);
                        (path, arrow, label)
                    } else {
                        let (path, arrow) = self.way(at);
                        self.canvas.add_path(at, &path, arrow);
                        let label = place_label(&mut self.canvas, at, &path, label_size);
                        (path, arrow, label)
                    };
                    *edge = Some(EdgePath { source, symbol, target, path, label, arrow });
                }
            }
        }
        self.improve_labels(edges);
    }

    /// Once all edges are there, labels look for a better place.
    fn improve_labels(&mut self, edges: &mut [Option<EdgePath>]) {
        let passes = if self.is_hasty { 1 } else { 2 };
        for _ in 0..passes {
            for (at, edge) in edges.iter_mut().enumerate() {
                let is_free =
                    matches!(self.fates[at], Fate::Routed | Fate::Relabeled) && !self.graph.is_loop(at);
                if let Some(edge) = edge.as_mut().filter(|_| is_free) {
                    edge.label = place_label(&mut self.canvas, at, &edge.path, self.graph.edges[at].label);
                }
            }
        }
    }

    /// For every node that gets a loop, those that it has.
    fn loops(&self, edges: &[Option<EdgePath>]) -> BTreeMap<usize, Loops> {
        let loops = || (0..edges.len()).filter(|&at| self.graph.is_loop(at));
        let mut stacks = BTreeMap::new();
        for at in loops().filter(|&at| self.fates[at].is_routed()) {
            let node = self.graph.edges[at].source;
            stacks.entry(node).or_insert_with(|| Loops::new(self.spots[node]));
        }
        for at in loops() {
            let edge = &self.graph.edges[at];
            if let Some(stack) = stacks.get_mut(&edge.source) {
                stack.expect();
                if let Some(kept) = &edges[at] {
                    stack.keep(kept, edge.label);
                }
            }
        }
        stacks
    }

    /// The cheapest path of an edge: directly, bowing out, or around boxes.
    fn way(&mut self, at: usize) -> (Vec<CubicBezier>, ArrowHead) {
        let edge = &self.graph.edges[at];
        let nodes = [edge.source, edge.target];
        let [source, target] = self.ports[at];
        let ends = self.ends(nodes, source, target);
        let Lane { at: lane, apart, .. } = self.lanes[at];
        let mut best = (f64::INFINITY, Vec::new(), ends.arrow());
        let steps = std::iter::once(0)
            .chain((1..=MAX_LANES[usize::from(self.is_hasty)]).flat_map(|step| [step, -step]));
        for shift in steps.map(|step| f64::from(step) * apart) {
            let least = LANE_COST * shift.abs();
            if least >= best.0 {
                break;
            }
            let path = direct(&ends, lane + shift);
            let cost = least + self.canvas.path_cost(at, nodes, &path, best.0 - least);
            if cost < best.0 {
                best = (cost, path, ends.arrow());
            }
        }
        if !Canvas::is_clear(best.0) {
            self.go_around(at, nodes, ends, &mut best);
        }
        (best.1, best.2)
    }

    fn ends(&self, [source, target]: [usize; 2], from: Port, to: Port) -> Ends {
        Ends {
            start: from.side.point(&self.spots[source].rect(), from.offset),
            start_side: from.side,
            tip: to.side.point(&self.spots[target].rect(), to.offset),
            tip_side: to.side,
        }
    }

    /// Looks for a cheaper way around boxes, from the given ends or from upper or lower sides.
    fn go_around(
        &mut self,
        at: usize,
        nodes: [usize; 2],
        ends: Ends,
        best: &mut (f64, Vec<CubicBezier>, ArrowHead),
    ) {
        const ROOMS: [f64; 3] = [10.0, 19.0, 28.0];
        const RADII: [f64; 3] = [56.0, 26.0, 12.0];
        /// What runs over more ink than this is tried with more room.
        const CROWDED: f64 = 30.0;
        let level = |side: Side| {
            let port = Port { side, offset: 0.0 };
            self.ends(nodes, port, port)
        };
        for ends in [ends, level(Side::Up), level(Side::Down)] {
            for room in ROOMS {
                let Some(way) = self.way_around(&ends, room) else {
                    break;
                };
                let length = LENGTH_COST * rounded(&way, RADII[0]).iter().map(length).sum::<f64>();
                let mut found = f64::INFINITY;
                for radius in RADII {
                    let path = rounded(&way, radius);
                    found = length + self.canvas.path_cost(at, nodes, &path, best.0 - length);
                    if found < best.0 {
                        *best = (found, path, ends.arrow());
                    }
                    if Canvas::is_clear(found) {
                        break;
                    }
                }
                if self.is_hasty || !Canvas::is_clear(found) || found < length + CROWDED {
                    break;
                }
            }
            if Canvas::is_clear(best.0) {
                return;
            }
        }
    }

    /// A polyline from border to head.
    fn way_around(&mut self, ends: &Ends, room: f64) -> Option<Vec<Point>> {
        const STUB: f64 = 4.0;
        let base = ends.arrow().base();
        let beyond = |point: Point, side: Side, length: f64| {
            let out = side.outward();
            Point::new(point.x + out.x * length, point.y + out.y * length)
        };
        let from = beyond(ends.start, ends.start_side, room + STUB);
        let to = beyond(ends.tip, ends.tip_side, room.max(ARROW_LENGTH) + STUB);
        let way = around(&self.canvas.boxes, from, to, room, &mut self.lines)?;
        Some([ends.start].into_iter().chain(way).chain([base]).collect())
    }
}
