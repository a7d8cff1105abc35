//! Room that a vertex needs around its center, with its self-loops and some space for the labels of its edges.

use super::ARROW_LENGTH;
use super::graph::{Graph, Size};
use super::layers::{Layers, Vertex};

/// Room between the boxes of two nodes in one row.
const NODE_GAP: f64 = 28.0;

/// Half the room for an edge that passes a row.
const BEND_EXTENT: f64 = 9.0;

/// Which share of their labels' heights the edges on one side of a node have room for.
const LABEL_SHARE: f64 = 0.72;

/// Up to how many edges on one side of a node there is more room for.
const MAX_LABELS: usize = 8;

/// How far a self-loop rises above its node, or above the label of the loop below it.
pub(super) const LOOP_RISE: f64 = ARROW_LENGTH + 15.0;

/// Room between a self-loop and its label.
pub(super) const LOOP_LABEL_GAP: f64 = 3.0;

/// Room of a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// Before the center, across the flow.
    pub(super) up: f64,
    /// After the center, across the flow.
    pub(super) down: f64,
    /// Along the flow, self-loops and their labels included.
    pub(super) width: f64,
}

/// How far the top of each self-loop of a node is above its box: the labels of the loops below lie between.
pub(super) fn loop_rises(labels: &[Size]) -> Vec<f64> {
    let mut top = 0.0;
    let mut rises = Vec::new();
    for label in labels {
        rises.push(top + LOOP_RISE);
        top += LOOP_RISE + LOOP_LABEL_GAP + label.height;
    }
    rises
}

/// Half of how wide each self-loop of a node must be to run around the labels of those below.
pub(super) fn loop_half_widths(labels: &[Size]) -> Vec<f64> {
    const ROOM: f64 = 8.0;
    let mut half = 0.0;
    let mut halves = Vec::with_capacity(labels.len());
    for label in labels {
        halves.push(half);
        half = (label.width / 2.0 + ROOM).max(half + ROOM);
    }
    halves
}

/// The labels of each node's self-loops, by node of the graph.
pub(super) fn loop_labels(graph: &Graph, layers: &Layers) -> Vec<Vec<Size>> {
    let mut labels = vec![Vec::new(); graph.sizes.len()];
    for edge in layers.loops.iter().map(|&edge| &graph.edges[edge]) {
        labels[edge.source].push(edge.label);
    }
    labels
}

/// The room of every vertex.
pub(super) fn extents(graph: &Graph, layers: &Layers) -> Vec<Extent> {
    let label_heights = label_heights(graph, layers);
    let loops = loop_labels(graph, layers);
    let extent = |(vertex, kind): (usize, &Vertex)| match kind {
        Vertex::Bend => Extent { up: BEND_EXTENT, down: BEND_EXTENT, width: 0.0 },
        Vertex::Node(node) => {
            let size = graph.sizes[*node];
            let half = (size.height / 2.0).max(label_heights[vertex] * LABEL_SHARE / 2.0) + NODE_GAP / 2.0;
            let rise = loop_rises(&loops[*node]).last().map_or(0.0, |rise| {
                size.height / 2.0
                    + rise
                    + LOOP_LABEL_GAP
                    + loops[*node].last().map_or(0.0, |label| label.height)
            });
            let widest = loops[*node].iter().fold(size.width, |widest, label| widest.max(label.width));
            let widest = loop_half_widths(&loops[*node]).last().map_or(widest, |half| widest.max(2.0 * half));
            Extent { up: half.max(rise + NODE_GAP / 2.0), down: half, width: widest }
        }
    };
    layers.vertices.iter().enumerate().map(extent).collect()
}

/// Height of the labels on the busier side of each vertex.
fn label_heights(graph: &Graph, layers: &Layers) -> Vec<f64> {
    let mut sides = vec![[(0, 0.0); 2]; layers.vertices.len()];
    for chain in &layers.chains {
        let height = graph.edges[chain.edge].label.height;
        let ends = [chain.vertices.first(), chain.vertices.last()];
        for (side, vertex) in ends.into_iter().enumerate() {
            let Some(&vertex) = vertex else { continue };
            let (count, sum) = &mut sides[vertex][side];
            if *count < MAX_LABELS {
                *count += 1;
                *sum += height;
            }
        }
    }
    sides.iter().map(|[left, right]| f64::max(left.1, right.1)).collect()
}
