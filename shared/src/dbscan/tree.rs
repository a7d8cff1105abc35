//! Boxes in boxes over a range of rows, for questions that few of the rows have to be asked about.

use std::ops::Range;

use super::bounds::{Bounds, around};
use super::rows::{Rows, Space};
use crate::points::squared_distance;

/// Boxes are halved no more often than this: only points at distances that double again and again need more.
const DEEPEST: u32 = 64;

/// Trees in one place. A node's first child follows it.
pub(super) struct Trees<S> {
    space: S,
    nodes: Vec<Node>,
    /// Lowest, then highest coordinates of each node.
    bounds: Vec<f64>,
}

struct Node {
    start: u32,
    end: u32,
    /// The second child; of a leaf, the node itself.
    second: u32,
}

/// A node of [`Trees`].
pub(super) type NodeId = u32;

/// What a node is made of.
pub(super) enum Parts {
    /// These rows.
    Leaf(Range<usize>),
    /// The rows of two nodes.
    Both(NodeId, NodeId),
}

/// What is asked about the rows within epsilon of a point.
pub(super) struct Ball<'a> {
    pub(super) center: &'a [f64],
    pub(super) squared_epsilon: f64,
}

impl Ball<'_> {
    pub(super) fn bounds(&self) -> Bounds<'_> {
        Bounds::of_point(self.center)
    }
}

impl<S: Space> Trees<S> {
    pub(super) fn new(space: S) -> Self {
        Self { space, nodes: Vec::new(), bounds: Vec::new() }
    }

    /// Plants a tree over `range` of the rows, which it puts into the order of its leaves; those are boxes of no width
    /// and what `is_leaf` says, by their number of rows and their box. Returns the root.
    ///
    /// # Complexity
    ///
    /// O(n log n) for n rows that fill their boxes; at most O(n) for each of the halvings that there can be.
    pub(super) fn plant(
        &mut self,
        rows: &mut Rows<S>,
        range: Range<usize>,
        is_leaf: impl Fn(usize, &Bounds) -> bool,
    ) -> NodeId {
        let root = self.nodes.len() as NodeId;
        let mut waiting = vec![(range, root, 0)];
        while let Some((range, parent, depth)) = waiting.pop() {
            let node = self.push(rows, range.clone());
            if self.nodes[parent as usize].second == parent && node > parent + 1 {
                self.nodes[parent as usize].second = node;
            }
            let bounds = self.bounds(node);
            let middle = bounds.middle().filter(|_| depth < DEEPEST && !is_leaf(range.len(), &bounds));
            if let Some((axis, pivot)) = middle {
                let cut = range.start + rows.partition(range.clone(), axis, pivot);
                waiting.push((cut..range.end, node, depth + 1));
                waiting.push((range.start..cut, node, depth + 1));
            }
        }
        root
    }

    fn push(&mut self, rows: &Rows<S>, range: Range<usize>) -> NodeId {
        let node = self.nodes.len() as NodeId;
        around(self.space.dimension(), rows.rows(range.clone()), &mut self.bounds);
        self.nodes.push(Node { start: range.start as u32, end: range.end as u32, second: node });
        node
    }

    /// All nodes, of which the leaves are in the order of their rows.
    pub(super) fn nodes(&self) -> Range<NodeId> {
        0..self.nodes.len() as NodeId
    }

    #[inline]
    pub(super) fn bounds(&self, node: NodeId) -> Bounds<'_> {
        let dimension = self.space.dimension();
        Bounds::new(dimension, &self.bounds[node as usize * 2 * dimension..][..2 * dimension])
    }

    /// The rows of a node.
    #[inline]
    pub(super) fn range(&self, node: NodeId) -> Range<usize> {
        let node = &self.nodes[node as usize];
        node.start as usize..node.end as usize
    }

    #[inline]
    pub(super) fn parts(&self, node: NodeId) -> Parts {
        match self.nodes[node as usize].second {
            second if second == node => Parts::Leaf(self.range(node)),
            second => Parts::Both(node + 1, second),
        }
    }

    /// How many rows of `node` are in `ball`, or at least `enough` of them.
    pub(super) fn count(&self, rows: &Rows<S>, node: NodeId, ball: &Ball, enough: usize) -> usize {
        let (bounds, center) = (self.bounds(node), ball.bounds());
        if bounds.nearest(&center) > ball.squared_epsilon {
            return 0;
        }
        if bounds.farthest(&center) <= ball.squared_epsilon {
            return self.range(node).len();
        }
        match self.parts(node) {
            Parts::Leaf(range) => rows.count(range, ball),
            Parts::Both(first, second) => {
                let count = self.count(rows, first, ball, enough);
                let missing = enough.saturating_sub(count);
                if missing == 0 { count } else { count + self.count(rows, second, ball, missing) }
            }
        }
    }
}

impl<S: Space> Rows<S> {
    /// How many rows of `range` are in `ball`.
    #[inline]
    pub(super) fn count(&self, range: Range<usize>, ball: &Ball) -> usize {
        let squares = self.rows(range).map(|row| squared_distance(row, ball.center));
        squares.filter(|&squared| squared <= ball.squared_epsilon).count()
    }
}
