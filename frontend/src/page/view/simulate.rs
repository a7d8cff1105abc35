//! Trying the automaton without a robot: walking through it, drawing words from it, and what an outage costs.

use std::collections::BTreeMap;

use goalgraph::language::WordDistribution;
use goalgraph::layout::drawing::probability_text;
use goalgraph::outage::success;
use goalgraph::pdfa::{Symbol, Word};
use goalgraph::sampling::sample_words;
use goalgraph::specification::Specification;
use leptos::prelude::*;

use super::chips::{button, chip};
use super::words::word;
use crate::page::derived::ways;
use crate::page::text::count;
use crate::page::update::{Action, App};

/// The walk: where it is, what is possible, what was done.
pub(crate) fn walk(app: App) -> impl IntoView {
    let on = Memo::new(move |_| app.model.simulation.with(|walk| walk.on));
    move || {
        if !on.get() {
            return view! { <div class="walk row">{button(app, "simulate")}</div> }.into_any();
        }
        view! {
            <section class="walk" aria-label="Walk">
                <header class="section-head">
                    <h2>"Simulation" {move || app.derived.present.get().map(|state| format!(" in {state}"))}</h2>
                    <div class="row">{button(app, "walk-restart")} {button(app, "walk-end")}</div>
                </header>
                {move || log(app)}
                <div class="row enabled" role="group" aria-label="Possible now">{move || possible(app)}</div>
            </section>
        }
        .into_any()
    }
}

/// What was done; every step can be gone back to.
fn log(app: App) -> impl IntoView {
    let done = app.model.simulation.with(|walk| walk.word.clone());
    let taken = app.derived.specification.with(|it| it.as_ref().map_or(0, |it| ways(&it.pdfa, &done).len()));
    let step = |(index, symbol): (usize, &Symbol)| {
        view! {
            <li>
                <button type="button" class="chip-button" title="Go back to before this step" on:click=move |_| app.act(Action::StepBack(index))>
                    {chip(app, *symbol)}
                </button>
            </li>
        }
    };
    view! { <ol class="word" aria-label="Steps so far">{done[..taken].iter().enumerate().map(step).collect_view()}</ol> }
}

/// What can be done now.
fn possible(app: App) -> Option<impl IntoView> {
    let (specification, state) = (app.derived.specification.get()?, app.derived.present.get()?);
    let probabilities = app.derived.probabilities.get()?;
    let here = specification.pdfa.states.get(&state)?;
    let step = |&symbol: &Symbol| {
        let off = move || app.model.unavailable.with(|unavailable| unavailable.contains(&symbol));
        let chance = probability_text(probabilities.transition(state, symbol));
        view! {
            <button type="button" class="button step-button" disabled=off on:click=move |_| app.act(Action::Step(symbol))>
                {chip(app, symbol)} <span class="hint">{chance}</span>
            </button>
        }
    };
    let end = here.accepting.then(|| {
        let chance = probability_text(probabilities.end(state));
        view! { <span class="fits">{format!("The task may end here, {chance}")}</span> }
    });
    let stuck = (here.transitions.is_empty() && !here.accepting)
        .then(|| view! { <span class="deviates">"A dead end."</span> });
    Some(view! { {here.transitions.keys().map(step).collect_view()} {end} {stuck} })
}

/// What is left with what is available, from where the walk is.
pub(crate) fn prospects(app: App) -> impl IntoView {
    move || {
        let (specification, probabilities) =
            (app.derived.specification.get()?, app.derived.probabilities.get()?);
        let unavailable = app.model.unavailable.get();
        let from = app.derived.present.get().unwrap_or(specification.pdfa.initial);
        let success = success(&specification.pdfa, &probabilities, from, &unavailable);
        let stranded: Vec<String> = success.stranded.iter().map(ToString::to_string).collect();
        let stranded = match stranded.len() {
            0 => "none".to_owned(),
            _ => stranded.join(", "),
        };
        Some(view! {
            <h3>"Prospects from " {from.to_string()}</h3>
            <dl class="facts prospects">
                <div title="A run that chooses among what is available, in proportion to the probabilities, reaches an accepting end with this probability. Exact."><dt>"Success"</dt><dd>{probability_text(success.walk)}</dd></div>
                <div title="This share of the words, as they were learned and corrected, needs nothing that is switched off. Exact."><dt>"Words not affected"</dt><dd>{probability_text(success.words)}</dd></div>
                <div title="States that can be reached, but from which the task cannot be finished with what is available."><dt>"Stranded states"</dt><dd>{stranded}</dd></div>
            </dl>
        })
    }
}

/// How many words are drawn.
const SAMPLES: usize = 20;
/// Longer words are not drawn to their end.
const LONGEST: usize = 200;

/// Words drawn from the automaton with a seed.
pub(crate) fn samples(app: App) -> impl IntoView {
    let seed = move || app.model.simulation.with(|walk| walk.seed);
    let change = move |event: web_sys::Event| match event_target_value(&event).trim().parse() {
        Ok(seed) => app.act(Action::Seed(seed)),
        Err(_) => app.say_expected("the seed", "a whole number from 0", &event_target_value(&event)),
    };
    let words = move || {
        let specification = app.derived.specification.get()?;
        Some(
            drawn(&specification, seed())
                .into_iter()
                .map(|(drawn, times)| row(app, &drawn, times))
                .collect_view(),
        )
    };
    view! {
        <h3>"Sample words"</h3>
        <div class="seed">
            <label class="field">
                <span>"Seed"</span>
                <input type="text" inputmode="numeric" prop:value=move || seed().to_string() on:change=change />
            </label>
            <button type="button" class="button" on:click=move |_| app.act(Action::Seed(seed().wrapping_add(1)))>"Next seed"</button>
        </div>
        <ul class="samples-drawn">{words}</ul>
    }
}

/// The words drawn, most frequent first.
fn drawn(specification: &Specification, seed: u64) -> Vec<(Word, usize)> {
    let mut times: BTreeMap<Word, usize> = BTreeMap::new();
    for word in sample_words(&WordDistribution::of(&specification.pdfa), seed, SAMPLES, LONGEST) {
        *times.entry(word).or_default() += 1;
    }
    let mut words: Vec<(Word, usize)> = times.into_iter().collect();
    words.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
    words
}

fn row(app: App, drawn: &Word, times: usize) -> impl IntoView + use<> {
    let light = drawn.clone();
    view! {
        <li>
            <button type="button" class="entry" title="Light up its way" on:click=move |_| app.act(Action::Light(light.clone()))>
                {word(app, drawn)} <span class="hint">{count(times, "time")}</span>
            </button>
        </li>
    }
}
