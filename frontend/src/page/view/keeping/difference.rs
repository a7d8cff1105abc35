//! What differs between two revisions: on one canvas, in a list, and in the words that are accepted.

use std::sync::Arc;

use leptos::prelude::*;

use super::canvas::canvas;
use super::changes::{changes, words};
use super::conflict::ways;
use super::{heading, when_here};
use crate::page::derived::Drawing;
use crate::page::model::Compared;
use crate::page::update::App;

/// The dialog.
pub(super) fn difference(app: App) -> impl IntoView {
    let conflict = move || app.model.keeping.conflict.get();
    view! {
        {heading("What differs")}
        {move || compared(app)}
        {move || conflict().map(|head| ways(app, &head, false))}
    }
}

/// What is compared, once both are here.
pub(super) fn compared(app: App) -> AnyView {
    when_here(app.model.keeping.compared.get(), |(before, after)| {
        app.derived.keeping.drawing.get().map(|drawing| both(app, &before, &after, &drawing)).into_any()
    })
}

fn both(app: App, before: &Compared, after: &Compared, drawing: &Arc<Drawing>) -> impl IntoView + use<> {
    let alone = Arc::ptr_eq(&before.specification, &after.specification);
    let sentence = if alone {
        format!("{}: nothing was approved before, so all of it is new to robots.", after.name)
    } else if drawing.difference.is_empty() {
        format!("{} and {} are the same.", before.name, after.name)
    } else {
        format!("From {} to {}", before.name, after.name)
    };
    view! {
        <div class="difference-head">
            <p><strong>{sentence}</strong></p>
            {(!alone).then(legend)}
        </div>
        <div class="difference" class:alone=alone>
            {canvas(app, drawing)}
            {(!alone).then(|| changes(app, drawing))}
        </div>
        {(!alone).then(|| words(drawing))}
    }
}

/// What signs and lines mean.
fn legend() -> impl IntoView {
    let line = |class: &'static str| {
        view! {
            <svg class=format!("legend-line {class}") width="30" height="10" aria-hidden="true">
                <path class="shaft" d="M1 5H29" />
            </svg>
        }
    };
    view! {
        <ul class="difference-legend" aria-label="Signs">
            <li>{line("added")} "+ added"</li>
            <li>{line("removed")} "\u{2212} removed"</li>
            <li>{line("changed")} "0.67 → 0.33 changed"</li>
        </ul>
    }
}
