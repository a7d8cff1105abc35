//! The distribution of a state: every outcome with its evidence, its probability to set, and a lock.

use std::collections::BTreeSet;

use goalgraph::edit::{Edit, Outcome};
use goalgraph::layout::drawing::words_through;
use goalgraph::pdfa::{Semantics, State, StateId, Symbol};
use leptos::html::Input;
use leptos::prelude::*;

use super::interval::{Evidence, band};
use super::state::outcome_name;
use crate::page::text::{decimals, is_expert};
use crate::page::update::{Action, App};
use crate::page::view::chips::edit_button;

/// The outcomes of a state.
pub(super) fn outcomes(app: App, id: StateId) -> impl IntoView {
    let list = Memo::new(move |_| state_of(app, id).map(|state| outcomes_of(&state)).unwrap_or_default());
    view! {
        {move || list.with(Vec::is_empty).then(|| view! { <p class="hint">"Nothing: it is a dead end."</p> })}
        <ul class="outcomes">
            <For each=move || list.get() key=|outcome| *outcome children=move |outcome| row(app, id, outcome) />
        </ul>
    }
}

fn state_of(app: App, id: StateId) -> Option<State> {
    app.derived.specification.with(|it| it.as_ref()?.pdfa.states.get(&id).cloned())
}

fn outcomes_of(state: &State) -> Vec<Outcome> {
    let ways = state.transitions.keys().map(|&symbol| Outcome::Transition(symbol));
    ways.chain(state.accepting.then_some(Outcome::End)).collect()
}

/// Count and weight of an outcome.
fn evidence(state: &State, outcome: Outcome) -> (u64, f64) {
    match outcome {
        Outcome::End => (state.end_count, state.end_weight),
        Outcome::Transition(symbol) => {
            state.transitions.get(&symbol).map_or((0, 0.0), |way| (way.count, way.weight))
        }
    }
}

/// One outcome of a state.
pub(super) fn row(app: App, id: StateId, outcome: Outcome) -> impl IntoView {
    let state = Memo::new(move |_| state_of(app, id));
    let numbers = move || {
        let state = state.get()?;
        let (count, weight) = evidence(&state, outcome);
        Some((count, words_through(&state), weight, outcomes_of(&state).len()))
    };
    let probability = Memo::new(move |_| probability(app, id, outcome));
    let locked = move || app.model.locked.with(|locked| locked.contains(&(id, outcome)));
    let fixed = move || outcome == Outcome::End && app.derived.semantics.get() == Semantics::Published;
    let label = move || match outcome {
        Outcome::End => format!("Probability that the task ends in {id}"),
        Outcome::Transition(symbol) => format!("Probability of {}", name_of(app, symbol)),
    };
    let evidence = move || {
        let (count, total, weight_now, outcomes) = numbers()?;
        let expert = is_expert(weight_now, count);
        Some(view! {
            <span class="hint">{format!("{count} of {total}")}</span>
            {expert.then(|| view! { <span class="tag expert" title="An expert has set this weight">{format!("weight {}", decimals(weight_now))}</span> })}
            {band(Evidence { count, total, outcomes, expert }, probability.get())}
        })
    };
    let lock = move |event: web_sys::Event| app.act(Action::Lock(id, outcome, event_target_checked(&event)));
    view! {
        <li class="outcome">
            <div class="outcome-head">
                {outcome_name(app, id, outcome)}
                {probability_field(app, id, outcome, probability, label, fixed)}
                <label class="lock" class:locked=locked title="Keep this probability while others are changed">
                    <input type="checkbox" aria-label=move || format!("Lock: {}", label()) prop:checked=locked on:change=lock />
                    {lock_picture()}
                </label>
            </div>
            <div class="outcome-evidence">{evidence}</div>
        </li>
    }
}

/// A lock; its bow is open or closed by the style sheet.
fn lock_picture() -> impl IntoView {
    view! {
        <svg width="16" height="16" viewBox="0 0 16 16" aria-hidden="true">
            <path class="lock-bow" d="M5 8V5.5a3 3 0 0 1 6 0V8" />
            <rect class="lock-body" x="3" y="8" width="10" height="6" rx="1.5" />
        </svg>
    }
}

fn name_of(app: App, symbol: Symbol) -> String {
    app.derived.specification.with(|it| it.as_ref().map(|it| it.name_of(symbol)).unwrap_or_default())
}

fn probability(app: App, id: StateId, outcome: Outcome) -> f64 {
    app.derived.probabilities.with(|them| {
        them.as_ref().map_or(0.0, |them| match outcome {
            Outcome::End => them.end(id),
            Outcome::Transition(symbol) => them.transition(id, symbol),
        })
    })
}

/// A field for a probability: while somebody types its consequence is shown, Enter makes it, Escape leaves it.
fn probability_field(
    app: App,
    id: StateId,
    outcome: Outcome,
    probability: Memo<f64>,
    label: impl Fn() -> String + Send + 'static,
    fixed: impl Fn() -> bool + Send + 'static,
) -> impl IntoView {
    let typing = RwSignal::new(false);
    let read = move |text: &str| -> Option<Vec<Edit>> {
        let probability: f64 = text.trim().replace(',', ".").parse().ok()?;
        Some(vec![Edit::Reweight { state: id, outcome, probability, locked: locked(app, id, outcome) }])
    };
    let typed = move |event: web_sys::Event| {
        typing.set(true);
        match read(&event_target_value(&event)) {
            Some(edits) => app.act(Action::Begin(edits)),
            None => app.act(Action::CancelDraft),
        }
    };
    let press = move |event: web_sys::KeyboardEvent| {
        let field = event_target::<web_sys::HtmlInputElement>(&event);
        match event.key().as_str() {
            "Enter" => {
                match Some(()).filter(|()| typing.get_untracked()).map(|()| read(&field.value())) {
                    // Nothing was typed, and what is there is rounded.
                    None => {}
                    Some(Some(edits)) => app.act(Action::Edit(None, edits)),
                    Some(None) => app.say_expected("the probability", "a number from 0 to 1", &field.value()),
                }
                typing.set(false);
                field.set_value(&decimals(probability.get_untracked()));
            }
            "Escape" => {
                app.act(Action::CancelDraft);
                typing.set(false);
                field.set_value(&decimals(probability.get_untracked()));
            }
            _ => return,
        }
        event.prevent_default();
        event.stop_propagation();
    };
    // What was typed waits in the preview, to be made or forgotten there; then the field shows what is.
    let left = move |_| typing.set(false);
    let node = NodeRef::<Input>::new();
    Effect::new(move |_| {
        let waits = app.model.draft.with(Option::is_some) || typing.get();
        let shown = decimals(probability.get());
        if let Some(field) = node.get().filter(|_| !waits) {
            field.set_value(&shown);
        }
    });
    view! {
        <input
            class="probability"
            type="text"
            inputmode="decimal"
            aria-label=label
            disabled=fixed
            node_ref=node
            on:input=typed
            on:keydown=press
            on:blur=left
        />
    }
}

/// What keeps its share while `outcome` is changed.
fn locked(app: App, id: StateId, outcome: Outcome) -> BTreeSet<Outcome> {
    app.model.locked.with_untracked(|locked| {
        let of_state = locked.iter().filter(|(state, other)| *state == id && *other != outcome);
        of_state.map(|(_, other)| *other).collect()
    })
}

/// A button that makes the weights of a state its counts again, where they are not.
pub(super) fn reset(app: App, id: StateId) -> impl IntoView {
    let changed = Memo::new(move |_| {
        state_of(app, id).is_some_and(|state| {
            let expert = |(count, weight): (u64, f64)| is_expert(weight, count);
            outcomes_of(&state).into_iter().any(|outcome| expert(evidence(&state, outcome)))
        })
    });
    move || {
        changed
            .get()
            .then(|| edit_button(app, "Reset to counts", move || vec![Edit::ResetWeights { state: id }]))
    }
}
