//! What an edit would do, in words, before it is made.

use std::sync::Arc;

use goalgraph::language::WordSet;
use goalgraph::layout::drawing::probability_text;
use goalgraph::pdfa::Word;
use goalgraph::preview::Preview;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::HtmlElement;

use super::chips::button;
use crate::page::model::Draft;
use crate::page::text::{count, grouped, measure, significant};
use crate::page::update::{Action, App};
use crate::page::view::words::word;

/// The preview of the edit that is thought of, with its answer once it was begun.
pub(crate) fn draft(app: App) -> impl IntoView {
    lend_focus(app);
    move || {
        let Draft { label, begun, .. } = app.model.draft.get()?;
        let preview = app.derived.preview.get()?;
        let (possible, consequence) = match preview {
            Ok(preview) => (true, consequence(app, &preview).into_any()),
            Err(refusal) => (false, view! { <p class="refusal">{format!("{refusal}.")}</p> }.into_any()),
        };
        let answer = begun.then(|| {
            view! {
                <div class="row">
                    {possible.then(|| button(app, "apply"))}
                    {button(app, "cancel-edit")}
                </div>
            }
        });
        Some(view! {
            <section class="draft" class:begun=begun aria-label="Preview" aria-live="polite">
                <header class="section-head"><h2 dir="auto">{label}</h2> {answer}</header>
                {consequence}
            </section>
        })
    }
}

/// While an edit that was begun with a button waits for its answer, Enter gives it; then the focus goes back.
fn lend_focus(app: App) {
    let lender = StoredValue::new_local(None::<HtmlElement>);
    Effect::new(move |before: Option<bool>| {
        let begun = app.model.draft.with(|draft| draft.as_ref().is_some_and(|it| it.begun));
        if begun != before.unwrap_or(false) {
            request_animation_frame(move || if begun { take_focus(lender) } else { give_back(app, lender) });
        }
        begun
    });
}

fn take_focus(lender: StoredValue<Option<HtmlElement>, LocalStorage>) {
    let active = document().active_element().and_then(|active| active.dyn_into::<HtmlElement>().ok());
    let by_button = active.filter(|active| ["BUTTON", "SELECT"].contains(&active.tag_name().as_str()));
    let apply = document().query_selector(".draft button").ok().flatten();
    if let (Some(active), Some(apply)) = (by_button, apply.and_then(|it| it.dyn_into::<HtmlElement>().ok())) {
        lender.set_value(Some(active));
        // An element of this page always takes the focus.
        let _ = apply.focus();
    }
}

fn give_back(app: App, lender: StoredValue<Option<HtmlElement>, LocalStorage>) {
    let lent = lender.try_update_value(Option::take).flatten().filter(|lender| lender.is_connected());
    let nowhere = document().active_element().is_none_or(|active| active.tag_name() == "BODY");
    if let Some(lender) = lent.filter(|_| nowhere) {
        let _ = lender.focus();
        // The focus comes back to where the edit was begun: that is no new thought.
        app.act(Action::ConsiderNoMore);
    }
}

/// The consequence in words.
fn consequence(app: App, preview: &Arc<Preview>) -> impl IntoView + use<> {
    let effect = &preview.effect;
    let (before, after) = preview.log_likelihood;
    let likelihood = before.zip(after).map(|(before, after)| {
        let change = after - before;
        let sign = if change < 0.0 { "−" } else { "+" };
        fact(
            "Log-likelihood",
            format!("{} → {} ({sign}{})", significant(before), significant(after), significant(change.abs())),
        )
    });
    let divergence = fact("KL divergence from now", measure(preview.distance.kl_divergence));
    view! {
        <div class="consequence">
            <dl class="facts">{structure(preview)} {likelihood} {divergence}</dl>
            {words(app, "Newly accepted", "gained", &effect.gained)}
            {words(app, "No longer accepted", "lost", &effect.lost)}
            {demonstrations(app, "Demonstrations no longer accepted", &preview.lost_demonstrations)}
            {demonstrations(app, "Demonstrations accepted again", &preview.gained_demonstrations)}
        </div>
    }
}

fn fact(name: &'static str, value: String) -> impl IntoView {
    view! { <div><dt>{name}</dt><dd>{value}</dd></div> }
}

/// What becomes of the states.
fn structure(preview: &Preview) -> impl IntoView + use<> {
    let folded = preview.folded.iter().map(|(gone, into)| format!("{gone} into {into}"));
    let folded = listed(folded.collect());
    let removed = listed(preview.removed.iter().map(ToString::to_string).collect());
    let added = listed(preview.added.iter().map(ToString::to_string).collect());
    view! {
        {folded.map(|text| fact("Folds", text))}
        {removed.map(|text| fact("Removes", text))}
        {added.map(|text| fact("Adds", text))}
    }
}

/// Up to eight of `items`, and how many more there are; none for none.
fn listed(items: Vec<String>) -> Option<String> {
    const SHOWN: usize = 8;
    let more = items.len().saturating_sub(SHOWN);
    let shown = items.into_iter().take(SHOWN).collect::<Vec<_>>().join(", ");
    let more = if more > 0 { format!(" and {} more", grouped(more)) } else { String::new() };
    (!shown.is_empty()).then(|| shown + &more)
}

/// How many words are shown at most.
const EXAMPLES: usize = 4;

/// Words that an edit brings or takes, with their probability and the shortest ones.
fn words(app: App, heading: &'static str, class: &'static str, set: &WordSet) -> impl IntoView + use<> {
    let number = match set.number {
        Some(0) => return view! { <p class="hint">{format!("{heading}: nothing")}</p> }.into_any(),
        Some(number) => count(usize::try_from(number).unwrap_or(usize::MAX), "word"),
        None => "infinitely many words".to_owned(),
    };
    let mass = format!("probability {}", probability_text(set.mass));
    let row = |(example, probability): &(Word, f64)| {
        view! { <li>{word(app, example)} <span class="hint">{probability_text(*probability)}</span></li> }
    };
    let examples = set.examples.iter().take(EXAMPLES).map(row).collect_view();
    view! {
        <div class=format!("language {class}")>
            <h3>{format!("{heading}: {number} ")} <span class="hint">{mass}</span></h3>
            <ul class="examples">{examples}</ul>
        </div>
    }
    .into_any()
}

fn demonstrations(app: App, heading: &'static str, indices: &[usize]) -> impl IntoView + use<> {
    let names = app.derived.specification.with(|specification| {
        let name = |index: &usize| Some(specification.as_ref()?.demonstrations.get(*index)?.name.clone());
        indices.iter().filter_map(name).collect::<Vec<_>>()
    });
    listed(names).map(|text| view! { <p class="demonstrations-changed"><strong>{format!("{heading} ({}): ", indices.len())}</strong> {text}</p> })
}
