//! The page before anything is loaded.

use leptos::prelude::*;

use super::chips::button;
use crate::page::model::Sample;
use crate::page::text::count;
use crate::page::update::{Action, App};

/// An invitation: drop files, or take a sample.
pub(crate) fn start(app: App) -> impl IntoView {
    view! {
        <div class="start">
            <section class="drop-area" aria-labelledby="start-title">
                {picture()}
                <h2 id="start-title">"See the task in your demonstrations"</h2>
                <p class="lead">
                    "Drop recorded demonstrations anywhere on this page. Goalgraph finds the sub-goals, "
                    "reads every demonstration as a word over them, and draws the automaton."
                </p>
                {button(app, "open")}
                <p class="hint">"CSV or JSON, one file or many. The files stay on this computer until you save the work on a server."</p>
            </section>
            <section class="samples" aria-labelledby="samples-title">
                <h2 id="samples-title">"Or start with a sample"</h2>
                {move || cards(app)}
            </section>
        </div>
    }
}

fn cards(app: App) -> AnyView {
    match app.model.samples.get() {
        None => view! { <p class="hint">"Looking for samples"</p> }.into_any(),
        Some(samples) if samples.is_empty() => {
            view! { <p class="hint">"This server offers no samples."</p> }.into_any()
        }
        Some(samples) => {
            let cards = samples.into_iter().map(|sample| card(app, sample)).collect_view();
            view! { <ul class="cards">{cards}</ul> }.into_any()
        }
    }
}

fn card(app: App, sample: Sample) -> impl IntoView {
    let (title, description) = (sample.title.clone(), sample.description.clone());
    let files = count(sample.files.len(), "file");
    view! {
        <li>
            <button type="button" class="card" on:click=move |_| app.act(Action::LoadSample(sample.clone()))>
                <strong>{title}</strong>
                <span class="description">{description}</span>
                <span class="hint">{files}</span>
            </button>
        </li>
    }
}

/// Recorded paths become states.
fn picture() -> impl IntoView {
    view! {
        <svg class="start-picture" viewBox="0 0 360 96" width="360" height="96" aria-hidden="true">
            <path class="start-path" d="M8 70C40 20 60 84 92 44S132 30 148 48" />
            <path class="start-path" d="M8 76C36 40 70 92 98 56S130 44 148 52" />
            <path class="start-path" d="M8 62C44 10 52 70 88 36S128 22 148 44" />
            <path class="start-arrow" d="M164 48h32m-8-6 8 6-8 6" />
            <path class="start-edge" d="M232 48 268 22M232 48l36 26M284 22l36 26M284 74l36-26" />
            <circle class="start-state" cx="224" cy="48" r="10" />
            <circle class="c0 fill" cx="276" cy="20" r="10" />
            <circle class="c5 fill" cx="276" cy="76" r="10" />
            <circle class="c1 fill" cx="330" cy="48" r="10" />
            <circle class="start-ring c1 stroke" cx="330" cy="48" r="14" />
        </svg>
    }
}
