//! Cycles are broken: edges that close one are turned around for the passes that follow.

use super::graph::Graph;

/// An edge as it is ranked: `from` stands before `to`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    /// Index of the edge in the graph.
    pub(super) edge: usize,
    pub(super) from: usize,
    pub(super) to: usize,
}

/// A connected part of the graph, without cycles.
#[derive(Debug)]
pub(super) struct Component {
    /// Its nodes in topological order.
    pub(super) nodes: Vec<usize>,
    /// Its edges in the order of the graph, those that close a cycle turned around, self-loops left out.
    pub(super) arcs: Vec<Arc>,
    /// Indices of the edges that join a node to itself.
    pub(super) loops: Vec<usize>,
}

/// Turns around the edges of the component `nodes` that close a cycle in a depth-first search from the initial node.
///
/// # Complexity
///
/// O(N + E) for the whole graph's N nodes and E edges, which is also paid for a small component.
pub(super) fn acyclic(graph: &Graph, nodes: &[usize]) -> Component {
    let mut member = vec![false; graph.sizes.len()];
    for &node in nodes {
        member[node] = true;
    }
    let inside = |edge: &usize| member[graph.edges[*edge].source];
    let (loops, edges): (Vec<usize>, Vec<usize>) = (0..graph.edges.len())
        .filter(inside)
        .partition(|&edge| graph.edges[edge].source == graph.edges[edge].target);
    let mut search = Search::new(graph, &edges);
    let without_way_in = nodes.iter().filter(|node| !search.has_way_in[**node]);
    let initial = graph.initial.iter().filter(|node| member[**node]);
    let roots: Vec<usize> = initial.chain(without_way_in).chain(nodes).copied().collect();
    for root in roots {
        search.visit(root);
    }
    let mut place = vec![0; graph.sizes.len()];
    let order: Vec<usize> = search.finished.into_iter().rev().collect();
    order.iter().enumerate().for_each(|(at, &node)| place[node] = at);
    let arc = |edge: usize| {
        let (source, target) = (graph.edges[edge].source, graph.edges[edge].target);
        let (from, to) = if place[source] < place[target] { (source, target) } else { (target, source) };
        Arc { edge, from, to }
    };
    Component { nodes: order, arcs: edges.into_iter().map(arc).collect(), loops }
}

/// Depth-first search without recursion. In the reverse of the order in which it finishes nodes, the only edges that
/// point backwards are those that it found to close a cycle.
struct Search {
    successors: Vec<Vec<usize>>,
    has_way_in: Vec<bool>,
    seen: Vec<bool>,
    finished: Vec<usize>,
}

impl Search {
    fn new(graph: &Graph, edges: &[usize]) -> Self {
        let count = graph.sizes.len();
        let (mut successors, mut has_way_in) = (vec![Vec::new(); count], vec![false; count]);
        for edge in edges.iter().map(|&edge| &graph.edges[edge]) {
            successors[edge.source].push(edge.target);
            has_way_in[edge.target] = true;
        }
        Self { successors, has_way_in, seen: vec![false; count], finished: Vec::new() }
    }

    fn visit(&mut self, root: usize) {
        if std::mem::replace(&mut self.seen[root], true) {
            return;
        }
        let mut stack = vec![(root, 0)];
        while let Some((node, next)) = stack.last_mut() {
            let Some(&successor) = self.successors[*node].get(*next) else {
                self.finished.push(*node);
                stack.pop();
                continue;
            };
            *next += 1;
            if !std::mem::replace(&mut self.seen[successor], true) {
                stack.push((successor, 0));
            }
        }
    }
}
