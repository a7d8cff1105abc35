//! A state: what is completed, who passed, what may happen next and how probable that is.

use goalgraph::edit::{Edit, Outcome};
use goalgraph::evidence::{Passage, passages_of_state};
use goalgraph::layout::drawing::words_through;
use goalgraph::pdfa::{StateId, Symbol};
use leptos::prelude::*;

use super::evidence::{Pass, passages};
use super::fact;
use super::name::name_field;
use super::weights::{outcomes, reset};
use crate::page::update::{Action, App};
use crate::page::view::chips::{button, chip};

/// The inspector of a state.
pub(super) fn state(app: App, id: StateId) -> impl IntoView {
    let there =
        Memo::new(move |_| app.derived.specification.with(|it| it.as_ref()?.pdfa.states.get(&id).cloned()));
    let name = move || there.with(|state| state.as_ref().and_then(|it| it.name.clone()).unwrap_or_default());
    let rename = move |name: String| app.act(Action::Edit(None, vec![Edit::RenameState { state: id, name }]));
    let accepting = move || there.with(|state| state.as_ref().is_some_and(|it| it.accepting));
    let accept = move |event: web_sys::Event| {
        let wanted = event_target_checked(&event);
        // It shows what is; the preview shows what would be.
        event_target::<web_sys::HtmlInputElement>(&event).set_checked(untrack(accepting));
        app.act(Action::Begin(vec![Edit::SetAccepting { state: id, accepting: wanted }]));
    };
    let through = move || there.with(|state| state.as_ref().map(|it| words_through(it).to_string()));
    let ended = move || there.with(|state| state.as_ref().map(|it| it.end_count.to_string()));
    let completed = move || {
        let completed: Vec<Symbol> =
            there.with(|it| it.iter().flat_map(|it| it.completed.iter().copied()).collect());
        if completed.is_empty() {
            return view! { <p class="hint">"Nothing yet"</p> }.into_any();
        }
        let chips = completed.into_iter().map(|symbol| view! { <li>{chip(app, symbol)}</li> }).collect_view();
        view! { <ul class="word">{chips}</ul> }.into_any()
    };
    view! {
        <h2>"State " {id.to_string()}</h2>
        {name_field("Name", name, rename)}
        <dl class="facts">
            {fact("Words through it", through)}
            {fact("Words that end here", ended)}
        </dl>
        <label class="check">
            <input type="checkbox" prop:checked=accepting on:change=accept />
            <span>"Accepting: the task may end here"</span>
        </label>
        <h3>"Completed"</h3>
        {completed}
        <h3>"What may happen next"</h3>
        {outcomes(app, id)}
        <div class="row">{reset(app, id)}</div>
        {add_transition(app, id)}
        <h3>"Remove"</h3>
        <div class="row">{button(app, "prune")} {button(app, "heal")} {button(app, "unpin")}</div>
        {move || {
            let specification = app.derived.specification.get()?;
            let pass = |Passage { demonstration, position }| Pass { demonstration, symbol: position.checked_sub(1) };
            let found: Vec<Pass> = passages_of_state(&specification, id).into_iter().map(pass).collect();
            Some(passages(app, &specification, &found))
        }}
    }
}

/// A new transition, by keyboard or pointer.
fn add_transition(app: App, source: StateId) -> impl IntoView {
    let (symbol, target) = (RwSignal::new(None::<Symbol>), RwSignal::new(None::<StateId>));
    let free = move || {
        let specification = app.derived.specification.get()?;
        let taken = |symbol: Symbol| specification.pdfa.transition(source, symbol).is_some();
        let free = specification.sub_goals.iter().filter(|it| !taken(it.id));
        Some(
            free.map(|it| view! { <option value=it.id.to_string()>{it.name.clone()}</option> })
                .collect_view(),
        )
    };
    let states = move || {
        let specification = app.derived.specification.get()?;
        let ids: Vec<String> = specification.pdfa.states.keys().map(ToString::to_string).collect();
        Some(
            ids.into_iter().map(|id| view! { <option value=id.clone()>{id.clone()}</option> }).collect_view(),
        )
    };
    let add = move |_| {
        if let (Some(symbol), Some(target)) = (symbol.get_untracked(), target.get_untracked()) {
            app.act(Action::Begin(vec![Edit::AddTransition { source, symbol, target }]));
        }
    };
    view! {
        <details class="add">
            <summary>"Add a transition"</summary>
            <div class="field-pair">
                <label class="field">
                    <span>"Sub-goal"</span>
                    <select on:change=move |event| symbol.set(event_target_value(&event).parse().ok())><option value="">"…"</option>{free}</select>
                </label>
                <label class="field">
                    <span>"To"</span>
                    <select on:change=move |event| target.set(event_target_value(&event).parse().ok())><option value="">"…"</option>{states}</select>
                </label>
            </div>
            <button type="button" class="button" disabled=move || symbol.get().is_none() || target.get().is_none() on:click=add>"Add transition"</button>
        </details>
    }
}

/// The name of an outcome, to go to where it is a transition.
pub(super) fn outcome_name(app: App, state: StateId, outcome: Outcome) -> impl IntoView {
    match outcome {
        Outcome::End => view! { <span class="tag">"ends here"</span> }.into_any(),
        Outcome::Transition(symbol) => {
            let item = crate::page::model::Selection::Transition(state, symbol);
            view! {
                <button type="button" class="chip-button" title="Go to the transition" on:click=move |_| app.act(Action::Select(Some(item)))>
                    {move || chip(app, symbol)}
                </button>
            }
            .into_any()
        }
    }
}
