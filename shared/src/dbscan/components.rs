//! Cells that are joined, by any number of threads at once.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Disjoint sets of cells. The number of a set is its smallest cell, whatever the order in which cells were joined.
///
/// A cell points to a smaller one of its set or, where it is the smallest, to itself. Only the smallest is ever pointed
/// elsewhere by a join, and only while it is the smallest, so no join is lost (Anderson and Woll 1991).
pub(super) struct Components(Vec<AtomicU32>);

impl Components {
    /// Each cell by itself.
    pub(super) fn new(cells: usize) -> Self {
        Self((0..cells as u32).map(AtomicU32::new).collect())
    }

    /// The number of the set that `cell` is in.
    pub(super) fn find(&self, cell: usize) -> usize {
        let mut cell = cell as u32;
        loop {
            let parent = self.0[cell as usize].load(Relaxed);
            if parent == cell {
                return cell as usize;
            }
            let grandparent = self.0[parent as usize].load(Relaxed);
            if grandparent != parent {
                // Only a shorter way; who comes second has a way that is as good.
                let _ = self.0[cell as usize].compare_exchange_weak(parent, grandparent, Relaxed, Relaxed);
            }
            cell = parent;
        }
    }

    /// Joins the sets of two cells.
    pub(super) fn join(&self, a: usize, b: usize) {
        loop {
            let (a, b) = (self.find(a), self.find(b));
            if a == b {
                return;
            }
            let (small, large) = (a.min(b) as u32, a.max(b) as u32);
            if self.0[large as usize].compare_exchange(large, small, Relaxed, Relaxed).is_ok() {
                return;
            }
        }
    }
}
