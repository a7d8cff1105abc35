//! A view without rare transitions, which says what it hides.

use leptos::prelude::*;

use crate::page::text::{count, percent};
use crate::page::update::{Action, App};

/// The slider, and what it hides.
pub(crate) fn filter(app: App) -> impl IntoView {
    let slide = move |event: web_sys::Event| {
        let percent: f64 = event_target_value(&event).parse().unwrap_or(0.0);
        app.act(Action::HideBelow(percent / 100.0));
    };
    let below = move || (app.model.hidden_below.get() * 100.0).round();
    view! {
        <label class="filter" title="Only the view: the specification stays as it is.">
            <span>{move || format!("Hide below {}%", below())}</span>
            <input type="range" min="0" max="50" step="1" aria-label="Hide transitions less probable than, in percent" prop:value=move || below().to_string() on:input=slide />
        </label>
    }
}

/// What the filter hides, wherever the graph is shown.
pub(crate) fn hidden(app: App) -> impl IntoView {
    let hidden = move || {
        app.derived.residue.with(|residue| {
            (!residue.transitions.is_empty()).then(|| {
                format!(
                    "{} and {} hidden, {} of demonstrations covered",
                    count(residue.transitions.len(), "transition"),
                    count(residue.states.len(), "state"),
                    percent(residue.covered, residue.demonstrations),
                )
            })
        })
    };
    move || hidden().map(|text| view! { <p class="hint residue-note" role="status">{text}</p> })
}
