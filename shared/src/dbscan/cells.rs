//! Points sorted into cells of a grid, and which cells are near which.

use kiddo::{ImmutableKdTree, SquaredEuclidean};

use crate::points::Points;

/// Keeps two points of one cell within epsilon in spite of rounding.
const SHRINK: f64 = 1.0 - 1e-9;

/// The occupied cells of a grid whose cells have diagonals of epsilon.
pub(super) struct Cells {
    /// Length of a cell's sides.
    side: f64,
    /// All points, cell by cell.
    order: Vec<usize>,
    /// Where each cell starts in `order`, and the end.
    starts: Vec<usize>,
    /// Center of each cell.
    centers: Points,
    /// Smallest and largest coordinates of each cell's points.
    lowest: Points,
    highest: Points,
}

impl Cells {
    pub(super) fn new(points: &Points, epsilon: f64) -> Self {
        let side = epsilon / (points.dimension() as f64).sqrt() * SHRINK;
        let key: Vec<f64> = points.iter().flatten().map(|x| (x / side).floor()).collect();
        let keys = Points::from_rows(points.dimension(), key);
        let compare = |&a: &usize, &b: &usize| {
            let pairs = keys.point(a).iter().zip(keys.point(b));
            pairs.map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne()).unwrap_or(a.cmp(&b))
        };
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_unstable_by(compare);
        let mut starts = Vec::new();
        let mut centers = Points::new(points.dimension());
        for (at, &point) in order.iter().enumerate() {
            if at == 0 || keys.point(point) != keys.point(order[at - 1]) {
                starts.push(at);
                let center: Vec<f64> = keys.point(point).iter().map(|key| (key + 0.5) * side).collect();
                centers.push(&center);
            }
        }
        starts.push(order.len());
        let (mut lowest, mut highest) = (Points::new(points.dimension()), Points::new(points.dimension()));
        for ends in starts.windows(2) {
            let members = || order[ends[0]..ends[1]].iter().map(|&point| points.point(point));
            let extreme = |pick: fn(f64, f64) -> f64, start: f64| -> Vec<f64> {
                (0..points.dimension())
                    .map(|axis| members().map(|point| point[axis]).fold(start, pick))
                    .collect()
            };
            lowest.push(&extreme(f64::min, f64::INFINITY));
            highest.push(&extreme(f64::max, f64::NEG_INFINITY));
        }
        Self { side, order, starts, centers, lowest, highest }
    }

    /// Square of the distance from `point` to the box around the points of `cell`; zero inside.
    pub(super) fn squared_distance_to(&self, cell: usize, point: &[f64]) -> f64 {
        let sides = self.lowest.point(cell).iter().zip(self.highest.point(cell));
        let outside = |(x, (low, high)): (&f64, (&f64, &f64))| (low - x).max(x - high).max(0.0);
        point.iter().zip(sides).map(outside).map(|distance| distance * distance).sum()
    }

    /// How many cells there are.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The points in `cell`, ascending.
    pub(super) fn members(&self, cell: usize) -> &[usize] {
        &self.order[self.starts[cell]..self.starts[cell + 1]]
    }
}

/// Answers which cells can hold points within epsilon of a cell's points.
pub(super) struct Neighborhood<'a> {
    cells: &'a Cells,
    search: Search,
}

impl<'a> Neighborhood<'a> {
    pub(super) fn new(cells: &'a Cells) -> Self {
        Self { cells, search: search(&cells.centers) }
    }

    /// All cells that can hold a point within epsilon of a point in `cell`, itself included, ascending.
    pub(super) fn of(&self, cell: usize) -> Vec<usize> {
        // A point is at most half a diagonal (epsilon / 2) from its cell's center.
        let diagonal = self.cells.side / SHRINK * (self.cells.centers.dimension() as f64).sqrt();
        let reach = 2.0 * diagonal / SHRINK;
        let mut around = (self.search)(self.cells.centers.point(cell), reach);
        around.push(cell);
        around.sort_unstable();
        around.dedup();
        around
    }
}

/// Answers which points are within a distance of a point, by their indices in any order; more may be named.
type Search = Box<dyn Fn(&[f64], f64) -> Vec<usize>>;

/// The one place where the dimension becomes a constant. Coordinates beyond the eighth are left to the caller: what is
/// near in all coordinates is near in the first eight.
fn search(points: &Points) -> Search {
    match points.dimension() {
        _ if points.is_empty() => Box::new(|_, _| Vec::new()),
        1 => search_in::<1>(points),
        2 => search_in::<2>(points),
        3 => search_in::<3>(points),
        4 => search_in::<4>(points),
        _ => search_in::<8>(points),
    }
}

fn search_in<const K: usize>(points: &Points) -> Search {
    let rows: Vec<[f64; K]> = points.iter().map(first_coordinates).collect();
    match ImmutableKdTree::<f64, K>::new_from_slice(&rows) {
        Ok(tree) => Box::new(move |center, reach| {
            let query = first_coordinates(center);
            let within =
                tree.query(&query).within::<SquaredEuclidean<f64>>(reach * reach).unsorted().execute();
            within.into_iter().map(|found| found.item as usize).collect()
        }),
        // The tree refuses some degenerate inputs; then every point is named, which is slow but right.
        Err(_) => Box::new(move |_, _| (0..rows.len()).collect()),
    }
}

/// The first `K` coordinates, zeros where there are fewer, within what can be squared.
fn first_coordinates<const K: usize>(point: &[f64]) -> [f64; K] {
    const LARGEST: f64 = 1e150;
    std::array::from_fn(|axis| point.get(axis).map_or(0.0, |x| x.clamp(-LARGEST, LARGEST)))
}
