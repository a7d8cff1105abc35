//! Trying the automaton without a robot: the plan for what is available, and a walk.

use goalgraph::layout::drawing::probability_text;
use goalgraph::pdfa::Symbol;
use goalgraph::plan::{NoPlan, Plan, Strategy};
use leptos::prelude::*;

use super::modes::modes;
use crate::page::update::{Action, App};
use crate::page::view::chips::{chip, nothing_yet};
use crate::page::view::words::word;
use crate::page::view::{filter, graph, simulate};

/// Availability, the plan, the walk.
pub(super) fn planning(app: App) -> impl IntoView {
    let there = Memo::new(move |_| app.derived.specification.with(Option::is_some));
    move || {
        if !there.get() {
            return view! {
                <div class="columns">
                    <section class="list" aria-label="Availability">{modes(app)}</section>
                    {nothing_yet(app, "There is nothing to plan yet. Open demonstrations, or load a sample.")}
                </div>
            }
            .into_any();
        }
        view! {
            <div class="columns simulating">
                {availability(app)}
                <section class="canvas" aria-label="Plan">
                    <div class="plan">{move || app.derived.plan.get().map(|plan| shown(app, plan))}</div>
                    {simulate::walk(app)}
                    {filter::hidden(app)}
                    {graph::graph(app)}
                </section>
                <aside class="inspector" aria-label="Simulation">
                    {strategy(app)}
                    {simulate::samples(app)}
                </aside>
            </div>
        }
        .into_any()
    }
}

fn availability(app: App) -> impl IntoView {
    let switches = move || {
        let specification = app.derived.specification.get()?;
        Some(
            specification
                .sub_goals
                .iter()
                .map(|sub_goal| switch(app, sub_goal.id, &sub_goal.name))
                .collect_view(),
        )
    };
    view! {
        <section class="list" aria-label="Availability">
            {modes(app)}
            <header class="section-head"><h2>"Availability"</h2></header>
            <p class="hint">"Switch off what the robot cannot do now. The plan changes at once."</p>
            <ul class="switches">{switches}</ul>
            {simulate::prospects(app)}
        </section>
    }
}

fn switch(app: App, symbol: Symbol, name: &str) -> impl IntoView + use<> {
    let available = move || app.model.unavailable.with(|unavailable| !unavailable.contains(&symbol));
    let name = format!("{name} available");
    view! {
        <li>
            <label class="switch">
                {chip(app, symbol)}
                <input
                    type="checkbox"
                    role="switch"
                    aria-label=name
                    prop:checked=available
                    on:change=move |event| app.act(Action::SetAvailable(symbol, event_target_checked(&event)))
                />
            </label>
        </li>
    }
}

fn shown(app: App, plan: Result<Plan, NoPlan>) -> impl IntoView {
    match plan {
        Ok(plan) => view! {
            <header class="section-head"><h2>"Plan"</h2> <span class="hint">{format!("probability {}", probability_text(plan.probability))}</span></header>
            {steps(app, &plan)}
        }
        .into_any(),
        Err(NoPlan::OutOfReach { from, meanwhile }) => view! {
            <header class="section-head"><h2>"No plan"</h2></header>
            <p>"No accepting state can be reached from " {from.to_string()} " with what is available. Meanwhile:"</p>
            {if meanwhile.word.is_empty() { view! { <p class="hint">"Nothing"</p> }.into_any() } else { word(app, &meanwhile.word).into_any() }}
        }
        .into_any(),
        Err(unknown) => view! { <p>{unknown.to_string()}</p> }.into_any(),
    }
}

fn steps(app: App, plan: &Plan) -> impl IntoView + use<> {
    let chances = app.derived.probabilities.get();
    let chance = |index: usize, symbol: Symbol| {
        chances.as_ref().map(|them| probability_text(them.transition(plan.states[index], symbol)))
    };
    let step = |(index, &symbol): (usize, &Symbol)| {
        let (from, to) = (plan.states[index].to_string(), plan.states[index + 1].to_string());
        view! {
            <li class="step">
                {chip(app, symbol)}
                <span class="hint">{from} " to " {to} ", " {chance(index, symbol)}</span>
            </li>
        }
    };
    let steps = plan.word.iter().enumerate().map(step).collect_view();
    if plan.word.is_empty() {
        return view! { <p class="hint">"Nothing to do: the initial state is accepting."</p> }.into_any();
    }
    view! { <ol class="steps" aria-label="Steps of the plan">{steps}</ol> }.into_any()
}

fn strategy(app: App) -> impl IntoView {
    let option = move |strategy: Strategy, name: &'static str, help: &'static str| {
        view! {
            <label class="option">
                <input
                    type="radio"
                    name="strategy"
                    prop:checked=move || app.model.strategy.get() == strategy
                    on:change=move |_| app.act(Action::ChooseStrategy(strategy))
                />
                <span><strong>{name}</strong> <span class="hint">{help}</span></span>
            </label>
        }
    };
    view! {
        <fieldset>
            <legend>"Strategy"</legend>
            {option(Strategy::Greedy, "Greedy", "In every state the most probable available transition.")}
            {option(Strategy::MostProbable, "Most probable", "The accepted word of highest probability as a whole.")}
        </fieldset>
    }
}
