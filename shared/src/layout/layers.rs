//! Layers: nodes in rows, one row a rank, with a bend in every row that an edge passes.

use super::acyclic::Component;
use super::graph::Graph;

/// Up to how many bends are added; in a component that would need more, edges that skip ranks run straight.
pub(super) const MAX_BENDS: usize = 20_000;

/// What stands in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Vertex {
    /// A node of the graph.
    Node(usize),
    /// Where an edge of the graph passes the row.
    Bend,
}

/// An edge with the vertices that it runs through, from its lower to its higher rank.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    /// Index of the edge in the graph.
    pub(super) edge: usize,
    /// First and last are nodes, bends between them.
    pub(super) vertices: Vec<usize>,
}

/// The rows of a component.
#[derive(Debug)]
pub(super) struct Layers {
    pub(super) vertices: Vec<Vertex>,
    /// Rank of every vertex.
    pub(super) ranks: Vec<usize>,
    /// Vertices of every rank, in the order across the flow.
    pub(super) rows: Vec<Vec<usize>>,
    /// In the order of the graph's edges.
    pub(super) chains: Vec<Chain>,
    /// Indices of the edges that join a node to itself.
    pub(super) loops: Vec<usize>,
    /// For every vertex, those of the next row that it is joined to; one entry per edge.
    pub(super) after: Vec<Vec<usize>>,
    /// For every vertex, those of the row before.
    pub(super) before: Vec<Vec<usize>>,
}

/// Adds the bends. `ranks` are those of the component's nodes, in their order.
pub(super) fn layers(graph: &Graph, component: &Component, ranks: &[usize]) -> Layers {
    let mut vertex_of = vec![0; graph.sizes.len()];
    component.nodes.iter().enumerate().for_each(|(vertex, &node)| vertex_of[node] = vertex);
    let mut layers = Layers {
        vertices: component.nodes.iter().map(|&node| Vertex::Node(node)).collect(),
        ranks: ranks.to_vec(),
        rows: vec![Vec::new(); ranks.iter().max().map_or(0, |last| last + 1)],
        chains: Vec::new(),
        loops: component.loops.clone(),
        after: Vec::new(),
        before: Vec::new(),
    };
    let span = |from: usize, to: usize| ranks[vertex_of[to]] - ranks[vertex_of[from]];
    let bends: usize = component.arcs.iter().map(|arc| span(arc.from, arc.to) - 1).sum();
    for arc in &component.arcs {
        let (from, to) = (vertex_of[arc.from], vertex_of[arc.to]);
        let vertices = if bends > MAX_BENDS { vec![from, to] } else { layers.bent(from, to) };
        layers.chains.push(Chain { edge: arc.edge, vertices });
    }
    layers.fill_rows();
    layers.join();
    layers
}

impl Layers {
    /// The vertices of an edge, bends added.
    fn bent(&mut self, from: usize, to: usize) -> Vec<usize> {
        let mut vertices = vec![from];
        for rank in self.ranks[from] + 1..self.ranks[to] {
            vertices.push(self.vertices.len());
            self.vertices.push(Vertex::Bend);
            self.ranks.push(rank);
        }
        vertices.push(to);
        vertices
    }

    fn fill_rows(&mut self) {
        for (vertex, &rank) in self.ranks.iter().enumerate() {
            self.rows[rank].push(vertex);
        }
    }

    fn join(&mut self) {
        self.after = vec![Vec::new(); self.vertices.len()];
        self.before = vec![Vec::new(); self.vertices.len()];
        let joints = self.chains.iter().flat_map(|chain| chain.vertices.windows(2));
        for joint in joints.filter(|joint| self.ranks[joint[0]] + 1 == self.ranks[joint[1]]) {
            self.after[joint[0]].push(joint[1]);
            self.before[joint[1]].push(joint[0]);
        }
    }
}
