//! Free places for boxes that are new.

use std::collections::VecDeque;

use super::curves::strips;
use super::field::Field;
use super::old::old_edges;
use super::spots::Spot;
use crate::layout::extents::{LOOP_LABEL_GAP, loop_rises};
use crate::layout::graph::{Graph, Size};
use crate::layout::{Layout, LayoutRequest, Point, Rect};

/// Least room between a new box and others, and what it would like to have.
const LEAST_GAP: f64 = 14.0;
const GAP: f64 = 40.0;

/// Room along the flow between a new box and its neighbors, beside the labels of the edges between.
const FLOW_GAP: f64 = 60.0;

/// How far each try is from the one before, along and across the flow, and how many there are to each side.
const STEP: Size = Size { width: 70.0, height: 22.0 };
const MAX_STEPS: Size = Size { width: 4.0, height: 24.0 };

/// What a pixel off the wished place costs along the flow (across it costs 1), and a pixel on an edge or label.
const FLOW_COST: f64 = 1.3;
const INK_COST: f64 = 0.08;

/// What it costs to have less room than wished for.
const CROWDED_COST: f64 = 60.0;

/// What a box needs beside itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// For self-loops above it.
    pub(super) above: f64,
}

/// Finds places for the nodes without one, those with neighbors that have one first.
pub(super) fn place_new(
    graph: &Graph,
    request: &LayoutRequest,
    before: &Layout,
    mut spots: Vec<Option<Spot>>,
) -> Vec<Spot> {
    if spots.iter().any(Option::is_none) {
        let ink = ink(graph, request, before, &spots);
        let edges = edges_of(graph);
        for node in in_order(graph, &edges, &spots) {
            let others: Vec<Rect> = spots.iter().flatten().map(Spot::rect).collect();
            let (size, room) = (graph.sizes[node], room(graph, &edges[node]));
            let wish = wish(graph, &edges[node], node, &spots, &others);
            let center = free_place(wish, size, room, &others, |rect| INK_COST * covered(&ink, rect));
            spots[node] = Some(Spot { center, size, before: None, held: false });
        }
    }
    spots.into_iter().flatten().collect()
}

/// For every node its edges.
fn edges_of(graph: &Graph) -> Vec<Vec<usize>> {
    let mut edges = vec![Vec::new(); graph.sizes.len()];
    for (at, edge) in graph.edges.iter().enumerate() {
        edges[edge.source].push(at);
        if edge.target != edge.source {
            edges[edge.target].push(at);
        }
    }
    edges
}

/// The nodes without a place: those that edges lead to from one with a place, then those that edges lead from, breadth
/// first, then the rest with what hangs on them.
fn in_order(graph: &Graph, edges: &[Vec<usize>], spots: &[Option<Spot>]) -> Vec<usize> {
    let mut seen: Vec<bool> = spots.iter().map(Option::is_some).collect();
    let (placed, new): (Vec<usize>, Vec<usize>) = (0..spots.len()).partition(|&node| seen[node]);
    let mut onward = VecDeque::from(placed);
    let mut back = VecDeque::new();
    let mut order = Vec::new();
    let mut roots = new.into_iter();
    loop {
        let is_back = onward.is_empty();
        let Some(node) = onward.pop_front().or_else(|| back.pop_front()) else {
            let Some(root) = roots.by_ref().find(|&root| !seen[root]) else {
                return order;
            };
            seen[root] = true;
            order.push(root);
            onward.push_back(root);
            continue;
        };
        for edge in edges[node].iter().map(|&edge| &graph.edges[edge]) {
            let (end, wanted) = if is_back { (edge.source, edge.target) } else { (edge.target, edge.source) };
            if wanted == node && !std::mem::replace(&mut seen[end], true) {
                order.push(end);
                onward.push_back(end);
            }
        }
        if !is_back {
            back.push_back(node);
        }
    }
}

/// The room above a node for its self-loops.
fn room(graph: &Graph, edges: &[usize]) -> Room {
    let loops = edges.iter().map(|&edge| &graph.edges[edge]).filter(|edge| edge.source == edge.target);
    let labels: Vec<Size> = loops.map(|edge| edge.label).collect();
    let top = loop_rises(&labels).last().copied().zip(labels.last());
    Room { above: top.map_or(0.0, |(rise, label)| rise + LOOP_LABEL_GAP + label.height) }
}

/// Where a node would stand best: after those that lead to it, before those that it leads to, in their middle across the
/// flow. Without neighbors: below everything.
fn wish(graph: &Graph, edges: &[usize], node: usize, spots: &[Option<Spot>], others: &[Rect]) -> Point {
    let half = graph.sizes[node].width / 2.0;
    let (mut after, mut until) = (f64::NEG_INFINITY, f64::INFINITY);
    let (mut across, mut count) = (0.0, 0);
    for edge in edges.iter().map(|&edge| &graph.edges[edge]).filter(|edge| edge.source != edge.target) {
        let gap = FLOW_GAP + edge.label.width + half;
        let other = if edge.source == node { edge.target } else { edge.source };
        let Some(rect) = spots[other].map(|spot| spot.rect()) else {
            continue;
        };
        if edge.source == node {
            until = until.min(rect.left - gap);
        } else {
            after = after.max(rect.right + gap);
        }
        across += f64::midpoint(rect.top, rect.bottom);
        count += 1;
    }
    if count == 0 {
        let left = others.iter().fold(f64::INFINITY, |left, rect| left.min(rect.left));
        let bottom = others.iter().fold(f64::NEG_INFINITY, |bottom, rect| bottom.max(rect.bottom));
        let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
        return Point::new(finite(left) + half, finite(bottom) + 2.0 * GAP + graph.sizes[node].height / 2.0);
    }
    let along = match (after.is_finite(), until.is_finite()) {
        (true, true) => f64::midpoint(after, until),
        (true, false) => after,
        _ => until,
    };
    Point::new(along, across / f64::from(count))
}

/// The cheapest place near `wish` at which a box keeps clear of all `others`; below all of them when there is none.
pub(super) fn free_place(
    wish: Point,
    size: Size,
    room: Room,
    others: &[Rect],
    cost_of_ink: impl Fn(&Rect) -> f64,
) -> Point {
    let mut best = (f64::INFINITY, None);
    for (along, across) in tries() {
        let center = Point::new(wish.x + along, wish.y + across);
        let distance = FLOW_COST * along.abs() + across.abs();
        if distance >= best.0 {
            continue;
        }
        let mut rect = Rect::centered(center, size.width, size.height);
        rect.top -= room.above;
        let near = |gap: f64| others.iter().any(|other| other.overlap(&rect.grown(gap)) > 0.0);
        if near(LEAST_GAP) {
            continue;
        }
        let crowded = if near(GAP) { CROWDED_COST } else { 0.0 };
        let cost = distance + crowded + cost_of_ink(&rect);
        if cost < best.0 {
            best = (cost, Some(center));
        }
    }
    best.1.unwrap_or_else(|| {
        let bottom = others.iter().fold(wish.y, |bottom, rect| bottom.max(rect.bottom));
        Point::new(wish.x, bottom + GAP + room.above + size.height / 2.0)
    })
}

/// Shifts from the wished place, along and across the flow.
fn tries() -> impl Iterator<Item = (f64, f64)> {
    let steps = |count: f64| {
        let sides = (1..=count as i32).flat_map(|step| [step, -step]);
        std::iter::once(0).chain(sides).map(f64::from)
    };
    steps(MAX_STEPS.width)
        .flat_map(move |x| steps(MAX_STEPS.height).map(move |y| (x * STEP.width, y * STEP.height)))
}

/// The edges and labels that are there already.
fn ink(graph: &Graph, request: &LayoutRequest, before: &Layout, spots: &[Option<Spot>]) -> Field {
    let boxes = spots.iter().flatten().map(Spot::rect);
    let bounds = boxes.reduce(|all, rect| all.union(&rect));
    let mut ink = Field::new(bounds.unwrap_or_else(|| Rect::centered(Point::default(), 1.0, 1.0)), 64.0);
    for (at, edge) in old_edges(graph, request, before).into_iter().enumerate() {
        let Some(edge) = edge else { continue };
        let label = graph.edges[at].label;
        ink.add(at, Rect::centered(edge.label, label.width, label.height));
        for strip in edge.path.iter().flat_map(strips) {
            ink.add(at, strip);
        }
    }
    ink
}

fn covered(ink: &Field, rect: &Rect) -> f64 {
    let mut area = 0.0;
    ink.visit(rect, |_, other| area += other.overlap(rect));
    area
}
