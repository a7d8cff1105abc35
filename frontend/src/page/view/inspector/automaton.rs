//! The automaton as a whole: its preferred order, its sub-goals with names and colors, how weights are read.

use goalgraph::layout::drawing::probability_text;
use goalgraph::pdfa::Symbol;
use leptos::prelude::*;

use super::fact;
use super::sub_goal::sub_goal_editor;
use crate::page::update::App;
use crate::page::view::chips::{button, chip};
use crate::page::view::words::word;

/// What is shown while nothing is selected.
pub(super) fn automaton(app: App) -> impl IntoView {
    let preferred = move || {
        app.derived.preferred.get().map(|plan| {
            view! {
                <h3>"Preferred order"</h3>
                {word(app, &plan.word)}
                <dl class="facts">{fact("Probability", probability_text(plan.probability))}</dl>
            }
        })
    };
    let symbols = Memo::new(move |_| {
        let specification = app.derived.specification.get();
        specification
            .map(|it| it.sub_goals.iter().map(|sub_goal| sub_goal.id).collect::<Vec<_>>())
            .unwrap_or_default()
    });
    view! {
        <h2>"Automaton"</h2>
        <p class="hint">"Select a state or a transition to see the evidence behind its numbers, and to change it. Drag a state onto another one to merge them."</p>
        {preferred}
        <h3>"Sub-goals"</h3>
        <ul class="sub-goal-rows">
            <For each=move || symbols.get() key=|symbol| *symbol children=move |symbol| sub_goal(app, symbol) />
        </ul>
        <h3>"States"</h3>
        <div class="row">{button(app, "add-state")}</div>
    }
}

/// A sub-goal and what can be done with it.
fn sub_goal(app: App, symbol: Symbol) -> impl IntoView {
    view! {
        <li class="sub-goal-row" data-symbol=symbol.to_string()>
            <details>
                <summary>{move || chip(app, symbol)}</summary>
                {sub_goal_editor(app, symbol)}
            </details>
        </li>
    }
}
