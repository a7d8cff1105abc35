//! A transition: its ends, its probability with the evidence, who took it and when.

use goalgraph::edit::{Edit, Outcome};
use goalgraph::evidence::{Passage, passages_of_transition};
use goalgraph::pdfa::{StateId, Symbol};
use leptos::prelude::*;

use super::evidence::{Pass, passages};
use super::fact;
use super::weights::row;
use crate::page::text::decimals;
use crate::page::update::{Action, App};
use crate::page::view::chips::{button, chip, to_state};

/// The inspector of a transition.
pub(super) fn transition(app: App, source: StateId, symbol: Symbol) -> impl IntoView {
    let way = Memo::new(move |_| {
        app.derived.specification.with(|it| it.as_ref()?.pdfa.transition(source, symbol).cloned())
    });
    let target = Memo::new(move |_| way.with(|way| way.as_ref().map(|way| way.target)));
    view! {
        <h2>{move || chip(app, symbol)}</h2>
        <dl class="facts">
            {fact("From", to_state(app, source))}
            {fact("To", move || target.get().map(|target| to_state(app, target)))}
            {fact("Count", move || way.with(|way| way.as_ref().map(|way| way.count.to_string())))}
            {fact("Weight", move || way.with(|way| way.as_ref().map(|way| decimals(way.weight))))}
        </dl>
        <h3>"Probability"</h3>
        <ul class="outcomes">{row(app, source, Outcome::Transition(symbol))}</ul>
        {ends(app, source, symbol, target)}
        <h3>"Remove"</h3>
        <div class="row">{button(app, "prune")} {button(app, "heal")}</div>
        {move || {
            let specification = app.derived.specification.get()?;
            let pass = |Passage { demonstration, position }| Pass { demonstration, symbol: Some(position) };
            let found = passages_of_transition(&specification, source, symbol).into_iter().map(pass);
            Some(passages(app, &specification, &found.collect::<Vec<_>>()))
        }}
    }
}

/// The state that was chosen; the field shows what is again, for the preview shows what would be.
fn chosen(event: &web_sys::Event, present: Option<StateId>) -> Option<StateId> {
    let chosen = event_target_value(event).parse().ok();
    let present = present.map(|id| id.to_string()).unwrap_or_default();
    event_target::<web_sys::HtmlSelectElement>(event).set_value(&present);
    chosen
}

/// Fields to move either end.
fn ends(app: App, source: StateId, symbol: Symbol, target: Memo<Option<StateId>>) -> impl IntoView {
    let options = move |chosen: Option<StateId>| {
        let specification = app.derived.specification.get()?;
        let option = |id: &StateId| {
            view! { <option value=id.to_string() selected=Some(*id) == chosen>{id.to_string()}</option> }
        };
        Some(specification.pdfa.states.keys().map(option).collect_view())
    };
    let move_to = move |new_source: Option<StateId>, new_target: Option<StateId>| {
        if let (Some(new_source), Some(new_target)) = (new_source, new_target) {
            app.act(Action::Begin(vec![Edit::MoveTransition { source, symbol, new_source, new_target }]));
        }
    };
    view! {
        <div class="field-pair">
            <label class="field">
                <span>"Move start to"</span>
                <select on:change=move |event| move_to(chosen(&event, Some(source)), target.get_untracked())>{move || options(Some(source))}</select>
            </label>
            <label class="field">
                <span>"Move end to"</span>
                <select on:change=move |event| move_to(Some(source), chosen(&event, target.get_untracked()))>{move || options(target.get())}</select>
            </label>
        </div>
    }
}
