//! The automaton as a table: the same content as the graph.

use std::sync::Arc;

use goalgraph::layout::drawing::{probability_text, words_through};
use goalgraph::pdfa::{Probabilities, StateId, Symbol, Transition};
use goalgraph::specification::Specification;
use leptos::prelude::*;

use super::chips::chip;
use crate::page::model::Selection;
use crate::page::update::{Action, App};

/// States, then transitions.
pub(crate) fn table(app: App) -> impl IntoView {
    move || {
        let (specification, probabilities) =
            (app.derived.specification.get()?, app.derived.probabilities.get()?);
        let states =
            specification.pdfa.states.keys().map(|&id| state(app, &specification, &probabilities, id));
        let transitions = specification.pdfa.transitions();
        let transitions = transitions.map(|step| transition(app, &specification, &probabilities, step));
        Some(view! {
            <div class="tables">
                <table>
                    <caption>"States"</caption>
                    <thead><tr>
                        <th scope="col">"State"</th><th scope="col">"Completed"</th><th scope="col">"Accepting"</th>
                        <th scope="col">"Ended here"</th><th scope="col">"Final probability"</th>
                    </tr></thead>
                    <tbody>{states.collect_view()}</tbody>
                </table>
                <table>
                    <caption>"Transitions"</caption>
                    <thead><tr>
                        <th scope="col">"From"</th><th scope="col">"Sub-goal"</th><th scope="col">"To"</th>
                        <th scope="col">"Probability"</th><th scope="col">"Count"</th><th scope="col">"Weight"</th>
                    </tr></thead>
                    <tbody>{transitions.collect_view()}</tbody>
                </table>
            </div>
        })
    }
}

fn state(
    app: App,
    specification: &Arc<Specification>,
    probabilities: &Arc<Probabilities>,
    id: StateId,
) -> impl IntoView + use<> {
    let state = specification.pdfa.states.get(&id)?;
    let initial = (id == specification.pdfa.initial).then_some(" (initial)");
    let end = probability_text(probabilities.end(id));
    let ended = format!("{} of {}", state.end_count, words_through(state));
    let chips = state.completed.iter().map(|&symbol| view! { <li>{chip(app, symbol)}</li> }).collect_view();
    let selection = Selection::State(id);
    Some(view! {
        <tr class:selected=move || app.model.selection.with(|it| it.contains(&selection))>
            <th scope="row">{select_button(app, selection, id.to_string())} {initial}</th>
            <td><ul class="word">{chips}</ul></td>
            <td>{if state.accepting { "yes" } else { "no" }}</td>
            <td class="number">{ended}</td>
            <td class="number">{end}</td>
        </tr>
    })
}

fn transition(
    app: App,
    specification: &Arc<Specification>,
    probabilities: &Arc<Probabilities>,
    (source, symbol, transition): (StateId, Symbol, &Transition),
) -> impl IntoView + use<> {
    let total = specification.pdfa.states.get(&source).map_or(0, words_through);
    let selection = Selection::Transition(source, symbol);
    view! {
        <tr class:selected=move || app.model.selection.with(|it| it.contains(&selection))>
            <th scope="row">{select_button(app, selection, source.to_string())}</th>
            <td>{chip(app, symbol)}</td>
            <td>{transition.target.to_string()}</td>
            <td class="number">{probability_text(probabilities.transition(source, symbol))}</td>
            <td class="number">{format!("{} of {total}", transition.count)}</td>
            <td class="number">{transition.weight.to_string()}</td>
        </tr>
    }
}

fn select_button(app: App, selection: Selection, text: String) -> impl IntoView {
    view! { <button type="button" class="link" on:click=move |_| app.act(Action::Select(Some(selection)))>{text}</button> }
}
