//! Watching: executors and runs on the left, the run on the graph, its events on the right.

use leptos::prelude::*;

use super::{executors, headline, log, modes, replay, runs, verdict};
use crate::page::update::App;
use crate::page::view::chips::button;
use crate::page::view::{filter, graph};

/// The whole of it.
pub(super) fn watch(app: App) -> impl IntoView {
    view! {
        <div class="columns monitoring">
            <section class="list" aria-label="Executors and runs">
                {modes::modes(app)}
                {modes::connection(app)}
                {executors::executors(app)}
                {runs::runs(app)}
            </section>
            <section class="canvas" aria-label="Run" data-live-phase=move || phase(app)>
                {headline::headline(app)}
                {filter::hidden(app)}
                {picture(app)}
                {replay::replay(app)}
            </section>
            <aside class="inspector watching" aria-label="Events of the run">
                {verdict::verdict(app)}
                {log::log(app)}
            </aside>
        </div>
    }
}

fn phase(app: App) -> Option<&'static str> {
    app.derived.watched.shown.with(|run| run.as_ref().map(|run| crate::page::run_text::phase(run.phase)))
}

/// The graph, when what is on display is what the run follows, or else a word about that.
fn picture(app: App) -> impl IntoView {
    let there = Memo::new(move |_| app.derived.specification.with(Option::is_some));
    let mismatch = Memo::new(move |_| {
        let run = app.derived.watched.run.get()?;
        (!app.derived.watched.agrees.get()).then_some((run.executor, run.revision, run.name))
    });
    view! {
        {move || mismatch.get().map(|(executor, revision, name)| view! {
            <div class="mismatch" role="note">
                <p>
                    <strong>{format!("{executor} runs r{revision} of {name}")}</strong>
                    {if there.get() { ", you view something else: the run is not drawn on it." } else { "." }}
                </p>
                {button(app, "open-followed")}
            </div>
        })}
        {move || if there.get() {
            graph::graph(app).into_any()
        } else {
            view! { <div class="nothing"><p>"No specification is open."</p></div> }.into_any()
        }}
    }
}
