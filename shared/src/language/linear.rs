//! Sums over all ways through a weighted graph: the least x with x = c + W x, node by node and cycle by cycle.

use nalgebra::{DMatrix, DVector};
use petgraph::algo::kosaraju_scc;
use petgraph::graph::DiGraph;

/// The steps out of a node, as (node, weight).
pub(crate) type Row = Vec<(usize, f64)>;

/// The largest strongly connected component that is solved by elimination.
const ELIMINATED: usize = 300;

/// For larger ones: sweeps stop when no value changes by more than this part of itself, or after [`SWEEPS`].
const STILL: f64 = 1e-14;

/// With [`STILL`], what Gauss-Seidel is stopped by.
const SWEEPS: usize = 2_000;

/// Strongly connected components of a graph, each after all that can be reached from it.
pub(crate) struct Components(Vec<Vec<usize>>);

impl Components {
    /// The components of the graph with these steps; targets are below `rows.len()`.
    ///
    /// # Complexity
    ///
    /// O(N + E) for N nodes and E steps (Kosaraju's algorithm).
    pub(crate) fn of(rows: &[Row]) -> Self {
        let mut graph = DiGraph::<(), ()>::with_capacity(rows.len(), 0);
        let nodes: Vec<_> = rows.iter().map(|_| graph.add_node(())).collect();
        for (source, row) in rows.iter().enumerate() {
            for &(target, _) in row {
                graph.add_edge(nodes[source], nodes[target], ());
            }
        }
        let indices = |component: Vec<_>| {
            let mut indices: Vec<usize> =
                component.into_iter().map(petgraph::graph::NodeIndex::index).collect();
            indices.sort_unstable();
            indices
        };
        Self(kosaraju_scc(&graph).into_iter().map(indices).collect())
    }

    /// Each component after all that can be reached from it.
    pub(crate) fn sinks_first(&self) -> impl Iterator<Item = &[usize]> {
        self.0.iter().map(Vec::as_slice)
    }

    /// Each component before all that can be reached from it.
    pub(crate) fn sources_first(&self) -> impl Iterator<Item = &[usize]> {
        self.0.iter().rev().map(Vec::as_slice)
    }
}

/// Whether a component holds a cycle.
pub(crate) fn is_cyclic(component: &[usize], rows: &[Row]) -> bool {
    let to_itself = |&node: &usize| rows[node].iter().any(|&(target, _)| target == node);
    component.len() > 1 || component.iter().any(to_itself)
}

/// The least solution of x = `constants` + `rows` · x, one value per node, none of them negative.
///
/// The `components` of the graph come in an order in which the targets of a row are in the same component or an earlier
/// one. Where the sum over a cycle diverges the values are infinite. A component of up to 300 nodes is solved by
/// LU decomposition with partial pivoting, a larger one by Gauss-Seidel sweeps from zero, which approach the solution
/// from below, until no value changes by more than 1e-14 of itself, or for 2,000 sweeps.
///
/// # Complexity
///
/// O(N + E) outside cycles; O(C³) for a component of C nodes, or up to 2,000 looks at each of its steps.
pub(crate) fn solve<'a>(
    components: impl Iterator<Item = &'a [usize]>,
    rows: &[Row],
    constants: Vec<f64>,
) -> Vec<f64> {
    let mut x = constants;
    for component in components {
        if let &[node] = component {
            x[node] = solve_alone(node, &rows[node], &x);
        } else if component.len() <= ELIMINATED {
            eliminate(component, rows, &mut x);
        } else {
            sweep(component, rows, &mut x);
        }
    }
    x
}

fn solve_alone(node: usize, row: &Row, x: &[f64]) -> f64 {
    let mut value = x[node];
    let mut again = 0.0;
    for &(target, weight) in row {
        if target == node {
            again += weight;
        } else {
            value += times(weight, x[target]);
        }
    }
    repeated(value, again)
}

/// `value` · (1 + `again` + `again`² + ..).
fn repeated(value: f64, again: f64) -> f64 {
    if value > 0.0 && again >= 1.0 { f64::INFINITY } else { value / (1.0 - again).max(f64::EPSILON) }
}

/// Nothing times infinity is nothing: a way that is not taken adds nothing.
fn times(weight: f64, value: f64) -> f64 {
    if weight == 0.0 || value == 0.0 { 0.0 } else { weight * value }
}

fn eliminate(component: &[usize], rows: &[Row], x: &mut [f64]) {
    let size = component.len();
    let mut matrix = DMatrix::<f64>::identity(size, size);
    let mut right = DVector::<f64>::zeros(size);
    for (row, &node) in component.iter().enumerate() {
        right[row] = x[node];
        for &(target, weight) in &rows[node] {
            match component.binary_search(&target) {
                Ok(column) => matrix[(row, column)] -= weight,
                Err(_) => right[row] += times(weight, x[target]),
            }
        }
    }
    let nothing = right.iter().all(|&value| value == 0.0);
    let solution = if nothing { Some(right) } else { matrix.lu().solve(&right) };
    let sound = |value: &f64| value.is_finite() && *value > -1e-9;
    let solution = solution.filter(|solution| solution.iter().all(sound));
    for (row, &node) in component.iter().enumerate() {
        x[node] = solution.as_ref().map_or(f64::INFINITY, |solution| solution[row].max(0.0));
    }
}

/// Gauss-Seidel, each node after those that it leads to, but for the steps that close a cycle: what flows once around a
/// cycle does so in one sweep.
fn sweep(component: &[usize], rows: &[Row], x: &mut [f64]) {
    let inside = |node: usize| component.binary_search(&node).is_ok();
    let order = targets_first(component, rows);
    let mut constants = Vec::with_capacity(order.len());
    for &node in &order {
        let outside = rows[node].iter().filter(|(target, _)| !inside(*target));
        constants.push(x[node] + outside.map(|&(target, weight)| times(weight, x[target])).sum::<f64>());
    }
    let within =
        |&node: &usize| -> Row { rows[node].iter().filter(|step| inside(step.0)).copied().collect() };
    let within: Vec<Row> = order.iter().map(within).collect();
    for &node in component {
        x[node] = 0.0;
    }
    for _ in 0..SWEEPS {
        let mut still = true;
        for ((&node, row), constant) in order.iter().zip(&within).zip(&constants) {
            let before = std::mem::replace(&mut x[node], *constant);
            x[node] = solve_alone(node, row, x);
            // Infinite is still, too: the difference to itself is no number.
            let moved = (x[node] - before).abs() > STILL * x[node];
            still &= !moved;
        }
        if still {
            break;
        }
    }
}

/// The nodes of a component in the order in which a depth-first search leaves them.
fn targets_first(component: &[usize], rows: &[Row]) -> Vec<usize> {
    let mut entered = vec![false; component.len()];
    let mut order = Vec::with_capacity(component.len());
    for start in 0..component.len() {
        if std::mem::replace(&mut entered[start], true) {
            continue;
        }
        let mut open = vec![(start, rows[component[start]].iter())];
        while let Some((position, steps)) = open.last_mut() {
            let Some(&(target, _)) = steps.next() else {
                order.push(component[*position]);
                open.pop();
                continue;
            };
            if let Ok(next) = component.binary_search(&target)
                && !std::mem::replace(&mut entered[next], true)
            {
                open.push((next, rows[target].iter()));
            }
        }
    }
    order
}
