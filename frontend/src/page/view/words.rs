//! Words: the distinct ones with their shares, and one per demonstration.

use goalgraph::pdfa::Word;
use leptos::prelude::*;

use super::chips::chip;
use crate::page::derived::Variant;
use crate::page::text::{count, percent};
use crate::page::update::App;

/// The list of distinct words.
pub(crate) fn variants(app: App) -> impl IntoView {
    let whole = move || {
        let of = |specification: &std::sync::Arc<goalgraph::specification::Specification>| {
            specification.demonstrations.len()
        };
        app.derived.specification.with(|specification| specification.as_ref().map_or(0, of))
    };
    let rows = move || {
        let whole = whole();
        let rows = app.derived.variants.get().into_iter().map(|variant| row(app, &variant, whole));
        rows.collect_view()
    };
    view! {
        <section class="list" aria-label="Variants">
            <header class="section-head">
                <h2>"Variants"</h2>
                <span class="hint">{move || count(app.derived.variants.with(Vec::len), "distinct word")}</span>
            </header>
            <ol class="variants">{rows}</ol>
        </section>
    }
}

fn row(app: App, variant: &Variant, whole: usize) -> impl IntoView + use<> {
    let number = variant.demonstrations.len();
    view! {
        <li class="variant" title=variant.demonstrations.join(", ")>
            <div class="variant-head">
                <strong>{percent(number, whole)}</strong>
                <span class="hint">{format!("{number} of {whole}")}</span>
                <progress class="share" aria-hidden="true" max=whole.to_string() value=number.to_string()></progress>
            </div>
            {word(app, &variant.word)}
        </li>
    }
}

/// A word as a row of chips.
pub(crate) fn word(app: App, word: &Word) -> impl IntoView + use<> {
    if word.is_empty() {
        return view! { <p class="hint">"The empty word: no sub-goal was reached."</p> }.into_any();
    }
    let chips = word.iter().map(|&symbol| view! { <li>{chip(app, symbol)}</li> }).collect_view();
    view! { <ol class="word">{chips}</ol> }.into_any()
}
