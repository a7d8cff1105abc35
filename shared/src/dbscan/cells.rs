//! Points sorted into cells in which all are within epsilon of each other, and which cells are near which.

use std::ops::Range;

use super::DbscanParameters;
use super::bounds::{Bounds, around};
use super::grid::{Cursors, Grid};
use super::rows::{Rows, Space};
use super::tree::{NodeId, Parts, Trees};

/// More points than this in one cell have a tree; so many or fewer are compared one by one.
const HEAP: usize = 32;

/// So many points or fewer that are not within epsilon of each other are cells by themselves, where there is no grid.
const LOOSE: usize = 8;

/// The cells, each with at least one point, and a tree over the points of each that is a heap.
pub(super) struct Cells<S> {
    parameters: DbscanParameters,
    rows: Rows<S>,
    /// Where each cell starts in the rows, and the end.
    starts: Vec<u32>,
    index: Index<S>,
    heaps: Trees<S>,
    /// The tree of each cell, or [`NO_TREE`].
    roots: Vec<NodeId>,
}

const NO_TREE: NodeId = NodeId::MAX;

/// What tells which cells are near a cell.
enum Index<S> {
    Grid {
        grid: Grid,
        keys: Vec<u64>,
    },
    /// A tree whose leaves hold whole cells.
    Tree(Trees<S>),
}

/// Points that are looked at together.
#[derive(Clone)]
pub(super) enum Members {
    /// These rows.
    Few(Range<usize>),
    /// The rows of this tree.
    Heap(NodeId),
}

impl<S: Space> Cells<S> {
    /// Sorts the points with these `coordinates` into cells.
    pub(super) fn new(space: S, coordinates: &[f64], parameters: DbscanParameters) -> Self {
        let squared_epsilon = parameters.epsilon * parameters.epsilon;
        let grid = Grid::new(space, coordinates, parameters.epsilon).and_then(|grid| {
            let (rows, starts, keys) = grid.sort(space, coordinates, parameters.min_points);
            let is_tight = grid.is_tight() || are_tight(&rows, &starts, squared_epsilon);
            is_tight.then_some((rows, starts, Index::Grid { grid, keys }))
        });
        let (rows, starts, index) = grid.unwrap_or_else(|| in_tree(space, coordinates, squared_epsilon));
        let roots = vec![NO_TREE; starts.len() - 1];
        let mut cells = Self { parameters, rows, starts, index, heaps: Trees::new(space), roots };
        cells.plant_heaps();
        cells
    }

    /// Gives a tree to every heap that has a neighbor: nobody asks about the others.
    fn plant_heaps(&mut self) {
        let mut neighborhood = Neighborhood::new(self, 0);
        let heaps = (0..self.len()).filter(|&cell| self.range(cell).len() > HEAP);
        let asked: Vec<usize> = heaps
            .filter(|&cell| neighborhood.cells(cell).iter().map(ExactSizeIterator::len).sum::<usize>() > 1)
            .collect();
        for cell in asked {
            let range = self.range(cell);
            self.roots[cell] = self.heaps.plant(&mut self.rows, range, |count, _| count <= HEAP);
        }
    }

    /// How many cells there are.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The rows of a cell.
    #[inline]
    pub(super) fn range(&self, cell: usize) -> Range<usize> {
        self.starts[cell] as usize..self.starts[cell + 1] as usize
    }

    /// The points of a cell.
    #[inline]
    pub(super) fn members(&self, cell: usize) -> Members {
        match self.roots[cell] {
            NO_TREE => Members::Few(self.range(cell)),
            root => Members::Heap(root),
        }
    }

    /// The cell of a row.
    pub(super) fn cell_at(&self, row: usize) -> usize {
        self.starts.partition_point(|&start| start as usize <= row) - 1
    }

    /// Lets go of the points.
    pub(super) fn into_order(self) -> Order {
        Order { starts: self.starts, inputs: self.rows.into_inputs() }
    }

    pub(super) fn rows(&self) -> &Rows<S> {
        &self.rows
    }

    pub(super) fn heaps(&self) -> &Trees<S> {
        &self.heaps
    }

    pub(super) fn min_points(&self) -> usize {
        self.parameters.min_points
    }

    pub(super) fn squared_epsilon(&self) -> f64 {
        self.parameters.epsilon * self.parameters.epsilon
    }

    /// Whether all points of a cell are core points, as there are enough of them.
    pub(super) fn is_dense(&self, cell: usize) -> bool {
        self.range(cell).len() >= self.parameters.min_points
    }
}

/// What is left of cells when nobody asks any more where their points are.
pub(super) struct Order {
    /// Where each cell starts in the rows, and the end.
    pub(super) starts: Vec<u32>,
    /// Where each row was in the input.
    pub(super) inputs: Vec<u32>,
}

/// Whether the points of each cell are within epsilon of each other.
fn are_tight<S: Space>(rows: &Rows<S>, starts: &[u32], squared_epsilon: f64) -> bool {
    let mut bounds = Vec::new();
    starts.windows(2).filter(|ends| ends[1] - ends[0] > 1).all(|ends| {
        bounds.clear();
        around(rows.space().dimension(), rows.rows(ends[0] as usize..ends[1] as usize), &mut bounds);
        is_tight(&Bounds::new(rows.space().dimension(), &bounds), squared_epsilon)
    })
}

fn is_tight(bounds: &Bounds, squared_epsilon: f64) -> bool {
    bounds.farthest(bounds) <= squared_epsilon
}

/// Sorts points into cells by halving boxes until what is in them is within epsilon, or few.
fn in_tree<S: Space>(space: S, coordinates: &[f64], squared_epsilon: f64) -> (Rows<S>, Vec<u32>, Index<S>) {
    let count = coordinates.len() / space.dimension().max(1);
    let mut rows = Rows::with_capacity(space, count);
    rows.extend(coordinates, 0..count as u32);
    let mut tree = Trees::new(space);
    let mut starts = Vec::new();
    if count > 0 {
        tree.plant(&mut rows, 0..count, |count, bounds| count <= LOOSE || is_tight(bounds, squared_epsilon));
        for node in tree.nodes() {
            if let Parts::Leaf(range) = tree.parts(node) {
                let step = if is_tight(&tree.bounds(node), squared_epsilon) { range.len() } else { 1 };
                starts.extend(range.step_by(step).map(|start| start as u32));
            }
        }
    }
    starts.push(count as u32);
    (rows, starts, Index::Tree(tree))
}

/// Finds what is around one cell after the other, ascending.
pub(super) struct Neighborhood<'a, S> {
    cells: &'a Cells<S>,
    cursors: Option<Cursors<'a>>,
    found: Vec<Range<usize>>,
    members: Vec<Members>,
}

impl<'a, S: Space> Neighborhood<'a, S> {
    /// For asking about `cell` and those after it.
    pub(super) fn new(cells: &'a Cells<S>, cell: usize) -> Self {
        Self::of_rows(cells, cell, |_| true)
    }

    /// For asking which cells before it are around `cell`, and those after it; some may be named that are not before it.
    pub(super) fn before(cells: &'a Cells<S>, cell: usize) -> Self {
        Self::of_rows(cells, cell, |difference| difference <= 0)
    }

    fn of_rows(cells: &'a Cells<S>, cell: usize, is_wanted: fn(i64) -> bool) -> Self {
        let cursors = match &cells.index {
            Index::Grid { grid, keys } => Some(Cursors::new(grid, keys, cell, is_wanted)),
            Index::Tree(_) => None,
        };
        Self { cells, cursors, found: Vec::new(), members: Vec::new() }
    }

    /// Ranges of all cells that can hold a point within epsilon of one in `cell`, itself included.
    pub(super) fn cells(&mut self, cell: usize) -> &[Range<usize>] {
        self.found.clear();
        match (&mut self.cursors, &self.cells.index) {
            (Some(cursors), _) => cursors.around(cell, &mut self.found),
            (None, Index::Tree(tree)) => self.cells.around_in_tree(tree, cell, &mut self.found),
            (None, Index::Grid { .. }) => {}
        }
        &self.found
    }

    /// The points of those cells; cells side by side are told as one.
    pub(super) fn members(&mut self, cell: usize) -> &[Members] {
        self.cells(cell);
        self.members.clear();
        for range in &self.found {
            let mut few = self.cells.range(range.start).start;
            for heap in range.clone().filter(|&cell| self.cells.roots[cell] != NO_TREE) {
                let rows = self.cells.range(heap);
                self.members.extend([Members::Few(few..rows.start), Members::Heap(self.cells.roots[heap])]);
                few = rows.end;
            }
            self.members.push(Members::Few(few..self.cells.range(range.end - 1).end));
        }
        &self.members
    }
}

impl<S: Space> Cells<S> {
    fn around_in_tree(&self, tree: &Trees<S>, cell: usize, found: &mut Vec<Range<usize>>) {
        let dimension = self.rows.space().dimension();
        let mut bounds = Vec::new();
        around(dimension, self.rows.rows(self.range(cell)), &mut bounds);
        let bounds = Bounds::new(dimension, &bounds);
        let mut waiting = vec![0];
        while let Some(node) = waiting.pop() {
            if tree.bounds(node).nearest(&bounds) <= self.squared_epsilon() {
                match tree.parts(node) {
                    Parts::Leaf(range) => {
                        found.push(self.cell_at(range.start)..self.cell_at(range.end - 1) + 1);
                    }
                    Parts::Both(first, second) => waiting.extend([second, first]),
                }
            }
        }
    }
}
