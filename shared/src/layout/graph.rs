//! The request as a graph over indices, in which everything is sound.

use std::collections::BTreeMap;

use super::{Direction, LayoutRequest};
use crate::pdfa::StateId;

/// A size in flow space: `width` along the flow, `height` across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Size {
    pub(super) width: f64,
    pub(super) height: f64,
}

/// An edge between two nodes of the graph, which may be one and the same.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    /// Its position in the request.
    pub(super) request: usize,
    pub(super) source: usize,
    pub(super) target: usize,
    pub(super) label: Size,
}

/// The request with indices for ids, sizes finite and not negative, and no edge without ends.
#[derive(Debug)]
pub(super) struct Graph {
    /// The first of each id in the request.
    pub(super) ids: Vec<StateId>,
    pub(super) sizes: Vec<Size>,
    pub(super) edges: Vec<Edge>,
    pub(super) initial: Option<usize>,
}

impl Graph {
    pub(super) fn new(request: &LayoutRequest) -> Self {
        let size = |width, height| flow_size(request.direction, width, height);
        let mut index_of = BTreeMap::new();
        let (mut ids, mut sizes) = (Vec::new(), Vec::new());
        for node in &request.nodes {
            if index_of.contains_key(&node.id) {
                continue;
            }
            index_of.insert(node.id, ids.len());
            ids.push(node.id);
            sizes.push(size(node.width, node.height));
        }
        let edges = request.edges.iter().enumerate().filter_map(|(at, edge)| {
            let (source, target) = (*index_of.get(&edge.source)?, *index_of.get(&edge.target)?);
            Some(Edge { request: at, source, target, label: size(edge.label_width, edge.label_height) })
        });
        let edges = edges.collect();
        let initial = index_of.get(&request.initial).copied();
        Self { ids, sizes, edges, initial }
    }

    /// Whether an edge joins a node to itself.
    pub(super) fn is_loop(&self, edge: usize) -> bool {
        self.edges[edge].source == self.edges[edge].target
    }

    /// The connected components, that of the initial node first, the others by their first node; nodes in ascending order.
    pub(super) fn components(&self) -> Vec<Vec<usize>> {
        let mut neighbors = vec![Vec::new(); self.sizes.len()];
        for edge in &self.edges {
            neighbors[edge.source].push(edge.target);
            neighbors[edge.target].push(edge.source);
        }
        let mut seen = vec![false; neighbors.len()];
        let roots = self.initial.into_iter().chain(0..neighbors.len());
        let mut components = Vec::new();
        for root in roots {
            let component = reach(root, &neighbors, &mut seen);
            if !component.is_empty() {
                components.push(component);
            }
        }
        components
    }
}

/// All nodes that can be reached from `root` and were not seen before, in ascending order.
fn reach(root: usize, neighbors: &[Vec<usize>], seen: &mut [bool]) -> Vec<usize> {
    let (mut found, mut stack) = (Vec::new(), vec![root]);
    while let Some(node) = stack.pop() {
        if std::mem::replace(&mut seen[node], true) {
            continue;
        }
        found.push(node);
        stack.extend(&neighbors[node]);
    }
    found.sort_unstable();
    found
}

/// Largest size that is taken at its word; keeps sums of sizes finite and exact enough.
const LARGEST: f64 = 10_000.0;

fn flow_size(direction: Direction, width: f64, height: f64) -> Size {
    let sound = |size: f64| {
        if size.is_finite() { size.clamp(0.0, LARGEST) } else { 0.0 }
    };
    match direction {
        Direction::LeftToRight => Size { width: sound(width), height: sound(height) },
        Direction::TopToBottom => Size { width: sound(height), height: sound(width) },
    }
}
