//! Spots: where every box is now, and where it was.

use std::collections::BTreeMap;

use super::free::place_new;
use super::push::push;
use crate::layout::graph::{Graph, Size};
use crate::layout::{Layout, LayoutRequest, NodeBox, Point, Rect};
use crate::pdfa::StateId;

/// Where the box of a node is, in flow space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) center: Point,
    pub(super) size: Size,
    /// Where it was and how large, unless it is new.
    pub(super) before: Option<(Point, Size)>,
    /// Whether it must stay at its center.
    pub(super) held: bool,
}

impl Spot {
    pub(super) fn rect(&self) -> Rect {
        Rect::centered(self.center, self.size.width, self.size.height)
    }

    /// Whether it moved, changed size or is new.
    pub(super) fn is_changed(&self) -> bool {
        self.before != Some((self.center, self.size))
    }

    /// How far it moved, unless it changed size or is new.
    pub(super) fn shift(&self) -> Option<Point> {
        let (center, _) = self.before.filter(|(_, size)| *size == self.size)?;
        Some(Point::new(self.center.x - center.x, self.center.y - center.y))
    }

    /// Whether it is larger than it was.
    pub(super) fn is_grown(&self) -> bool {
        self.before.is_some_and(|(_, size)| self.size.width > size.width || self.size.height > size.height)
    }
}

/// The spot of every node of the graph.
///
/// # Complexity
///
/// O(N log N) for N nodes, and O(N) for every box that grew or is new.
pub(super) fn spots(
    graph: &Graph,
    request: &LayoutRequest,
    before: &Layout,
    held: &BTreeMap<StateId, Point>,
) -> Vec<Spot> {
    let mut old: BTreeMap<StateId, &NodeBox> = BTreeMap::new();
    for node in before.nodes.iter().filter(|node| is_sound(node)) {
        old.entry(node.id).or_insert(node);
    }
    let spot = |(id, &size): (&StateId, &Size)| {
        let before = old.get(id).map(|node| {
            let (width, height) = (node.width, node.height);
            (Point::new(node.x, node.y), Size { width, height })
        });
        let center = held.get(id).copied();
        let held = center.is_some();
        let center = center.or(before.map(|(center, _)| center))?;
        Some(Spot { center, size, before, held })
    };
    let mut spots: Vec<Option<Spot>> = graph.ids.iter().zip(&graph.sizes).map(spot).collect();
    push(&mut spots);
    place_new(graph, request, before, spots)
}

fn is_sound(node: &NodeBox) -> bool {
    [node.x, node.y, node.width, node.height].iter().all(|value| value.is_finite())
}
