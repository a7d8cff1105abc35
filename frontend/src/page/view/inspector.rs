//! What is selected in the automaton, with the evidence behind every number. Nothing can be changed here yet.

use std::sync::Arc;

use goalgraph::layout::drawing::{probability_text, words_through};
use goalgraph::pdfa::{Pdfa, StateId, Symbol, Word};
use goalgraph::specification::Specification;
use leptos::prelude::*;

use super::chips::chip;
use super::graph::chance_of;
use crate::page::model::Selection;
use crate::page::text::{count, grouped};
use crate::page::update::{Action, App};

/// The column at the right of the Automaton tab.
pub(crate) fn inspector(app: App) -> impl IntoView {
    view! {
        <aside class="inspector" aria-label="Inspector">
            {move || {
                let specification = app.derived.specification.get()?;
                Some(match app.model.selection.get() {
                    None => overview(app, &specification).into_any(),
                    Some(Selection::State(id)) => state(app, &specification, id).into_any(),
                    Some(Selection::Transition(source, symbol)) => transition(app, &specification, source, symbol).into_any(),
                })
            }}
        </aside>
    }
}

fn overview(app: App, specification: &Arc<Specification>) -> impl IntoView + use<> {
    let legend = specification
        .sub_goals
        .iter()
        .map(|sub_goal| view! { <li>{chip(app, sub_goal.id)}</li> })
        .collect_view();
    let preferred = app.derived.preferred.get().map(|plan| {
        view! {
            <h3>"Preferred order"</h3>
            {super::words::word(app, &plan.word)}
            <dl class="facts">{fact("Probability", probability_text(plan.probability))}</dl>
        }
    });
    view! {
        <h2>"Automaton"</h2>
        <p class="hint">"Select a state or a transition to see the evidence behind its numbers."</p>
        {preferred}
        <h3>"Sub-goals"</h3>
        <ul class="legend">{legend}</ul>
        {problems(specification)}
    }
}

fn problems(specification: &Arc<Specification>) -> impl IntoView + use<> {
    let problems = specification.check();
    let items = problems.iter().map(|problem| view! { <li>{problem.message.clone()}</li> }).collect_view();
    (!problems.is_empty()).then(|| view! { <h3>"Problems"</h3><ul class="problems">{items}</ul> })
}

/// One line of a list of facts.
pub(crate) fn fact(name: &'static str, value: impl IntoView) -> impl IntoView {
    view! { <div><dt>{name}</dt><dd>{value}</dd></div> }
}

fn state(app: App, specification: &Arc<Specification>, id: StateId) -> impl IntoView + use<> {
    let state = specification.pdfa.states.get(&id)?;
    let end = app.derived.probabilities.with(|them| them.as_ref().map_or(0.0, |them| them.end(id)));
    let chips = state.completed.iter().map(|&symbol| view! { <li>{chip(app, symbol)}</li> }).collect_view();
    let out = state.transitions.keys().map(|&symbol| way(app, specification, id, symbol)).collect_view();
    let passing = passing(specification, &|pdfa, word| visited(pdfa, word).contains(&id));
    Some(view! {
        <h2>"State " {id.to_string()}</h2>
        <dl class="facts">
            {fact("Accepting", if state.accepting { "yes" } else { "no" })}
            {fact("Words through it", words_through(state).to_string())}
            {fact("Words that end here", state.end_count.to_string())}
            {fact("End weight", state.end_weight.to_string())}
            {fact("Final probability", probability_text(end))}
        </dl>
        <h3>"Completed"</h3>
        {if state.completed.is_empty() { view! { <p class="hint">"Nothing yet"</p> }.into_any() } else { view! { <ul class="legend">{chips}</ul> }.into_any() }}
        <h3>"Ways out"</h3>
        {if state.transitions.is_empty() { view! { <p class="hint">"None"</p> }.into_any() } else { view! { <ul class="ways">{out}</ul> }.into_any() }}
        {passing}
    })
}

/// A transition in a list, to go to.
fn way(
    app: App,
    specification: &Arc<Specification>,
    source: StateId,
    symbol: Symbol,
) -> impl IntoView + use<> {
    let target = specification.pdfa.transition(source, symbol).map(|way| way.target.to_string());
    view! {
        <li>
            <button type="button" class="entry" on:click=move |_| app.act(Action::Select(Some(Selection::Transition(source, symbol))))>
                {chip(app, symbol)} <span class="hint">"to " {target}</span> <span class="number">{chance_of(app, source, symbol)}</span>
            </button>
        </li>
    }
}

fn transition(
    app: App,
    specification: &Arc<Specification>,
    source: StateId,
    symbol: Symbol,
) -> impl IntoView + use<> {
    let transition = specification.pdfa.transition(source, symbol)?;
    let total = specification.pdfa.states.get(&source).map_or(0, words_through);
    let target = transition.target;
    let took = |pdfa: &Pdfa, word: &Word| {
        visited(pdfa, word).iter().zip(word).any(|(&state, &step)| state == source && step == symbol)
    };
    Some(view! {
        <h2>{chip(app, symbol)}</h2>
        <dl class="facts">
            {fact("From", to_state(app, source))}
            {fact("To", to_state(app, target))}
            {fact("Probability", chance_of(app, source, symbol))}
            {fact("Count", format!("{} of {total}", transition.count))}
            {fact("Weight", transition.weight.to_string())}
        </dl>
        {passing(specification, &took)}
    })
}

fn to_state(app: App, id: StateId) -> impl IntoView {
    let go = move |_| app.act(Action::Select(Some(Selection::State(id))));
    view! { <button type="button" class="link" on:click=go>{id.to_string()}</button> }
}

/// The states that a word passes, the first one included.
fn visited(pdfa: &Pdfa, word: &Word) -> Vec<StateId> {
    let mut states = vec![pdfa.initial];
    for &symbol in word {
        let Some(transition) = pdfa.transition(states[states.len() - 1], symbol) else { break };
        states.push(transition.target);
    }
    states
}

/// How many names of demonstrations are listed at most.
const NAMES: usize = 100;

/// The demonstrations whose words do what `does` asks.
fn passing(specification: &Arc<Specification>, does: &dyn Fn(&Pdfa, &Word) -> bool) -> impl IntoView + use<> {
    let passes = |demonstration: &&goalgraph::specification::DemonstrationWord| {
        does(&specification.pdfa, &demonstration.word)
    };
    let names: Vec<String> =
        specification.demonstrations.iter().filter(passes).map(|it| it.name.clone()).collect();
    let heading = count(names.len(), "demonstration");
    let more = names.len().saturating_sub(NAMES);
    let more = (more > 0).then(|| view! { <li>{format!("and {} more", grouped(more))}</li> });
    let items = names.into_iter().take(NAMES).map(|name| view! { <li>{name}</li> }).collect_view();
    view! { <h3>{heading} " pass here"</h3><ul class="evidence-list">{items}{more}</ul> }
}
