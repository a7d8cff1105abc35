//! A grid whose cells have diagonals of epsilon, for up to four dimensions.

use std::ops::Range;

use super::rows::{Rows, Space};
use super::strays::without_strays;

/// Beyond this there are more rows of cells around a cell than a tree has nodes on the way.
const MOST_DIMENSIONS: usize = 4;

/// Keeps two points of one cell within epsilon in spite of rounding.
const SHRINK: f64 = 1.0 - 1e-9;

/// How much rounding can add to a distance, in cells, with as many cells on an axis as there may be.
const ROUNDING: f64 = 1e-4;
const MOST_CELLS_OF_AXIS: f64 = (1_u64 << 32) as f64;

/// With so many cells on an axis rounding adds less than half of what [`SHRINK`] takes away, if squares of epsilon are not
/// among the numbers that have fewer digits.
const FEW_CELLS_OF_AXIS: f64 = (1_u64 << 20) as f64;
const LEAST_SQUARED_EPSILON: f64 = 1e-290;

/// How a grid lies over the points, and how its cells are numbered.
///
/// The number of a cell, its key, is that of each axis in bits of their own, the last axis lowest. Around the grid there
/// is room for the reach on every side, so that the key of a neighbor is the key and a difference.
pub(super) struct Grid {
    origin: Vec<f64>,
    /// Cells per unit.
    fineness: f64,
    shifts: Vec<u32>,
    /// How many cells away on an axis a point within epsilon can be.
    reach: u64,
    /// Whether points of one cell are within epsilon whatever is rounded.
    is_tight: bool,
    /// Differences between the key of a cell and those in the middle of the rows of cells around it, the nearest first.
    differences: Vec<i64>,
}

/// Some points of the input in one cell, one after the other.
pub(super) struct Run {
    pub(super) key: u64,
    start: u32,
    end: u32,
}

impl Run {
    /// How many points there are.
    pub(super) fn len(&self) -> usize {
        (self.end - self.start) as usize
    }
}

impl Grid {
    /// The grid over points with `coordinates`; none where it has too many dimensions or cells.
    pub(super) fn new(space: impl Space, coordinates: &[f64], epsilon: f64) -> Option<Self> {
        let dimension = space.dimension();
        if dimension > MOST_DIMENSIONS || coordinates.is_empty() {
            return None;
        }
        let diagonal = (dimension as f64).sqrt();
        let side = epsilon / diagonal * SHRINK;
        let fineness = 1.0 / side;
        let reach = (diagonal / SHRINK + ROUNDING).floor() + 1.0;
        let mut bounds = Vec::new();
        super::bounds::around(dimension, coordinates.chunks_exact(dimension), &mut bounds);
        let (low, high) = bounds.split_at(dimension);
        let mut shifts = vec![0; dimension];
        let mut bits = 0;
        let mut is_tight = epsilon * epsilon >= LEAST_SQUARED_EPSILON;
        for axis in (0..dimension).rev() {
            let cells = (high[axis] - low[axis]) * fineness;
            // Not the other way round: what cannot be calculated is refused.
            if !(cells < MOST_CELLS_OF_AXIS && fineness.is_finite()) {
                return None;
            }
            is_tight &= cells <= FEW_CELLS_OF_AXIS;
            shifts[axis] = bits;
            bits += (cells as u64 + 1 + 2 * reach as u64).ilog2() + 1;
        }
        let differences = differences(&shifts, reach as i64, diagonal + ROUNDING);
        let origin = low.to_vec();
        (bits < 63).then_some(Self { origin, fineness, shifts, reach: reach as u64, is_tight, differences })
    }

    /// Whether points of one cell are within epsilon of each other whatever is rounded; elsewhere one has to look.
    pub(super) fn is_tight(&self) -> bool {
        self.is_tight
    }

    fn key(&self, point: &[f64]) -> u64 {
        let axes = point.iter().zip(&self.origin).zip(&self.shifts);
        let parts =
            axes.map(|((x, origin), shift)| (((x - origin) * self.fineness) as u64 + self.reach) << shift);
        parts.sum()
    }

    /// Sorts the points but for strays into cells: the rows cell by cell, where each cell starts and the end, and the key
    /// of each.
    ///
    /// What rests stays in its cell for many frames, so runs of points are sorted, not points.
    ///
    /// # Complexity
    ///
    /// O(n + r log r) for n points in r runs.
    pub(super) fn sort<S: Space>(
        &self,
        space: S,
        coordinates: &[f64],
        min_points: usize,
    ) -> (Rows<S>, Vec<u32>, Vec<u64>) {
        let mut runs = self.runs(space, coordinates);
        runs.sort_unstable_by_key(|run| (run.key, run.start));
        let runs = without_strays(self, runs, min_points);
        let mut rows = Rows::with_capacity(space, runs.iter().map(Run::len).sum());
        let (mut starts, mut keys) = (Vec::new(), Vec::new());
        for run in runs {
            if keys.last() != Some(&run.key) {
                keys.push(run.key);
                starts.push(rows.len() as u32);
            }
            rows.extend(coordinates, run.start..run.end);
        }
        starts.push(rows.len() as u32);
        (rows, starts, keys)
    }

    fn runs<S: Space>(&self, space: S, coordinates: &[f64]) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for (at, point) in coordinates.chunks_exact(space.dimension()).enumerate() {
            let key = self.key(point);
            match runs.last_mut() {
                Some(run) if run.key == key => run.end += 1,
                _ => runs.push(Run { key, start: at as u32, end: at as u32 + 1 }),
            }
        }
        runs.shrink_to_fit();
        runs
    }
}

/// The differences in key to the rows of cells around a cell: the axes but the last up to `reach` cells away, as far as
/// the row comes within `diagonal` cells.
fn differences(shifts: &[u32], reach: i64, diagonal: f64) -> Vec<i64> {
    let mut rows = vec![(0.0, 0)];
    for &shift in &shifts[..shifts.len() - 1] {
        let steps = |(squared, difference): (f64, i64)| {
            (-reach..=reach).map(move |step| {
                let gap = (step.abs() - 1).max(0) as f64;
                (squared + gap * gap, difference + (step << shift))
            })
        };
        rows = rows.into_iter().flat_map(steps).filter(|row| row.0 <= diagonal * diagonal).collect();
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.abs().cmp(&b.1.abs())));
    rows.into_iter().map(|row| row.1).collect()
}

/// Finds the cells around one cell after the other.
pub(super) struct Cursors<'a> {
    keys: &'a [u64],
    reach: u64,
    rows: Vec<Row>,
}

/// The cells of one row that can be near the present cell: those from `first` to before `end`.
struct Row {
    difference: i64,
    first: usize,
    end: usize,
}

impl<'a> Cursors<'a> {
    /// For asking about `cell` and those after it, ascending; of what is around them only what `is_wanted`, by the
    /// difference of its row.
    pub(super) fn new(grid: &Grid, keys: &'a [u64], cell: usize, is_wanted: impl Fn(i64) -> bool) -> Self {
        let row = |&difference: &i64| {
            let low = keys.get(cell).map_or(0, |key| key.wrapping_add_signed(difference) - grid.reach);
            let first = keys.partition_point(|&key| key < low);
            Row { difference, first, end: first }
        };
        let wanted = grid.differences.iter().filter(|difference| is_wanted(**difference));
        Self { keys, reach: grid.reach, rows: wanted.map(row).collect() }
    }

    /// Ranges of all cells in wanted rows that can hold a point within epsilon of one in `cell`, itself included, the
    /// nearest first.
    ///
    /// # Complexity
    ///
    /// O(cells) for all cells together, times the number of rows of cells around one, which depends on the dimension.
    pub(super) fn around(&mut self, cell: usize, found: &mut Vec<Range<usize>>) {
        let Self { keys, reach, rows } = self;
        let key = keys[cell];
        for Row { difference, first, end } in rows {
            let middle = key.wrapping_add_signed(*difference);
            while *end < keys.len() && keys[*end] <= middle + *reach {
                *end += 1;
            }
            while *first < *end && keys[*first] < middle - *reach {
                *first += 1;
            }
            if *first < *end {
                found.push(*first..*end);
            }
        }
    }
}
