//! Order within the rows, so that few edges cross.

use ::layout::adt::dag::{DAG, NodeHandle};
use ::layout::topo::optimizer::EdgeCrossOptimizer;

use super::layers::{Layers, Vertex};

/// Up to how many vertices the order of `layout-rs` is tried too, which takes cubic time.
const MAX_OPTIMIZED: usize = 120;

/// How many sweeps there are at most, and how many without a better order.
const MAX_SWEEPS: usize = 40;
const MAX_IDLE_SWEEPS: usize = 8;

/// Up to how many edges neighbors are swapped; above, the sweeps must do.
const MAX_SWAPPED_EDGES: usize = 4_000;

/// Puts the rows of `layers` into an order with few crossings.
///
/// Barycenter sweeps (Sugiyama et al. 1981) and swaps of neighbors (Gansner et al. 1993) from the given order and, in
/// small graphs, from that of `layout-rs`; the order with the fewest crossings is kept, the earlier one of equals.
///
/// # Complexity
///
/// O(E log E) a sweep for E edges, bends included.
pub(super) fn order(layers: &mut Layers) {
    let given = layers.rows.clone();
    let mut best = improved(layers, given.clone());
    if best.0 > 0 && layers.vertices.len() <= MAX_OPTIMIZED {
        let other = improved(layers, optimized(layers, given));
        if other.0 < best.0 {
            best = other;
        }
    }
    layers.rows = best.1;
    turn_upright(layers);
}

/// Turns all rows around when that brings more nodes into the order of the request.
fn turn_upright(layers: &mut Layers) {
    let turned = |pair: &[usize]| match (layers.vertices[pair[0]], layers.vertices[pair[1]]) {
        (Vertex::Node(first), Vertex::Node(second)) => {
            if first > second {
                1
            } else {
                -1
            }
        }
        _ => 0,
    };
    let balance: i64 = layers.rows.iter().flat_map(|row| row.windows(2)).map(turned).sum();
    if balance > 0 {
        for row in &mut layers.rows {
            row.reverse();
        }
    }
}

/// The order that `layout-rs` finds.
fn optimized(layers: &Layers, rows: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    let mut dag = DAG::new();
    dag.set_validate(false);
    dag.new_nodes(layers.vertices.len());
    for (vertex, after) in layers.after.iter().enumerate() {
        let mut after = after.clone();
        after.sort_unstable();
        after.dedup();
        for next in after {
            dag.add_edge(NodeHandle::new(vertex), NodeHandle::new(next));
        }
    }
    *dag.ranks_mut() = rows.into_iter().map(|row| row.into_iter().map(NodeHandle::new).collect()).collect();
    EdgeCrossOptimizer::new(&mut dag).optimize();
    dag.ranks().iter().map(|row| row.iter().map(NodeHandle::get_index).collect()).collect()
}

/// Number of crossings and rows after sweeps and swaps.
fn improved(layers: &Layers, rows: Vec<Vec<usize>>) -> (u64, Vec<Vec<usize>>) {
    let mut sorter = Sorter::new(layers, rows);
    let mut best = (sorter.crossings(), sorter.rows.clone());
    let mut idle = 0;
    for sweep in 0..MAX_SWEEPS {
        if best.0 == 0 || idle == MAX_IDLE_SWEEPS {
            break;
        }
        sorter.sweep(sweep % 2 == 0, sweep % 4 >= 2);
        sorter.swap_neighbors();
        let crossings = sorter.crossings();
        idle += 1;
        if crossings < best.0 {
            best = (crossings, sorter.rows.clone());
            idle = 0;
        }
    }
    best
}

struct Sorter<'a> {
    layers: &'a Layers,
    rows: Vec<Vec<usize>>,
    /// Where each vertex stands in its row.
    place: Vec<usize>,
    edges: usize,
}

impl<'a> Sorter<'a> {
    fn new(layers: &'a Layers, rows: Vec<Vec<usize>>) -> Self {
        let edges = layers.after.iter().map(Vec::len).sum();
        let mut sorter = Self { layers, rows, place: vec![0; layers.vertices.len()], edges };
        (0..sorter.rows.len()).for_each(|rank| sorter.note_places(rank));
        sorter
    }

    fn note_places(&mut self, rank: usize) {
        for (place, &vertex) in self.rows[rank].iter().enumerate() {
            self.place[vertex] = place;
        }
    }

    /// Sorts every row by the mean place of its vertices' neighbors in the row before (or after, when not `forward`); equal
    /// means keep their order, or turn it around when `flip`.
    fn sweep(&mut self, forward: bool, flip: bool) {
        let count = self.rows.len();
        for step in 1..count {
            let rank = if forward { step } else { count - 1 - step };
            let mut row = std::mem::take(&mut self.rows[rank]);
            if flip {
                row.reverse();
            }
            let neighbors = if forward { &self.layers.before } else { &self.layers.after };
            let mut keyed: Vec<(f64, usize)> =
                row.iter().map(|&vertex| (self.mean_place(vertex, &neighbors[vertex]), vertex)).collect();
            keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
            self.rows[rank] = keyed.into_iter().map(|(_, vertex)| vertex).collect();
            self.note_places(rank);
        }
    }

    fn mean_place(&self, vertex: usize, neighbors: &[usize]) -> f64 {
        if neighbors.is_empty() {
            return self.place[vertex] as f64;
        }
        let sum: usize = neighbors.iter().map(|&neighbor| self.place[neighbor]).sum();
        sum as f64 / neighbors.len() as f64
    }

    /// Swaps neighbors in a row as long as that takes crossings away.
    fn swap_neighbors(&mut self) {
        if self.edges > MAX_SWAPPED_EDGES {
            return;
        }
        for _ in 0..MAX_SWEEPS {
            let mut swapped = false;
            for rank in 0..self.rows.len() {
                for left in 1..self.rows[rank].len() {
                    swapped |= self.swap_if_better(rank, left - 1);
                }
            }
            if !swapped {
                return;
            }
        }
    }

    fn swap_if_better(&mut self, rank: usize, left: usize) -> bool {
        let (a, b) = (self.rows[rank][left], self.rows[rank][left + 1]);
        let sides = [&self.layers.before, &self.layers.after];
        let now: usize = sides.iter().map(|side| self.crossings_of(&side[a], &side[b])).sum();
        let then: usize = sides.iter().map(|side| self.crossings_of(&side[b], &side[a])).sum();
        if then >= now {
            return false;
        }
        self.rows[rank].swap(left, left + 1);
        (self.place[a], self.place[b]) = (left + 1, left);
        true
    }

    /// Crossings between the edges to `left` of one vertex and those to `right` of the vertex after it.
    fn crossings_of(&self, left: &[usize], right: &[usize]) -> usize {
        let crosses = |l: &usize| right.iter().filter(|r| self.place[**r] < self.place[*l]).count();
        left.iter().map(crosses).sum()
    }

    /// All crossings between neighboring rows, by Barth, Jünger and Mutzel (2002).
    fn crossings(&self) -> u64 {
        let between = |rank: usize| {
            let mut counts = Counts::new(self.rows[rank + 1].len());
            let mut sum = 0;
            for vertex in &self.rows[rank] {
                let mut ends: Vec<usize> =
                    self.layers.after[*vertex].iter().map(|&end| self.place[end]).collect();
                ends.sort_unstable();
                sum += ends.iter().map(|&end| counts.above(end)).sum::<u64>();
                for end in ends {
                    counts.add(end);
                }
            }
            sum
        };
        (0..self.rows.len().saturating_sub(1)).map(between).sum()
    }
}

/// How many edges end at which place: a binary indexed tree (Fenwick 1994).
struct Counts {
    tree: Vec<u64>,
    total: u64,
}

impl Counts {
    fn new(places: usize) -> Self {
        Self { tree: vec![0; places + 1], total: 0 }
    }

    fn add(&mut self, place: usize) {
        self.total += 1;
        let mut at = place + 1;
        while at < self.tree.len() {
            self.tree[at] += 1;
            at += at & at.wrapping_neg();
        }
    }

    /// How many ends are at a place above `place`.
    fn above(&self, place: usize) -> u64 {
        let (mut at, mut up_to) = (place + 1, 0);
        while at > 0 {
            up_to += self.tree[at];
            at -= at & at.wrapping_neg();
        }
        self.total - up_to
    }
}
