//! Density-based clustering (DBSCAN).

mod cells;

use crate::points::{Points, squared_distance};
use cells::{Cells, Neighborhood};

/// What counts as dense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DbscanParameters {
    /// Radius of a point's neighborhood, above zero, in the unit of the points; its rim counts as inside.
    pub epsilon: f64,
    /// How many points, itself included, the neighborhood of a core point has; at least one.
    pub min_points: usize,
}

/// For each point the number of its cluster from 0, or `None` for noise. Clusters are numbered in the order of their
/// first points.
pub type Labels = Vec<Option<usize>>;

/// Clusters `points` by density: Ester, Kriegel, Sander and Xu, *A Density-Based Algorithm for Discovering Clusters in
/// Large Spatial Databases with Noise*, 1996.
///
/// A point with at least `min_points` points within `epsilon` is a core point; core points within `epsilon` of each other
/// are in one cluster; a border point (not core, but within `epsilon` of one) goes to its nearest core point's cluster,
/// ties to the earlier core point; the rest is noise.
///
/// Exact. Points are sorted into cells whose diagonal is `epsilon`, after Gunawan, *A Faster Algorithm for DBSCAN*, 2013:
/// a cell of `min_points` points is all core without a distance, and two cells are joined by the first pair of core
/// points that is near enough.
///
/// # Complexity
///
/// Memory O(n). Time O(n log n) where points lie in heaps, O(n²) at worst.
///
/// # Example
///
/// ```
/// use goalgraph::dbscan::{DbscanParameters, dbscan};
/// use goalgraph::points::Points;
///
/// let points = Points::from_rows(1, vec![0.0, 0.1, 0.2, 9.0]);
/// let labels = dbscan(&points, DbscanParameters { epsilon: 0.15, min_points: 2 });
/// assert_eq!(labels, [Some(0), Some(0), Some(0), None]);
/// ```
pub fn dbscan(points: &Points, parameters: DbscanParameters) -> Labels {
    let cells = Cells::new(points, parameters.epsilon);
    let neighborhood = Neighborhood::new(&cells);
    let near = Near { points, squared_epsilon: parameters.epsilon * parameters.epsilon };
    let core = core_points(&cells, &neighborhood, &near, parameters.min_points);
    let cluster_of_cell = join_cells(&cells, &neighborhood, &near, &core);
    number_clusters(&cluster_of_point(&cells, &neighborhood, &near, &core, &cluster_of_cell))
}

/// The question whether two points are within epsilon.
struct Near<'a> {
    points: &'a Points,
    squared_epsilon: f64,
}

impl Near<'_> {
    fn squared(&self, a: usize, b: usize) -> f64 {
        squared_distance(self.points.point(a), self.points.point(b))
    }

    fn holds(&self, a: usize, b: usize) -> bool {
        self.squared(a, b) <= self.squared_epsilon
    }

    /// Whether the box around the points of `cell` is within epsilon of `point`: if not, none of them is.
    fn reaches(&self, cells: &Cells, point: usize, cell: usize) -> bool {
        cells.squared_distance_to(cell, self.points.point(point)) <= self.squared_epsilon
    }

    /// Those of the cells `around` that can hold a neighbor of `point`.
    fn cells(&self, cells: &Cells, point: usize, around: &[usize]) -> impl Iterator<Item = usize> {
        around.iter().copied().filter(move |&cell| self.reaches(cells, point, cell))
    }
}

/// Whether each point is core.
fn core_points(cells: &Cells, neighborhood: &Neighborhood, near: &Near, min_points: usize) -> Vec<bool> {
    let mut core = vec![false; near.points.len()];
    for cell in 0..cells.len() {
        let members = cells.members(cell);
        if members.len() >= min_points {
            for &point in members {
                core[point] = true;
            }
            continue;
        }
        let around = neighborhood.of(cell);
        for &point in members {
            let candidates = near.cells(cells, point, &around).flat_map(|other| cells.members(other));
            let neighbors = candidates.filter(|&&other| near.holds(point, other)).take(min_points);
            core[point] = neighbors.count() >= min_points;
        }
    }
    core
}

/// The cluster of each cell with core points, as the smallest cell that it is joined to.
fn join_cells(cells: &Cells, neighborhood: &Neighborhood, near: &Near, core: &[bool]) -> Vec<usize> {
    let core_members: Vec<Vec<usize>> = (0..cells.len())
        .map(|cell| cells.members(cell).iter().copied().filter(|&point| core[point]).collect())
        .collect();
    let mut joined = petgraph::unionfind::UnionFind::new(cells.len());
    for cell in 0..cells.len() {
        if core_members[cell].is_empty() {
            continue;
        }
        for other in neighborhood.of(cell) {
            if other < cell
                && !joined.equiv(cell, other)
                && touch(near, cells, &core_members[cell], other, &core_members[other])
            {
                joined.union(cell, other);
            }
        }
    }
    joined.into_labeling()
}

/// Whether a point of `a` is within epsilon of a point of `b`, which are in the cell `cell_of_b`.
fn touch(near: &Near, cells: &Cells, a: &[usize], cell_of_b: usize, b: &[usize]) -> bool {
    let close = a.iter().filter(|&&point| near.reaches(cells, point, cell_of_b));
    close.into_iter().any(|&point| b.iter().any(|&other| near.holds(point, other)))
}

/// The cluster of each point as some number: core points have their cell's, border points their nearest core point's.
fn cluster_of_point(
    cells: &Cells,
    neighborhood: &Neighborhood,
    near: &Near,
    core: &[bool],
    cluster_of_cell: &[usize],
) -> Labels {
    let mut labels = vec![None; core.len()];
    for cell in 0..cells.len() {
        let members = cells.members(cell);
        if members.iter().all(|&point| core[point]) {
            for &point in members {
                labels[point] = Some(cluster_of_cell[cell]);
            }
            continue;
        }
        let around = neighborhood.of(cell);
        for &point in members {
            if core[point] {
                labels[point] = Some(cluster_of_cell[cell]);
                continue;
            }
            let candidates = near
                .cells(cells, point, &around)
                .flat_map(|other| cells.members(other).iter().map(move |&candidate| (other, candidate)))
                .filter(|&(_, candidate)| core[candidate] && near.holds(point, candidate));
            let nearest = candidates.min_by(|a, b| {
                near.squared(point, a.1).total_cmp(&near.squared(point, b.1)).then(a.1.cmp(&b.1))
            });
            labels[point] = nearest.map(|(other, _)| cluster_of_cell[other]);
        }
    }
    labels
}

/// Numbers clusters from 0 in the order of their first points.
fn number_clusters(labels: &Labels) -> Labels {
    let mut numbers = std::collections::BTreeMap::new();
    let mut number = |label: usize| {
        let next = numbers.len();
        *numbers.entry(label).or_insert(next)
    };
    labels.iter().map(|label| label.map(&mut number)).collect()
}

#[cfg(test)]
mod tests;
