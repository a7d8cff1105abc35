//! Ranks: how far along the flow each node stands.

use ::layout::adt::dag::{DAG, NodeHandle};
use ::layout::topo::optimizer::RankOptimizer;

use super::acyclic::Component;

/// Up to how many nodes the ranks are optimized, which takes cubic time.
const MAX_OPTIMIZED: usize = 300;

/// The rank of every node of the component, in the order of its nodes; every arc leads to a higher rank, and no rank below
/// the highest is empty.
///
/// Longest paths from the nodes without a way in, by `layout-rs`; in small components it then moves such nodes on, close
/// to where they lead.
///
/// # Complexity
///
/// O(N + E) for N nodes and E arcs in components above 300 nodes, O(N² E) below.
pub(super) fn ranks(component: &Component) -> Vec<usize> {
    let count = component.nodes.len();
    let mut place = vec![0; component.nodes.iter().max().map_or(0, |last| last + 1)];
    component.nodes.iter().enumerate().for_each(|(at, &node)| place[node] = at);
    let mut dag = DAG::new();
    // Its own checks take exponential time on lattices; the arcs are known to be without cycles.
    dag.set_validate(false);
    dag.new_nodes(count);
    let mut pairs: Vec<(usize, usize)> =
        component.arcs.iter().map(|arc| (place[arc.from], place[arc.to])).collect();
    pairs.sort_unstable();
    pairs.dedup();
    for (from, to) in pairs {
        dag.add_edge(NodeHandle::new(from), NodeHandle::new(to));
    }
    dag.recompute_node_ranks();
    if count <= MAX_OPTIMIZED {
        RankOptimizer::new(&mut dag).optimize();
    }
    let mut ranks = vec![0; count];
    for (rank, row) in dag.ranks().iter().enumerate() {
        for node in row {
            ranks[node.get_index()] = rank;
        }
    }
    ranks
}
