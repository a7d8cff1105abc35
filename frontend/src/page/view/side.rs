//! The lists beside the graph: variants, merges, problems, history.

mod fit;
mod history;
mod merges;
mod problems;
mod variants;

use leptos::prelude::*;
use web_sys::KeyboardEvent;

use super::chips::step_tabs;
use crate::page::model::Side;
use crate::page::update::{Action, App};

/// The column at the left of the Automaton tab.
pub(crate) fn side(app: App) -> impl IntoView {
    view! {
        <section class="list side" aria-label="Lists">
            <div class="side-tabs" role="tablist" aria-label="Lists" on:keydown=move |event| step(app, &event)>
                {Side::ALL.map(|side| tab(app, side)).collect_view()}
            </div>
            <div class="side-panel" role="tabpanel" id="side-panel" aria-labelledby=move || tab_id(app.model.side.get())>
                {move || match app.model.side.get() {
                    Side::Variants => variants::variants(app).into_any(),
                    Side::Merges => merges::merges(app).into_any(),
                    Side::Problems => problems::problems(app).into_any(),
                    Side::History => history::history(app).into_any(),
                }}
            </div>
        </section>
    }
}

fn tab_id(side: Side) -> String {
    format!("side-{}", side.name().to_lowercase())
}

fn tab(app: App, side: Side) -> impl IntoView {
    let selected = move || app.model.side.get() == side;
    let number = move || match side {
        Side::Problems => app.derived.problems.with(Vec::len),
        _ => 0,
    };
    view! {
        <button
            type="button"
            role="tab"
            id=tab_id(side)
            class="side-tab"
            aria-selected=move || selected().to_string()
            aria-controls="side-panel"
            tabindex=move || if selected() { "0" } else { "-1" }
            on:click=move |_| app.act(Action::ShowSide(side))
        >
            {side.name()}
            {move || (number() > 0).then(|| view! { " " <span class="badge">{number()}</span> })}
        </button>
    }
}

fn step(app: App, event: &KeyboardEvent) {
    let at = Side::ALL.iter().position(|side| *side == app.model.side.get_untracked()).unwrap_or(0);
    step_tabs(event, at, Side::ALL.len(), |next| {
        app.act(Action::ShowSide(Side::ALL[next]));
        tab_id(Side::ALL[next])
    });
}
