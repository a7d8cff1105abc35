//! The automaton as a graph. Every state and transition is an element of its own, which stays while edits come and go.

mod canvas;
mod frame;
mod gesture;
mod handles;
mod live;
mod minimap;
pub(crate) mod paths;
mod state;
mod transition;
mod view_part;

use leptos::prelude::*;

use crate::page::model::{Selection, Tab, Viewport};
use crate::page::update::{Action, App};

pub(crate) use super::viewport::{ZOOM_STEP, fit, show, zoom};

/// The graph in its frame.
pub(crate) fn graph(app: App) -> impl IntoView {
    let transform = move || {
        let Viewport { scale, x, y } =
            app.model.viewport.get().unwrap_or(Viewport { scale: 1.0, x: 0.0, y: 0.0 });
        format!("translate({x:.2} {y:.2}) scale({scale:.4})")
    };
    let part = view_part::view_part(app);
    let start = move || {
        let picture = app.derived.picture.get()?;
        let start = picture.layout.start.as_ref()?;
        let (shaft, head) = (paths::start(start), paths::head(&start.arrow));
        Some(
            view! { <g class="start-mark"><path class="shaft" stroke-width="1.5" d=shaft /><path class="head" d=head /></g> },
        )
    };
    let content = view! {
        <g transform=transform class:dragging=move || app.model.moving.with(|moving| !moving.is_empty())>
            {start}
            <For
                each=move || part.with(|part| part.transitions.clone())
                key=|transition| *transition
                children=move |(source, symbol)| transition::transition(app, source, symbol)
            />
            {handles::ghosts(app)}
            <For each=move || part.with(|part| part.states.clone()) key=|id| *id children=move |id| state::state(app, id) />
            {handles::handles(app)}
        </g>
        {handles::marquee(app)}
    };
    view! {
        {frame::frame(app, part, content)}
    }
}

/// Whether `item` is selected.
fn is_selected(app: App, item: Selection) -> bool {
    app.model.selection.with(|selection| selection.contains(&item))
}

/// A click or Enter: selects, or adds to the selection, or takes a step of a walk.
fn pick(app: App, item: Selection, more: bool) {
    let walking = app.model.simulation.with_untracked(|walk| walk.on)
        && app.model.tab.get_untracked() == Tab::Run
        && !app.derived.watched.monitoring.get_untracked();
    match item {
        Selection::Transition(source, symbol) if walking => {
            if app.derived.present.get_untracked() == Some(source) {
                app.act(Action::Step(symbol));
            }
        }
        _ if more => app.act(Action::ToggleSelected(item)),
        _ => app.act(Action::Select(Some(item))),
    }
}
