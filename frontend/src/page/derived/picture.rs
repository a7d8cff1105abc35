//! Where everything is drawn, from edit to edit: what was there stays there.

use std::collections::BTreeMap;
use std::sync::Arc;

use goalgraph::layout::{EdgePath, Layout, LayoutRequest, NodeBox, Point, Rect, adjust};
use goalgraph::pdfa::{StateId, Symbol};

use crate::page::model::Tidied;

/// A layout with its parts by name, and the places of states that are gone for now.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture {
    /// The layout.
    pub(crate) layout: Arc<Layout>,
    nodes: BTreeMap<StateId, usize>,
    edges: BTreeMap<(StateId, Symbol), usize>,
    /// Where states were last: one that comes back, by undoing or redoing, finds its place again.
    places: BTreeMap<StateId, Point>,
    /// Which of the worker's answers it began with.
    answer: u32,
    /// Whether it is that answer as it came.
    untouched: bool,
}

/// What a picture is made for.
pub(super) struct PictureRequest<'a> {
    /// The boxes and arrows.
    pub(super) layout: &'a LayoutRequest,
    /// The worker's placements.
    pub(super) tidied: &'a Tidied,
    /// Whether they are those of another automaton.
    pub(super) outdated: bool,
    /// States that are to be at a place.
    pub(super) held: &'a BTreeMap<StateId, Point>,
    /// Width and height of the frame.
    pub(super) frame: (f64, f64),
}

impl Picture {
    /// The picture after `previous`. There is none before the worker's first answer and before the frame is measured;
    /// while the worker works on another, nothing moves.
    pub(super) fn next(previous: Option<&Self>, request: &PictureRequest) -> Option<Self> {
        let tidied = request.tidied;
        if request.outdated || tidied.asked != tidied.answered {
            return previous.cloned();
        }
        let fresh = previous.is_none_or(|previous| {
            // Until something is moved the direction follows the frame.
            previous.answer != tidied.answered || (previous.untouched && request.held.is_empty())
        });
        if fresh {
            let best = best_fit(&tidied.layouts, request.frame)?;
            let next = Self::adjusted(&best, BTreeMap::new(), request);
            return Some(Self { answer: tidied.answered, untouched: next.layout == best, ..next });
        }
        let previous = previous?;
        Some(Self::adjusted(&previous.layout, previous.places.clone(), request))
            .map(|next| Self { answer: tidied.answered, ..next })
    }

    /// This picture with some states put elsewhere.
    pub(super) fn with_moving(&self, request: &LayoutRequest, held: &BTreeMap<StateId, Point>) -> Self {
        let layout = adjust(&self.layout, request, held);
        Self::of(Arc::new(layout), self.places.clone())
    }

    fn adjusted(
        layout: &Arc<Layout>,
        mut places: BTreeMap<StateId, Point>,
        request: &PictureRequest,
    ) -> Self {
        let there: BTreeMap<StateId, usize> = layout.nodes.iter().map(|node| (node.id, 0)).collect();
        let back = request.layout.nodes.iter().filter(|node| !there.contains_key(&node.id));
        let mut held = request.held.clone();
        for node in back {
            if let Some(&place) = places.get(&node.id) {
                held.entry(node.id).or_insert(place);
            }
        }
        let next = Arc::new(adjust(layout, request.layout, &held));
        let next = if next == *layout { Arc::clone(layout) } else { next };
        places.extend(next.nodes.iter().map(|node| (node.id, Point::new(node.x, node.y))));
        Self::of(next, places)
    }

    fn of(layout: Arc<Layout>, places: BTreeMap<StateId, Point>) -> Self {
        let nodes = layout.nodes.iter().enumerate().map(|(index, node)| (node.id, index)).collect();
        let name = |(index, edge): (usize, &EdgePath)| ((edge.source, edge.symbol), index);
        let edges = layout.edges.iter().enumerate().map(name).collect();
        Self { layout, nodes, edges, places, answer: 0, untouched: false }
    }

    /// The box of a state.
    pub(crate) fn node(&self, id: StateId) -> Option<&NodeBox> {
        self.layout.nodes.get(*self.nodes.get(&id)?)
    }

    /// Where the box of a state is.
    pub(crate) fn node_rect(&self, id: StateId) -> Option<Rect> {
        self.node(id).map(rect)
    }

    /// All states with their boxes.
    pub(crate) fn states(&self) -> impl Iterator<Item = (StateId, Rect)> {
        self.layout.nodes.iter().map(|node| (node.id, rect(node)))
    }

    /// What the drawing fills.
    pub(crate) fn bounds(&self) -> Rect {
        let Layout { left, top, width, height, .. } = *self.layout;
        Rect { left, top, right: left + width, bottom: top + height }
    }

    /// The arrow of a transition.
    pub(crate) fn edge(&self, source: StateId, symbol: Symbol) -> Option<&EdgePath> {
        self.layout.edges.get(*self.edges.get(&(source, symbol))?)
    }
}

fn rect(node: &NodeBox) -> Rect {
    let (half_width, half_height) = (node.width / 2.0, node.height / 2.0);
    Rect {
        left: node.x - half_width,
        top: node.y - half_height,
        right: node.x + half_width,
        bottom: node.y + half_height,
    }
}

/// The layout that is largest when all of it is shown in a frame of this width and height; none before they are known.
fn best_fit(layouts: &[Arc<Layout>], (width, height): (f64, f64)) -> Option<Arc<Layout>> {
    if width <= 0.0 || height <= 0.0 {
        return None;
    }
    let scale = |layout: &Layout| (width / layout.width.max(1.0)).min(height / layout.height.max(1.0));
    let (first, others) = layouts.split_first()?;
    let larger = |best: Arc<Layout>, other: &Arc<Layout>| {
        if scale(other) > scale(&best) { Arc::clone(other) } else { best }
    };
    Some(others.iter().fold(Arc::clone(first), larger))
}
