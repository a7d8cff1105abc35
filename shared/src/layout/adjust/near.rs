//! Where anything matters: the cells that edges which are routed anew may come near to.

use crate::layout::{Point, Rect};

/// Side of a cell at least, and how many there are at most about.
const LEAST_CELL: f64 = 64.0;
const MAX_CELLS: f64 = 65_536.0;

/// A mask over a part of the drawing.
#[derive(Debug)]
pub(super) struct Near {
    bounds: Rect,
    cell: f64,
    columns: usize,
    rows: usize,
    marks: Vec<bool>,
}

impl Near {
    /// Nothing of `bounds` matters yet.
    pub(super) fn new(bounds: Rect) -> Self {
        let (width, height) = (bounds.right - bounds.left, bounds.bottom - bounds.top);
        let cell = LEAST_CELL.max((width * height / MAX_CELLS).sqrt()).max(width.max(height) / MAX_CELLS);
        let (columns, rows) = ((width / cell) as usize + 1, (height / cell) as usize + 1);
        Self { bounds, cell, columns, rows, marks: vec![false; columns * rows] }
    }

    /// Marks all within `reach` of the line from `a` to `b`.
    pub(super) fn mark(&mut self, a: Point, b: Point, reach: f64) {
        let (x, y) = (b.x - a.x, b.y - a.y);
        let steps = ((x.abs() + y.abs()) / reach).ceil().max(1.0);
        for step in 0..=steps as usize {
            let share = step as f64 / steps;
            let at = Point::new(a.x + x * share, a.y + y * share);
            let around = Rect::centered(at, 2.0 * reach, 2.0 * reach);
            let (first, last) = (self.cell(around.left, around.top), self.cell(around.right, around.bottom));
            for row in first[1]..=last[1] {
                self.marks[row * self.columns + first[0]..=row * self.columns + last[0]].fill(true);
            }
        }
    }

    /// Whether the point matters.
    pub(super) fn contains(&self, point: Point) -> bool {
        let [column, row] = self.cell(point.x, point.y);
        self.marks[row * self.columns + column]
    }

    fn cell(&self, x: f64, y: f64) -> [usize; 2] {
        let cell = |value: f64, first: f64, count: usize| {
            (((value - first) / self.cell).max(0.0) as usize).min(count - 1)
        };
        [cell(x, self.bounds.left, self.columns), cell(y, self.bounds.top, self.rows)]
    }
}
