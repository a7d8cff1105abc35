//! Which states and transitions are drawn one by one.
//!
//! A small automaton is drawn whole. Of a large one only what the frame shows has elements, and only while that is not
//! too much; the rest is painted (see `canvas`).

use std::collections::BTreeSet;

use goalgraph::layout::{EdgePath, Rect};
use goalgraph::pdfa::{StateId, Symbol};
use leptos::prelude::*;

use crate::page::derived::Picture;
use crate::page::model::Selection;
use crate::page::update::App;

/// Up to so many states and transitions all of them are drawn one by one.
const SMALL: usize = 1500;
/// So many in the frame are drawn one by one at most.
const MANY: usize = 700;
/// Below this scale nobody reads what is in a box.
const LEGIBLE: f64 = 0.3;

/// What is drawn one by one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ViewPart {
    /// The states.
    pub(super) states: Vec<StateId>,
    /// The transitions.
    pub(super) transitions: Vec<(StateId, Symbol)>,
    /// Whether there is more, which is painted.
    pub(super) painted: bool,
}

/// What is drawn one by one at present.
pub(super) fn view_part(app: App) -> Memo<ViewPart> {
    Memo::new(move |_| {
        let Some(picture) = app.derived.picture.get() else { return ViewPart::default() };
        app.derived.residue.with(|residue| {
            let whole = ViewPart {
                states: picture
                    .states()
                    .map(|(id, _)| id)
                    .filter(|id| !residue.states.contains(id))
                    .collect(),
                transitions: names(&picture).filter(|name| !residue.transitions.contains(name)).collect(),
                painted: false,
            };
            if whole.states.len() + whole.transitions.len() <= SMALL {
                whole
            } else {
                in_frame(app, &picture, &whole)
            }
        })
    })
}

fn names(picture: &Picture) -> impl Iterator<Item = (StateId, Symbol)> {
    picture.layout.edges.iter().map(|edge| (edge.source, edge.symbol))
}

/// What the frame shows of a large automaton; from afar only what is selected.
fn in_frame(app: App, picture: &Picture, whole: &ViewPart) -> ViewPart {
    let part = shown_part(app, picture, whole);
    if let Some(part) = part.filter(|part| part.states.len() + part.transitions.len() <= MANY) {
        return part;
    }
    let selected: BTreeSet<Selection> = app.model.selection.get().into_iter().collect();
    ViewPart {
        states: whole.states.iter().copied().filter(|&id| selected.contains(&Selection::State(id))).collect(),
        transitions: whole
            .transitions
            .iter()
            .copied()
            .filter(|&(source, symbol)| selected.contains(&Selection::Transition(source, symbol)))
            .collect(),
        painted: true,
    }
}

fn shown_part(app: App, picture: &Picture, whole: &ViewPart) -> Option<ViewPart> {
    let viewport = app.model.viewport.get().filter(|viewport| viewport.scale >= LEGIBLE)?;
    let shown = viewport.shown(app.model.frame.get());
    let state_shown = |id: &StateId| picture.node_rect(*id).is_some_and(|rect| touch(&rect, &shown));
    let transition_shown = |(source, symbol): &(StateId, Symbol)| {
        picture.edge(*source, *symbol).is_some_and(|edge| touch(&around(edge), &shown))
    };
    Some(ViewPart {
        states: whole.states.iter().copied().filter(state_shown).collect(),
        transitions: whole.transitions.iter().copied().filter(transition_shown).collect(),
        painted: true,
    })
}

fn touch(a: &Rect, b: &Rect) -> bool {
    a.left <= b.right && b.left <= a.right && a.top <= b.bottom && b.top <= a.bottom
}

/// A rectangle that the whole arrow is in: curves stay within their control points.
fn around(edge: &EdgePath) -> Rect {
    let tip = edge.arrow.tip;
    let mut rect = Rect { left: tip.x, top: tip.y, right: tip.x, bottom: tip.y };
    for curve in &edge.path {
        for point in [curve.start, curve.control_1, curve.control_2, curve.end] {
            rect.left = rect.left.min(point.x);
            rect.top = rect.top.min(point.y);
            rect.right = rect.right.max(point.x);
            rect.bottom = rect.bottom.max(point.y);
        }
    }
    rect
}
