//! The minimum spanning tree of points.

use petgraph::unionfind::UnionFind;

use crate::kd_tree::KdTree;

/// An edge between two points, by their positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    /// The end that is nearer to the first point along the tree.
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) length: f64,
}

/// The edges of the Euclidean minimum spanning tree of `points` of `dimension` coordinates, shortest first.
///
/// Of edges of one length the one with the lower positions counts as shorter: first by its lower position, then by the
/// other. So there is one tree, and one order. In rounds each component is joined to the one next to it (Borůvka 1926),
/// which a tree over the points tells without looking into boxes that the component fills (March, Ram and Gray 2010).
///
/// # Complexity
///
/// O(n log² n) for n points of few coordinates; of many, at worst O(n²) in each of O(log n) rounds.
pub(super) fn spanning_tree(dimension: usize, points: &[&[f64]]) -> Vec<Edge> {
    let (distinct, mut links) = without_repeats(points);
    let places: Vec<&[f64]> = distinct.iter().map(|&position| points[position]).collect();
    let mut forest = Forest::new(KdTree::new(dimension, &places), &distinct);
    while forest.links.len() + 1 < places.len() {
        forest.join_nearest();
    }
    links.append(&mut forest.links);
    links.sort_unstable_by(Link::order);
    outward(points.len(), &links)
}

/// Two points, the one with the lower position first.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Link {
    squared: f64,
    ends: [usize; 2],
}

impl Link {
    fn order(&self, other: &Self) -> std::cmp::Ordering {
        self.squared.total_cmp(&other.squared).then_with(|| self.ends.cmp(&other.ends))
    }

    fn is_before(&self, other: Option<&Self>) -> bool {
        other.is_none_or(|other| self.order(other).is_lt())
    }
}

/// The positions of the first point of each place, ascending, and the links of the other points there to that.
fn without_repeats(points: &[&[f64]]) -> (Vec<usize>, Vec<Link>) {
    let by_place = |&a: &usize, &b: &usize| {
        points[a].partial_cmp(points[b]).map_or_else(|| a.cmp(&b), |it| it.then(a.cmp(&b)))
    };
    let mut sorted: Vec<usize> = (0..points.len()).collect();
    sorted.sort_unstable_by(by_place);
    let (mut distinct, mut links) = (Vec::new(), Vec::new());
    for alike in sorted.chunk_by(|&a, &b| points[a] == points[b]) {
        distinct.push(alike[0]);
        links.extend(alike[1..].iter().map(|&other| Link { squared: 0.0, ends: [alike[0], other] }));
    }
    distinct.sort_unstable();
    (distinct, links)
}

/// A part of the spanning tree; points go by their slots in the search tree.
struct Forest {
    tree: KdTree,
    /// The position of the point in each slot.
    positions: Vec<usize>,
    components: UnionFind<usize>,
    links: Vec<Link>,
    /// What each point knows of the nearest point of another component.
    known: Vec<Known>,
}

/// What a point knows of the nearest point outside of its component.
#[derive(Clone, Copy)]
enum Known {
    /// None is as near as this, squared.
    Beyond(f64),
    /// It is in this slot, as long as that is of another component.
    Nearest(Link, usize),
}

impl Forest {
    fn new(tree: KdTree, distinct: &[usize]) -> Self {
        let count = tree.len();
        let positions = (0..count).map(|slot| distinct[tree.position(slot)]).collect();
        let known = vec![Known::Beyond(f64::NEG_INFINITY); count];
        Self { tree, positions, components: UnionFind::new(count), links: Vec::new(), known }
    }

    /// Joins each component to the one that is nearest to it.
    fn join_nearest(&mut self) {
        let labels: Vec<usize> = (0..self.tree.len()).map(|slot| self.components.find_mut(slot)).collect();
        let only = |labels: &[usize]| {
            labels.first().filter(|&first| labels.iter().all(|label| label == first)).copied()
        };
        let fills = self.tree.summarize(|slots| only(&labels[slots]), |a, b| a.filter(|_| a == b));
        let mut nearest: Vec<Option<(Link, [usize; 2])>> = vec![None; labels.len()];
        for (slot, &label) in labels.iter().enumerate() {
            let so_far = nearest[label].map(|(link, _)| link);
            let within = so_far.map_or(f64::INFINITY, |link| link.squared);
            match self.known[slot] {
                Known::Nearest(_, other) if labels[other] != label => {}
                Known::Beyond(squared) if squared >= within => continue,
                _ => self.known[slot] = self.nearest_outside(slot, within, &labels, &fills),
            }
            if let Known::Nearest(link, other) = self.known[slot]
                && link.is_before(so_far.as_ref())
            {
                nearest[label] = Some((link, [slot, other]));
            }
        }
        for (link, [from, to]) in nearest.into_iter().flatten() {
            if self.components.union(from, to) {
                self.links.push(link);
            }
        }
    }

    /// Of the points no further away than the square root of `within` the nearest outside of the component.
    fn nearest_outside(&self, slot: usize, within: f64, labels: &[usize], fills: &[Option<usize>]) -> Known {
        let mut known = Known::Beyond(within);
        let mut within = within;
        let is_left_out = |node: usize| fills[node] == Some(labels[slot]);
        self.tree.search(self.tree.point(slot), within, is_left_out, |other, squared| {
            if labels[other] != labels[slot] {
                let (a, b) = (self.positions[slot], self.positions[other]);
                let link = Link { squared, ends: [a.min(b), a.max(b)] };
                let is_nearer = match &known {
                    Known::Beyond(_) => true,
                    Known::Nearest(nearest, _) => link.is_before(Some(nearest)),
                };
                if is_nearer {
                    known = Known::Nearest(link, other);
                    within = squared;
                }
            }
            within
        });
        known
    }
}

/// The links of a spanning tree as edges that lead away from the first point, in the order of the links.
fn outward(count: usize, links: &[Link]) -> Vec<Edge> {
    let ends = || links.iter().enumerate().flat_map(|(index, link)| link.ends.map(|end| (end, index)));
    let mut first = vec![0; count + 1];
    ends().for_each(|(end, _)| first[end + 1] += 1);
    for point in 0..count {
        first[point + 1] += first[point];
    }
    let mut at_point = vec![0; 2 * links.len()];
    let mut next = first.clone();
    for (end, index) in ends() {
        at_point[next[end]] = index;
        next[end] += 1;
    }
    let edge = |link: &Link| Edge { from: link.ends[0], to: link.ends[1], length: link.squared.sqrt() };
    let mut edges: Vec<Edge> = links.iter().map(edge).collect();
    let mut waiting: Vec<(usize, Option<usize>)> = (0..count.min(1)).map(|root| (root, None)).collect();
    while let Some((point, came_by)) = waiting.pop() {
        for &index in &at_point[first[point]..first[point + 1]] {
            if Some(index) != came_by {
                let edge = &mut edges[index];
                (edge.from, edge.to) = (point, edge.from + edge.to - point);
                waiting.push((edge.to, Some(index)));
            }
        }
    }
    edges
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::squared_distance;

    /// The edges by the plain algorithm (Prim 1957), from the first point outward.
    fn prim(points: &[&[f64]]) -> Vec<Edge> {
        let link = |a: usize, b: usize| Link {
            squared: squared_distance(points[a], points[b]),
            ends: [a.min(b), a.max(b)],
        };
        let mut links = Vec::new();
        let mut nearest: Vec<(usize, Link)> = (1..points.len()).map(|to| (to, link(0, to))).collect();
        let mut edges = Vec::new();
        while let Some(at) = (0..nearest.len()).min_by(|&a, &b| nearest[a].1.order(&nearest[b].1)) {
            let (to, joined) = nearest.swap_remove(at);
            for (other, known) in &mut nearest {
                let new = link(to, *other);
                if new.is_before(Some(known)) {
                    *known = new;
                }
            }
            let from = joined.ends[0] + joined.ends[1] - to;
            links.push(joined);
            edges.push((joined, Edge { from, to, length: joined.squared.sqrt() }));
        }
        edges.sort_by(|(a, _), (b, _)| a.order(b));
        edges.into_iter().map(|(_, edge)| edge).collect()
    }

    /// Coordinates of which many are alike: points fall on each other, and distances tie.
    fn coordinates() -> impl Strategy<Value = Vec<f64>> {
        let cell = prop_oneof![
            2 => -1.0..1.0,
            2 => (0..4_i32).prop_map(|x| 0.25 * f64::from(x)),
            1 => Just(-0.0),
        ];
        prop_oneof![
            prop::collection::vec(cell, 0..150),
            prop::collection::vec((0..5_i32).prop_map(f64::from), 0..400),
            prop::collection::vec(-1.0..1.0, 0..400),
        ]
    }

    proptest! {
        #[test]
        fn the_tree_is_that_of_the_plain_algorithm(coordinates in coordinates(), dimension in 1..5_usize) {
            let points: Vec<&[f64]> = coordinates.chunks_exact(dimension).collect();
            prop_assert_eq!(spanning_tree(dimension, &points), prim(&points));
        }
    }

    #[test]
    fn few_points_have_few_edges() {
        assert_eq!(spanning_tree(1, &[]), []);
        assert_eq!(spanning_tree(1, &[&[3.0]]), []);
        let edges = spanning_tree(1, &[&[3.0], &[1.0], &[1.0], &[2.0]]);
        let expected = [(1, 2, 0.0), (0, 3, 1.0), (3, 1, 1.0)];
        assert_eq!(edges, expected.map(|(from, to, length)| Edge { from, to, length }));
    }
}
