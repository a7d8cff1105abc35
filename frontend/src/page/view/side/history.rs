//! What was done, step by step; every step can be gone to.

use goalgraph::history::{History, Mark};
use leptos::prelude::*;

use crate::page::commands::is_kept;
use crate::page::update::{Action, App};
use crate::page::view::chips::button;

/// The steps, oldest first.
pub(super) fn history(app: App) -> impl IntoView {
    let steps = move || {
        let read = |history: &History| {
            let labels = std::iter::once("As learned or opened".to_owned()).chain(history.labels());
            labels.enumerate().map(|(position, label)| step(app, history, position, label)).collect_view()
        };
        app.model.history.with(|history| history.as_ref().map(read))
    };
    view! {
        <div class="row">{button(app, "undo")} {button(app, "redo")} {move || if is_kept(app) { button(app, "revisions").into_any() } else { button(app, "mark-approved").into_any() }}</div>
        <ol class="steps-done" aria-label="Steps">{steps}</ol>
    }
}

fn step(app: App, history: &History, position: usize, label: String) -> impl IntoView + use<> {
    let (present, undone) = (history.position() == position, position > history.position());
    let saved = history.marked(Mark::Saved) == Some(position);
    let number = app.model.keeping.lineages.with(|all| {
        let kept = all.iter().rev().find(|it| it.from <= position)?;
        Some((*kept.revisions.get(&position)?, kept.kept.approved))
    });
    // What is on a server is approved there.
    let marked = history.marked(Mark::Approved) == Some(position);
    let approved = number.map_or(marked && !is_kept(app), |(number, approved)| approved == Some(number));
    view! {
        <li>
            <button
                type="button"
                class="entry"
                class:undone=undone
                aria-current=present.then_some("step")
                on:click=move |_| app.act(Action::Jump(position))
            >
                <span class="entry-name">{label}</span>
                {number.map(|(number, _)| view! { <span class="tag">{format!("r{number}")}</span> })}
                {(saved && number.is_none()).then(|| view! { <span class="tag">"saved"</span> })}
                {approved.then(|| view! { <span class="tag">"approved"</span> })}
            </button>
        </li>
    }
}
