//! Density-based clustering (DBSCAN), exact and near-linear.
//!
//! ```text
//! Points -> Cells -> core points -> joined cells -> border points -> Labels
//! ```

mod border;
mod bounds;
mod cells;
mod components;
mod core_points;
mod grid;
mod growth;
mod join;
mod labels;
mod rows;
mod strays;
mod tree;

use crate::points::Points;
use cells::Cells;
pub(crate) use growth::{Before, dbscan_of_more};
pub use labels::Labels;
use rows::{Fixed, Space, Wide};

/// What counts as dense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DbscanParameters {
    /// Radius of a point's neighborhood, above zero, in the unit of the points; its rim counts as inside. Below 1e-150 and
    /// above 1e150 its square is no number of all digits, and points near each other may be told apart.
    pub epsilon: f64,
    /// How many points, itself included, the neighborhood of a core point has; at least one.
    pub min_points: usize,
}

/// Clusters `points` by density: Ester, Kriegel, Sander and Xu, *A Density-Based Algorithm for Discovering Clusters in
/// Large Spatial Databases with Noise*, 1996.
///
/// A point with at least `min_points` points within `epsilon` is a core point; core points within `epsilon` of each other
/// are in one cluster; a border point (not core, but within `epsilon` of one) goes to its nearest core point's cluster,
/// ties to the earlier core point; the rest is noise. Two points are within `epsilon` when
/// [`squared_distance`](crate::points::squared_distance) gives at most `epsilon * epsilon`.
///
/// Exact, without most of the distances. Points are sorted into cells whose diagonal is at most `epsilon`: a cell of
/// `min_points` points is all core, and two cells are joined by the first pair of core points that is near enough
/// (Gunawan, *A Faster Algorithm for DBSCAN*, 2013; Gan and Tao, *DBSCAN Revisited*, 2015). Up to four dimensions the cells
/// are those of a grid; beyond, and where a grid would be too fine to count its cells, they are the leaves of a tree.
/// Cells that hold a heap have a tree of their own, so that a point beside a heap is not compared with all of it.
/// Few points in a cell of the grid with no cell near it are noise, and nobody looks at them again.
///
/// # Complexity
///
/// Memory O(n): in three dimensions about three times that of the points, these included, where they lie in heaps. Time
/// O(n log n), and about O(n) where things rest; in high dimension, where every cell is near every other, O(n²) at worst.
///
/// # Panics
///
/// When there are 2³² - 1 points or more, which take 32 GB for each of their coordinates.
///
/// # Example
///
/// ```
/// use goalgraph::dbscan::{DbscanParameters, dbscan};
/// use goalgraph::points::Points;
///
/// let points = Points::from_rows(1, vec![0.0, 0.1, 0.2, 9.0]);
/// let labels = dbscan(&points, DbscanParameters { epsilon: 0.15, min_points: 2 });
/// assert!(labels.iter().eq([Some(0), Some(0), Some(0), None]));
/// ```
pub fn dbscan(points: &Points, parameters: DbscanParameters) -> Labels {
    assert!(u32::try_from(points.len()).is_ok_and(|count| count < u32::MAX), "too many points");
    match points.dimension() {
        1 => cluster(Fixed::<1>, points, parameters),
        2 => cluster(Fixed::<2>, points, parameters),
        3 => cluster(Fixed::<3>, points, parameters),
        4 => cluster(Fixed::<4>, points, parameters),
        6 => cluster(Fixed::<6>, points, parameters),
        dimension => cluster(Wide(dimension), points, parameters),
    }
}

/// One way for all dimensions; those that are common are known to the compiler.
fn cluster(space: impl Space, points: &Points, parameters: DbscanParameters) -> Labels {
    let cells = Cells::new(space, points.coordinates(), parameters);
    let core = core_points::core_points(&cells);
    let components = join::join(&cells, &core);
    let border = border::border_points(&cells, &core);
    labels::labels(points.len(), &cells.into_order(), &core, &components, &border)
}

#[cfg(test)]
mod tests;
