//! Boxes that are found by where they are, in an even grid of cells without allocations of their own.

use crate::layout::Rect;

/// How many cells there are at most about.
const MAX_CELLS: f64 = 65_536.0;

const NONE: u32 = u32::MAX;

/// Boxes with owners. What lies outside of the bounds counts for the cells at the border, so nothing is ever missed.
#[derive(Debug)]
pub(super) struct Field {
    bounds: Rect,
    cell: f64,
    columns: usize,
    rows: usize,
    /// For every cell its newest link.
    newest: Vec<u32>,
    /// (older link of the same cell, item).
    links: Vec<(u32, u32)>,
    items: Vec<(usize, Rect)>,
}

impl Field {
    /// A field without boxes, in cells with sides of `least_cell` or more.
    pub(super) fn new(bounds: Rect, least_cell: f64) -> Self {
        let (width, height) = ((bounds.right - bounds.left).max(1.0), (bounds.bottom - bounds.top).max(1.0));
        let cell = least_cell.max((width * height / MAX_CELLS).sqrt()).max(width.max(height) / MAX_CELLS);
        let (columns, rows) = ((width / cell) as usize + 1, (height / cell) as usize + 1);
        let newest = vec![NONE; columns * rows];
        Self { bounds, cell, columns, rows, newest, links: Vec::new(), items: Vec::new() }
    }

    /// Adds a box of `owner`; the result is what [`Field::remove`] takes.
    pub(super) fn add(&mut self, owner: usize, rect: Rect) -> usize {
        let item = self.items.len();
        self.items.push((owner, rect));
        let ([left, top], [right, bottom]) = self.cells(&rect);
        for row in top..=bottom {
            for cell in row * self.columns + left..=row * self.columns + right {
                self.links.push((self.newest[cell], item as u32));
                self.newest[cell] = self.links.len() as u32 - 1;
            }
        }
        item
    }

    /// Takes away what was added as `item`.
    pub(super) fn remove(&mut self, item: usize) {
        if let Some((_, rect)) = self.items.get_mut(item) {
            // Nothing touches a box that is inside out.
            let far = f64::INFINITY;
            *rect = Rect { left: far, top: far, right: -far, bottom: -far };
        }
    }

    /// Shows `see` every box that touches `rect`, once, with its owner.
    pub(super) fn visit(&self, rect: &Rect, mut see: impl FnMut(usize, &Rect)) {
        let ([left, top], [right, bottom]) = self.cells(rect);
        for row in top..=bottom {
            for column in left..=right {
                let mut link = self.newest[row * self.columns + column];
                while let Some(&(older, item)) = self.links.get(link as usize) {
                    link = older;
                    let (owner, other) = &self.items[item as usize];
                    if touches(other, rect) {
                        let [first_column, first_row] = self.cell_of(other.left, other.top);
                        if column == left.max(first_column) && row == top.max(first_row) {
                            see(*owner, other);
                        }
                    }
                }
            }
        }
    }

    fn cells(&self, rect: &Rect) -> ([usize; 2], [usize; 2]) {
        (self.cell_of(rect.left, rect.top), self.cell_of(rect.right, rect.bottom))
    }

    fn cell_of(&self, x: f64, y: f64) -> [usize; 2] {
        let cell = |value: f64, first: f64, count: usize| {
            (((value - first) / self.cell).max(0.0) as usize).min(count - 1)
        };
        [cell(x, self.bounds.left, self.columns), cell(y, self.bounds.top, self.rows)]
    }
}

fn touches(a: &Rect, b: &Rect) -> bool {
    a.left <= b.right && b.left <= a.right && a.top <= b.bottom && b.top <= a.bottom
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::layout::Point;

    fn rects(count: usize) -> impl Strategy<Value = Vec<Rect>> {
        let rect = (-900.0..900.0, -900.0..900.0, 0.0..300.0, 0.0..300.0);
        let rect = rect.prop_map(|(x, y, width, height)| Rect::centered(Point::new(x, y), width, height));
        proptest::collection::vec(rect, 0..count)
    }

    proptest! {
        #[test]
        fn every_box_that_touches_is_seen_once(all in rects(40), asked in rects(6), gone in 0_usize..40) {
            let mut field = Field::new(Rect { left: -300.0, top: -200.0, right: 400.0, bottom: 300.0 }, 64.0);
            for (owner, rect) in all.iter().enumerate() {
                prop_assert_eq!(field.add(owner, *rect), owner);
            }
            field.remove(gone);
            for rect in &asked {
                let mut seen = Vec::new();
                field.visit(rect, |owner, _| seen.push(owner));
                seen.sort_unstable();
                let expected: Vec<usize> =
                    (0..all.len()).filter(|&at| at != gone && touches(&all[at], rect)).collect();
                prop_assert_eq!(seen, expected);
            }
        }
    }
}
