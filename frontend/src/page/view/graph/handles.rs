//! What lies over the drawing for a moment: handles of what is selected, arrows that are being led, a rectangle.

use goalgraph::layout::Point;
use leptos::prelude::*;

use crate::page::model::{Gesture, Selection, Tab};
use crate::page::update::App;

/// How far a handle is from what it belongs to.
const HANDLE_GAP: f64 = 12.0;

/// Transitions that an edit would bring, and the arrow that a pointer leads.
pub(super) fn ghosts(app: App) -> impl IntoView {
    let coming = move || {
        let picture = app.derived.picture.get()?;
        let center = |id| picture.node(id).map(|node| Point::new(node.x, node.y));
        let lines = app.derived.marks.with(|marks| {
            let line = |&(source, _, target): &(_, _, _)| Some(line(center(source)?, center(target)?));
            marks.coming.iter().filter_map(line).collect::<Vec<_>>()
        });
        Some(lines.into_iter().map(|d| view! { <path class="ghost" d=d /> }).collect_view())
    };
    let led = move || {
        let Some(Gesture::Connect { source, to, .. }) = app.model.gesture.get() else { return None };
        let node = app.derived.picture.get()?.node(source).map(|node| Point::new(node.x, node.y))?;
        let to = app.model.viewport.get()?.in_drawing(to);
        Some(view! { <path class="ghost" d=line(node, to) /> })
    };
    view! { {coming} {led} }
}

fn line(from: Point, to: Point) -> String {
    format!("M{:.1} {:.1}L{:.1} {:.1}", from.x, from.y, to.x, to.y)
}

/// At a selected state a handle to draw a new transition; at a selected transition one to move its end.
pub(super) fn handles(app: App) -> impl IntoView {
    move || {
        if app.model.tab.get() != Tab::Automaton {
            return None;
        }
        let alone = app.model.selection.with(|selection| match selection.as_slice() {
            [item] => Some(*item),
            _ => None,
        })?;
        let picture = app.derived.picture.get()?;
        let (place, name, title, sign) = match alone {
            Selection::State(id) => {
                let rect = picture.node_rect(id)?;
                let place = Point::new(rect.right + HANDLE_GAP, f64::midpoint(rect.top, rect.bottom));
                (place, id.to_string(), "Drag to another state to add a transition", "+")
            }
            Selection::Transition(source, symbol) => {
                let edge = picture.edge(source, symbol)?;
                let title = "Drag to another state to move the end of the transition";
                (edge.arrow.base(), format!("{source} {symbol}"), title, "")
            }
        };
        Some(view! {
            <g class="handle" data-handle=name transform=format!("translate({:.1} {:.1})", place.x, place.y)>
                <title>{title}</title>
                <circle class="handle-hit" r="12" />
                <circle class="handle-mark" r="7" />
                <text>{sign}</text>
            </g>
        })
    }
}

/// The rectangle around what is to be selected.
pub(super) fn marquee(app: App) -> impl IntoView {
    move || {
        let Some(Gesture::Marquee { from, to }) = app.model.gesture.get() else { return None };
        let (x, y) = (from.x.min(to.x), from.y.min(to.y));
        let (width, height) = ((from.x - to.x).abs(), (from.y - to.y).abs());
        Some(view! {
            <rect
                class="marquee"
                x=format!("{x:.0}")
                y=format!("{y:.0}")
                width=format!("{width:.0}")
                height=format!("{height:.0}")
            />
        })
    }
}
