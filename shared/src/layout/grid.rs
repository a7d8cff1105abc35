//! Boxes that are found by where they are.

use std::collections::BTreeMap;

use super::geometry::Rect;

/// Side of a cell.
const CELL: f64 = 96.0;

/// Boxes in square cells.
#[derive(Debug, Default)]
pub(super) struct Grid {
    cells: BTreeMap<(i64, i64), Vec<(usize, Rect)>>,
}

impl Grid {
    /// Adds the box that is called `id`.
    pub(super) fn add(&mut self, id: usize, rect: Rect) {
        for cell in cells(&rect) {
            self.cells.entry(cell).or_default().push((id, rect));
        }
    }

    /// Removes the box that was added as `id` with the same `rect`.
    pub(super) fn remove(&mut self, id: usize, rect: &Rect) {
        for cell in cells(rect) {
            if let Some(members) = self.cells.get_mut(&cell) {
                members.retain(|member| member.0 != id);
            }
        }
    }

    /// Area of `rect` that boxes other than `id` cover, a box counted once for each cell that it shares with `rect`.
    pub(super) fn overlap(&self, id: usize, rect: &Rect) -> f64 {
        let members = cells(rect).filter_map(|cell| self.cells.get(&cell)).flatten();
        members.filter(|member| member.0 != id).map(|member| member.1.overlap(rect)).sum()
    }
}

fn cells(rect: &Rect) -> impl Iterator<Item = (i64, i64)> + use<> {
    let cell = |x: f64| (x / CELL).floor() as i64;
    let (left, right) = (cell(rect.left), cell(rect.right));
    let rows = cell(rect.top)..=cell(rect.bottom);
    rows.flat_map(move |row| (left..=right).map(move |column| (column, row)))
}
