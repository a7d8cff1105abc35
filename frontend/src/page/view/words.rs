//! A word as a row of chips.

use goalgraph::pdfa::Symbol;
use leptos::prelude::*;

use super::chips::chip;
use crate::page::update::App;

/// A word as a row of chips.
pub(crate) fn word(app: App, word: &[Symbol]) -> impl IntoView + use<> {
    if word.is_empty() {
        return view! { <p class="hint">"The empty word: no sub-goal was reached."</p> }.into_any();
    }
    let chips = word.iter().map(|&symbol| view! { <li>{move || chip(app, symbol)}</li> }).collect_view();
    view! { <ol class="word">{chips}</ol> }.into_any()
}
