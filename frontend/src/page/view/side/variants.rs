//! The distinct words: their shares, how they fare, their ways; and words to add or forbid.

use goalgraph::conformance::Conformance;
use goalgraph::edit::Edit;
use goalgraph::pdfa::{Symbol, Word};
use leptos::prelude::*;

use super::fit::fit;
use crate::page::derived::Variant;
use crate::page::text::{count, percent};
use crate::page::update::{Action, App};
use crate::page::view::chips::{chip, edit_button};
use crate::page::view::filter::filter;
use crate::page::view::words::word;

/// The list of distinct words.
pub(super) fn variants(app: App) -> impl IntoView {
    let whole = move || app.derived.fit.get().demonstrations;
    view! {
        {fit(app)}
        {filter(app)}
        <header class="section-head">
            <h2>"Variants"</h2>
            <span class="hint">{move || count(app.derived.variants.with(Vec::len), "distinct word")}</span>
        </header>
        <ol class="variants">
            <For
                each=move || app.derived.variants.get()
                key=move |variant| format!("{variant:?} {}", whole())
                children=move |variant| row(app, &variant, whole())
            />
        </ol>
        {compose(app)}
    }
}

fn row(app: App, variant: &Variant, whole: usize) -> impl IntoView + use<> {
    let number = variant.demonstrations.len();
    let (lit, light) = (variant.word.clone(), variant.word.clone());
    let is_lit = move || app.model.lit.with(|them| them.contains(&lit)).to_string();
    let coverage = format!("{} cumulative", percent(variant.cumulative, whole));
    let verdict = verdict(app, variant.conformance);
    let fits = matches!(variant.conformance, Conformance::Accepted { .. });
    let (target, label) = (variant.word.clone(), if fits { "Forbid" } else { "Add" });
    let edit = move || {
        let (word, first_new) = (target.clone(), app.next_state());
        vec![if fits { Edit::ForbidWord { word, first_new } } else { Edit::AddWord { word, first_new } }]
    };
    view! {
        <li class="variant" data-fits=fits.to_string()>
            <button
                type="button"
                class="variant-button"
                title=variant.demonstrations.join(", ")
                aria-pressed=is_lit
                on:click=move |_| app.act(Action::Light(light.clone()))
            >
                <span class="variant-head">
                    <strong>{percent(number, whole)}</strong>
                    <span class="hint">{format!("{number} of {whole}")}</span>
                    <progress class="share" aria-hidden="true" max=whole.to_string() value=number.to_string()></progress>
                </span>
                {word(app, &variant.word)}
                <span class="hint coverage">{coverage}</span>
            </button>
            <div class="row">{verdict} {edit_button(app, label, edit)}</div>
        </li>
    }
}

/// How a word fares, and where it deviates.
fn verdict(app: App, conformance: Conformance) -> impl IntoView {
    match conformance {
        Conformance::Accepted { log_likelihood } => {
            let sentence = format!(
                "fits, probability {}",
                goalgraph::layout::drawing::probability_text(log_likelihood.exp())
            );
            view! { <span class="fits">{sentence}</span> }.into_any()
        }
        Conformance::Deviates { position, state } => {
            let go = move |_| app.act(Action::Select(Some(crate::page::model::Selection::State(state))));
            view! {
                <span class="deviates">{format!("deviates at position {} in ", position + 1)} <button type="button" class="link" on:click=go>{state.to_string()}</button></span>
            }
            .into_any()
        }
        Conformance::EndsEarly { state } => {
            let go = move |_| app.act(Action::Select(Some(crate::page::model::Selection::State(state))));
            view! {
                <span class="deviates">"ends early in " <button type="button" class="link" on:click=go>{state.to_string()}</button></span>
            }
            .into_any()
        }
    }
}

/// A word that is put together by hand, to be added or forbidden.
fn compose(app: App) -> impl IntoView {
    let composed = RwSignal::new(Word::new());
    let options = move || {
        let specification = app.derived.specification.get();
        let sub_goals = specification.map(|it| it.sub_goals.clone()).unwrap_or_default();
        sub_goals
            .into_iter()
            .map(|it| view! { <option value=it.id.to_string()>{it.name}</option> })
            .collect_view()
    };
    let push = move |event: web_sys::Event| {
        if let Ok(symbol) = event_target_value(&event).parse::<Symbol>() {
            composed.update(|word| word.push(symbol));
        }
        event_target::<web_sys::HtmlSelectElement>(&event).set_value("");
    };
    let back = move |_| {
        composed.update(|word| {
            word.pop();
        });
    };
    let edit = move |add: bool| {
        move || {
            let (word, first_new) = (composed.get_untracked(), app.next_state());
            vec![if add { Edit::AddWord { word, first_new } } else { Edit::ForbidWord { word, first_new } }]
        }
    };
    let chips = move || {
        composed.get().into_iter().map(|symbol| view! { <li>{chip(app, symbol)}</li> }).collect_view()
    };
    view! {
        <section class="compose" aria-label="Another word">
            <h3>"Another word"</h3>
            <ol class="word">{chips}</ol>
            <div class="row">
                <label class="field grow">
                    <span class="visually-hidden">"Next sub-goal"</span>
                    <select on:change=push><option value="">"Next sub-goal…"</option>{options}</select>
                </label>
                <button type="button" class="button" disabled=move || composed.with(Vec::is_empty) on:click=back>"Back"</button>
            </div>
            <div class="row">{edit_button(app, "Add", edit(true))} {edit_button(app, "Forbid", edit(false))}</div>
        </section>
    }
}
