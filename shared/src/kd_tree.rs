//! Points arranged by where they are, for searches near a point (Bentley 1975).
//!
//! Everything is compared by squared distances that are summed feature by feature: rounding keeps the order of terms and
//! of sums, so what a box says of its points is true to the last bit.

use std::ops::Range;

use crate::points::squared_distance;

/// Points in boxes, each of which is split at its middle point until few are left.
///
/// Points are known by their slots in the tree; [`KdTree::position`] tells which point it is.
pub(crate) struct KdTree {
    dimension: usize,
    /// The position of the point in each slot.
    positions: Vec<usize>,
    /// The coordinates of the points in the order of their slots.
    coordinates: Vec<f64>,
    /// A node, then all in its first half, then all in its second.
    nodes: Vec<Node>,
    /// For each node the least coordinates of its points, then the largest.
    bounds: Vec<f64>,
}

/// A box of the tree.
struct Node {
    slots: Range<usize>,
    /// The node of the second half; the first is the next node. None of a leaf.
    second: Option<usize>,
}

/// A box with no more points than this is not split.
const LEAF: usize = 8;

impl KdTree {
    /// The tree of `points` of `dimension` coordinates each.
    ///
    /// # Complexity
    ///
    /// O(n log n x features).
    pub(crate) fn new(dimension: usize, points: &[&[f64]]) -> Self {
        let mut tree = Self {
            dimension,
            positions: (0..points.len()).collect(),
            coordinates: Vec::with_capacity(points.len() * dimension),
            nodes: Vec::new(),
            bounds: Vec::new(),
        };
        tree.split(points, 0..points.len());
        for &position in &tree.positions {
            tree.coordinates.extend_from_slice(points[position]);
        }
        tree
    }

    fn split(&mut self, points: &[&[f64]], slots: Range<usize>) {
        let node = self.nodes.len();
        self.nodes.push(Node { slots: slots.clone(), second: None });
        let inside = &mut self.positions[slots.clone()];
        let extent = |axis: usize, from: f64, further: fn(f64, f64) -> f64| {
            inside.iter().map(|&position| points[position][axis]).fold(from, further)
        };
        let least: Vec<f64> = (0..self.dimension).map(|axis| extent(axis, f64::INFINITY, f64::min)).collect();
        let largest: Vec<f64> =
            (0..self.dimension).map(|axis| extent(axis, f64::NEG_INFINITY, f64::max)).collect();
        let width = |axis: usize| largest[axis] - least[axis];
        let widest = (0..self.dimension).max_by(|&a, &b| width(a).total_cmp(&width(b)));
        let splits = widest.filter(|&axis| slots.len() > LEAF && width(axis) > 0.0);
        if let Some(axis) = splits {
            let middle = slots.len() / 2;
            let along = |&a: &usize, &b: &usize| points[a][axis].total_cmp(&points[b][axis]).then(a.cmp(&b));
            inside.select_nth_unstable_by(middle, along);
            self.bounds.extend(least.into_iter().chain(largest));
            self.split(points, slots.start..slots.start + middle);
            self.nodes[node].second = Some(self.nodes.len());
            self.split(points, slots.start + middle..slots.end);
        } else {
            self.bounds.extend(least.into_iter().chain(largest));
        }
    }

    /// How many points there are.
    pub(crate) fn len(&self) -> usize {
        self.positions.len()
    }

    /// Which of the points is in `slot`.
    pub(crate) fn position(&self, slot: usize) -> usize {
        self.positions[slot]
    }

    /// The coordinates of the point in `slot`.
    pub(crate) fn point(&self, slot: usize) -> &[f64] {
        &self.coordinates[slot * self.dimension..(slot + 1) * self.dimension]
    }

    /// For each node what `leaf` says of its slots, or `join` of its two halves.
    pub(crate) fn summarize<T: Copy + Default>(
        &self,
        leaf: impl Fn(Range<usize>) -> T,
        join: impl Fn(T, T) -> T,
    ) -> Vec<T> {
        let mut all = vec![T::default(); self.nodes.len()];
        for (index, node) in self.nodes.iter().enumerate().rev() {
            all[index] = match node.second {
                Some(second) => join(all[index + 1], all[second]),
                None => leaf(node.slots.clone()),
            };
        }
        all
    }

    /// Offers the slots of points that are no further from `point` than the square root of `within`, nearer boxes first,
    /// each with its squared distance. An offer answers what `within` is from then on; boxes that `is_left_out` are not
    /// looked into.
    pub(crate) fn search(
        &self,
        point: &[f64],
        within: f64,
        is_left_out: impl Fn(usize) -> bool,
        mut offer: impl FnMut(usize, f64) -> f64,
    ) {
        let mut within = within;
        let mut waiting = vec![(0, self.squared_distance_to(0, point))];
        while let Some((index, squared)) = waiting.pop() {
            if squared > within || is_left_out(index) {
                continue;
            }
            let node = &self.nodes[index];
            if let Some(second) = node.second {
                let halves = [index + 1, second].map(|half| (half, self.squared_distance_to(half, point)));
                let [near, far] = if halves[1].1 < halves[0].1 { [halves[1], halves[0]] } else { halves };
                waiting.extend([far, near]);
                continue;
            }
            let nearest = squared;
            for slot in node.slots.clone() {
                let squared = squared_distance(point, self.point(slot));
                if squared <= within {
                    within = offer(slot, squared);
                }
                if nearest > within {
                    break;
                }
            }
        }
    }

    /// Whether at least `count` points are no further from `point` than `reach`.
    ///
    /// # Complexity
    ///
    /// O(log n) boxes and those that the surface of the ball cuts.
    pub(crate) fn has_within(&self, point: &[f64], reach: f64, count: usize) -> bool {
        let mut found = 0;
        let mut waiting = vec![0];
        while let Some(index) = waiting.pop() {
            let node = &self.nodes[index];
            if found >= count {
                return true;
            }
            if self.squared_distance_to(index, point).sqrt() > reach {
                continue;
            }
            if self.squared_distance_across(index, point).sqrt() <= reach {
                found += node.slots.len();
            } else if let Some(second) = node.second {
                waiting.extend([second, index + 1]);
            } else {
                let is_near = |&slot: &usize| squared_distance(self.point(slot), point).sqrt() <= reach;
                found += node.slots.clone().filter(is_near).count();
            }
        }
        found >= count
    }

    fn bounds(&self, node: usize) -> impl Iterator<Item = (&f64, &f64)> {
        let bounds = &self.bounds[2 * node * self.dimension..2 * (node + 1) * self.dimension];
        let (least, largest) = bounds.split_at(self.dimension);
        least.iter().zip(largest)
    }

    /// No point of the node is nearer; infinite where there is none.
    fn squared_distance_to(&self, node: usize, point: &[f64]) -> f64 {
        let gap = |((least, largest), x): ((&f64, &f64), &f64)| (least - x).max(x - largest).max(0.0);
        self.bounds(node).zip(point).map(gap).map(|gap| gap * gap).sum()
    }

    /// No point of the node is further.
    fn squared_distance_across(&self, node: usize, point: &[f64]) -> f64 {
        let way = |((least, largest), x): ((&f64, &f64), &f64)| (x - least).max(largest - x);
        self.bounds(node).zip(point).map(way).map(|way| way * way).sum()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::distance;

    /// Coordinates of which many are alike.
    fn coordinates() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(prop_oneof![-1.0..1.0, (0..4_i32).prop_map(|x| 0.25 * f64::from(x))], 0..200)
    }

    proptest! {
        #[test]
        fn points_within_reach_are_counted(
            coordinates in coordinates(), dimension in 1..5_usize, reach in prop_oneof![0.0..1.5, Just(0.25), Just(0.0)],
        ) {
            let points: Vec<&[f64]> = coordinates.chunks_exact(dimension).collect();
            let tree = KdTree::new(dimension, &points);
            for point in &points {
                let count = points.iter().filter(|other| distance(other, point) <= reach).count();
                prop_assert!(tree.has_within(point, reach, count) && !tree.has_within(point, reach, count + 1));
            }
        }

        #[test]
        fn a_search_offers_all_that_is_near(coordinates in coordinates(), dimension in 1..5_usize, within in 0.0..1.0) {
            let points: Vec<&[f64]> = coordinates.chunks_exact(dimension).collect();
            let tree = KdTree::new(dimension, &points);
            for point in points.iter().take(9) {
                let mut offered = Vec::new();
                tree.search(point, within, |_| false, |slot, squared| {
                    offered.push((tree.position(slot), squared));
                    within
                });
                offered.sort_by_key(|&(position, _)| position);
                let squared = |(position, other): (usize, &&[f64])| (position, squared_distance(other, point));
                let near = points.iter().enumerate().map(squared).filter(|&(_, squared)| squared <= within);
                prop_assert_eq!(offered, near.collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn there_may_be_no_point() {
        assert!(!KdTree::new(2, &[]).has_within(&[0.0, 0.0], 9.0, 1));
    }
}
