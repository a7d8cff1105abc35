//! Long edges are made level where there is room.

use super::extents::Extent;
use super::layers::Layers;

/// Moves the bends of each edge to one level, in runs as long as their neighbors in the rows leave room for.
///
/// # Complexity
///
/// O(V) for V vertices.
pub(super) fn straighten(layers: &Layers, extents: &[Extent], across: &mut [f64]) {
    let mut place = vec![0; layers.vertices.len()];
    for row in &layers.rows {
        row.iter().enumerate().for_each(|(at, &vertex)| place[vertex] = at);
    }
    for chain in layers.chains.iter().filter(|chain| chain.vertices.len() > 3) {
        let mut run = Run::default();
        for &bend in &chain.vertices[1..chain.vertices.len() - 1] {
            let room = room(layers, extents, across, bend, place[bend]);
            if !run.fits(room) {
                std::mem::take(&mut run).level(across);
            }
            run.add(bend, room);
        }
        run.level(across);
    }
}

/// Between which levels a vertex can move without coming too close to its neighbors in the row.
fn room(layers: &Layers, extents: &[Extent], across: &[f64], vertex: usize, place: usize) -> (f64, f64) {
    let row = &layers.rows[layers.ranks[vertex]];
    let before = place.checked_sub(1).map(|before| row[before]);
    let first = before.map_or(f64::NEG_INFINITY, |v| across[v] + extents[v].down + extents[vertex].up);
    let after = row.get(place + 1);
    let last = after.map_or(f64::INFINITY, |&v| across[v] - extents[v].up - extents[vertex].down);
    // Rounding may leave no room at all; then it stays.
    (first.min(across[vertex]), last.max(across[vertex]))
}

/// Bends one after the other that can all be at one level.
struct Run {
    bends: Vec<usize>,
    first: f64,
    last: f64,
}

impl Default for Run {
    fn default() -> Self {
        Self { bends: Vec::new(), first: f64::NEG_INFINITY, last: f64::INFINITY }
    }
}

impl Run {
    fn fits(&self, (first, last): (f64, f64)) -> bool {
        self.first.max(first) <= self.last.min(last)
    }

    fn add(&mut self, bend: usize, (first, last): (f64, f64)) {
        self.bends.push(bend);
        self.first = self.first.max(first);
        self.last = self.last.min(last);
    }

    fn level(self, across: &mut [f64]) {
        let sum: f64 = self.bends.iter().map(|&bend| across[bend]).sum();
        let level = (sum / self.bends.len().max(1) as f64).max(self.first).min(self.last);
        for bend in self.bends {
            across[bend] = level;
        }
    }
}
