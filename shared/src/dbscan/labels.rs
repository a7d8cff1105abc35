//! The result of a clustering.

use super::cells::Order;
use super::components::Components;

/// For each point the number of its cluster from 0, or none for noise. Clusters are numbered in the order of their first
/// points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Labels {
    /// [`NOISE`] where there is no cluster.
    numbers: Vec<u32>,
    clusters: usize,
}

const NOISE: u32 = u32::MAX;

impl Labels {
    /// Those of points in these clusters, whatever their order; each has a point, and what is in none is noise.
    pub(super) fn of_clusters(count: usize, clusters: &[Vec<usize>]) -> Self {
        let mut numbers = vec![NOISE; count];
        for (number, members) in clusters.iter().enumerate() {
            for &member in members {
                numbers[member] = number as u32;
            }
        }
        number_by_first_point(numbers, clusters.len())
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.numbers.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// How many clusters there are.
    pub fn clusters(&self) -> usize {
        self.clusters
    }

    /// The cluster of the point at `index`; none for noise.
    ///
    /// # Panics
    ///
    /// When `index` is not below [`Labels::len`].
    pub fn cluster(&self, index: usize) -> Option<usize> {
        let number = self.numbers[index];
        (number != NOISE).then_some(number as usize)
    }

    /// The cluster of each point.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<usize>> + '_ {
        (0..self.len()).map(|index| self.cluster(index))
    }
}

/// The labels of `count` points: core points have their cell's cluster, border points that of the cell named for them in
/// `border`.
pub(super) fn labels(
    count: usize,
    order: &Order,
    core: &[bool],
    components: &Components,
    border: &[(u32, u32)],
) -> Labels {
    let mut numbers = vec![NOISE; count];
    for (cell, ends) in order.starts.windows(2).enumerate() {
        let members = ends[0] as usize..ends[1] as usize;
        if core[members.clone()].contains(&true) {
            let component = components.find(cell) as u32;
            for at in members.filter(|&at| core[at]) {
                numbers[order.inputs[at] as usize] = component;
            }
        }
    }
    for &(at, cell) in border {
        numbers[order.inputs[at as usize] as usize] = components.find(cell as usize) as u32;
    }
    number_by_first_point(numbers, order.starts.len() - 1)
}

fn number_by_first_point(mut numbers: Vec<u32>, cells: usize) -> Labels {
    let mut number_of = vec![NOISE; cells];
    let mut clusters = 0;
    for number in numbers.iter_mut().filter(|number| **number != NOISE) {
        let known = &mut number_of[*number as usize];
        if *known == NOISE {
            *known = clusters;
            clusters += 1;
        }
        *number = *known;
    }
    Labels { numbers, clusters: clusters as usize }
}
