//! Coordinates: where the rows are along the flow, and their vertices across it.

use super::extents::{Extent, extents};
use super::geometry::Point;
use super::graph::Graph;
use super::layers::{Layers, Vertex};
use super::straighten::straighten;

/// How often every row is moved towards its neighbors: from both ends in turn, then between both.
const SWEEPS: usize = 24;

/// Least room between two rows.
const MIN_GAP: f64 = 64.0;

/// Room beside a label that is between two rows.
const LABEL_MARGIN: f64 = 60.0;

/// How steep edges may be: room between two rows for each pixel that the steepest edge climbs, and how much at most.
const GAP_PER_CLIMB: f64 = 0.42;
const MAX_CLIMB_GAP: f64 = 300.0;

/// The part of the flow that a row takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    pub(super) left: f64,
    pub(super) right: f64,
}

/// Where everything stands, in the flow space of the component.
#[derive(Debug)]
pub(super) struct Place {
    /// Center of every vertex.
    pub(super) centers: Vec<Point>,
    /// One for every row.
    pub(super) columns: Vec<Column>,
}

/// Places all vertices: rows keep their order, boxes their distance, and edges are as straight as that allows.
///
/// Across the flow every row in turn is moved to the least squares fit to its neighbors (weights of Gansner et al., *A
/// Technique for Drawing Directed Graphs*, 1993), which pooling adjacent violators finds exactly.
///
/// # Complexity
///
/// O(V + E) for V vertices and E edges, bends included.
pub(super) fn coordinates(graph: &Graph, layers: &Layers) -> Place {
    let extents = extents(graph, layers);
    let mut across = across(layers, &extents);
    straighten(layers, &extents, &mut across);
    let columns = columns(graph, layers, &extents, &across);
    let center = |(vertex, &y): (usize, &f64)| {
        let column = columns[layers.ranks[vertex]];
        Point::new(f64::midpoint(column.left, column.right), y)
    };
    let centers = across.iter().enumerate().map(center).collect();
    Place { centers, columns }
}

fn across(layers: &Layers, extents: &[Extent]) -> Vec<f64> {
    let mut across = vec![0.0; layers.vertices.len()];
    for row in &layers.rows {
        let offsets = offsets(row, extents);
        let middle = offsets.last().map_or(0.0, |last| last / 2.0);
        row.iter().zip(offsets).for_each(|(&vertex, offset)| across[vertex] = offset - middle);
    }
    let count = layers.rows.len();
    for sweep in 0..SWEEPS {
        let (before, after) = match sweep {
            _ if sweep * 2 >= SWEEPS => (true, true),
            _ => (sweep % 2 == 0, sweep % 2 == 1),
        };
        for step in 0..count {
            let rank = if sweep % 2 == 0 { step } else { count - 1 - step };
            fit_row(layers, extents, &layers.rows[rank], [before, after], &mut across);
        }
    }
    across
}

/// Least distances of the vertices of a row from its first.
fn offsets(row: &[usize], extents: &[Extent]) -> Vec<f64> {
    let mut offset = 0.0;
    let mut offsets = Vec::with_capacity(row.len());
    for (at, &vertex) in row.iter().enumerate() {
        if at > 0 {
            offset += extents[row[at - 1]].down + extents[vertex].up;
        }
        offsets.push(offset);
    }
    offsets
}

/// Moves a row as close to its neighbors on the given `sides` (before, after) as its distances allow.
fn fit_row(layers: &Layers, extents: &[Extent], row: &[usize], sides: [bool; 2], across: &mut [f64]) {
    const WEIGHT_TO_STAY: f64 = 0.01;
    let offsets = offsets(row, extents);
    let wish = |(&vertex, offset): (&usize, &f64)| {
        let mut wish =
            Wish { weight: WEIGHT_TO_STAY, sum: WEIGHT_TO_STAY * (across[vertex] - offset), count: 1 };
        for (neighbors, _) in
            [&layers.before, &layers.after].into_iter().zip(sides).filter(|(_, wanted)| *wanted)
        {
            for &neighbor in &neighbors[vertex] {
                let weight = straightness(layers.vertices[vertex], layers.vertices[neighbor]);
                wish.weight += weight;
                wish.sum += weight * (across[neighbor] - offset);
            }
        }
        wish
    };
    let wishes: Vec<Wish> = row.iter().zip(&offsets).map(wish).collect();
    for ((&vertex, offset), fitted) in row.iter().zip(&offsets).zip(pooled(wishes)) {
        across[vertex] = fitted + offset;
    }
}

/// How much it matters that an edge between two vertices is straight.
fn straightness(one: Vertex, other: Vertex) -> f64 {
    match (one, other) {
        (Vertex::Node(_), Vertex::Node(_)) => 1.0,
        (Vertex::Bend, Vertex::Bend) => 8.0,
        _ => 2.0,
    }
}

/// Where some vertices in sequence would like to be on average, as a weighted sum.
#[derive(Clone, Copy)]
struct Wish {
    weight: f64,
    sum: f64,
    count: usize,
}

/// The non-decreasing values closest to the wishes: isotonic regression by pooling adjacent violators.
fn pooled(wishes: Vec<Wish>) -> Vec<f64> {
    let mut pools: Vec<Wish> = Vec::new();
    for wish in wishes {
        let mut pool = wish;
        while let Some(last) = pools.pop_if(|last| last.sum * pool.weight > pool.sum * last.weight) {
            pool.weight += last.weight;
            pool.sum += last.sum;
            pool.count += last.count;
        }
        pools.push(pool);
    }
    pools.iter().flat_map(|pool| std::iter::repeat_n(pool.sum / pool.weight, pool.count)).collect()
}

/// The rows along the flow, with room between them for labels and for edges that climb.
fn columns(graph: &Graph, layers: &Layers, extents: &[Extent], across: &[f64]) -> Vec<Column> {
    let gaps = gaps(graph, layers, across);
    let mut left = 0.0;
    let mut columns = Vec::with_capacity(layers.rows.len());
    for (rank, row) in layers.rows.iter().enumerate() {
        let width = row.iter().fold(0.0, |widest, &vertex| f64::max(widest, extents[vertex].width));
        let right = left + width;
        columns.push(Column { left, right });
        left = right + gaps.get(rank).copied().unwrap_or(0.0);
    }
    columns
}

/// What is between a row and the next.
#[derive(Clone, Copy, Default)]
struct Gap {
    label_width: f64,
    label_height: f64,
    climb: f64,
    first: f64,
    last: f64,
}

impl Gap {
    fn add(&mut self, from: f64, to: f64) {
        self.climb = self.climb.max((to - from).abs());
        self.first = self.first.min(from).min(to);
        self.last = self.last.max(from).max(to);
    }

    /// As many labels stand side by side as do not fit one below the other.
    fn width(&self) -> f64 {
        const ROOM_PER_LABEL: f64 = 2.3;
        const MAX_SIDE_BY_SIDE: f64 = 3.0;
        let height = (self.last - self.first).max(1.0) + ROOM_PER_LABEL * 40.0;
        let side_by_side = (ROOM_PER_LABEL * self.label_height / height).clamp(1.0, MAX_SIDE_BY_SIDE);
        let climb = (GAP_PER_CLIMB * self.climb).min(MAX_CLIMB_GAP);
        MIN_GAP.max(side_by_side * self.label_width + LABEL_MARGIN).max(climb)
    }
}

fn gaps(graph: &Graph, layers: &Layers, across: &[f64]) -> Vec<f64> {
    let mut gaps = vec![Gap::default(); layers.rows.len().saturating_sub(1)];
    for chain in &layers.chains {
        let label = graph.edges[chain.edge].label;
        let home = layers.ranks[chain.vertices[(chain.vertices.len() - 1) / 2]];
        if let Some(gap) = gaps.get_mut(home) {
            gap.label_width = gap.label_width.max(label.width);
            gap.label_height += label.height;
        }
        for joint in chain.vertices.windows(2) {
            if let Some(gap) = gaps.get_mut(layers.ranks[joint[0]]) {
                gap.add(across[joint[0]], across[joint[1]]);
            }
        }
    }
    gaps.iter().map(Gap::width).collect()
}
