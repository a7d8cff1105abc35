//! The list of runs: those that go on, and those that are over.

use goalgraph::protocol::monitor::RunView;
use leptos::prelude::*;

use crate::page::clock;
use crate::page::run_text::{phase, short_id};
use crate::page::text::count;
use crate::page::update::{Action, App, WatchAction};
use crate::page::view::chips::icon_button;

/// The runs, newest first.
pub(super) fn runs(app: App) -> impl IntoView {
    let watching = &app.model.watching;
    let ids = Memo::new(move |_| {
        watching.heard.with(|heard| heard.runs.iter().map(|run| run.run.clone()).collect::<Vec<_>>())
    });
    let older = move |_| app.act(Action::Watch(WatchAction::FetchOlder));
    view! {
        <header class="section-head">
            <h2>"Runs"</h2>
            <span class="row">{icon_button(app, "previous-run", "↑")} {icon_button(app, "next-run", "↓")}</span>
        </header>
        {move || ids.with(Vec::is_empty).then(|| view! { <p class="hint">"None yet. Start one at an executor."</p> })}
        <ol class="runs" aria-label="Runs">
            <For each=move || ids.get() key=String::clone children=move |id| row(app, id) />
        </ol>
        {move || (!watching.older.with(|older| older.complete)).then(|| view! {
            <button
                type="button"
                class="link"
                disabled=move || watching.older.with(|older| older.fetching)
                on:click=older
            >
                "Older runs"
            </button>
        })}
    }
}

fn row(app: App, id: String) -> impl IntoView {
    let key = id.clone();
    let run = Memo::new(move |_| app.model.watching.heard.with(|heard| heard.run(&key).cloned()));
    let key = id.clone();
    let current = Memo::new(move |_| {
        app.derived.watched.run.with(|run| run.as_ref().is_some_and(|run| run.run == key))
    });
    let choose = {
        let id = id.clone();
        move |_| app.act(Action::Watch(WatchAction::Choose(Some(id.clone()))))
    };
    view! {
        <li>
            <button
                type="button"
                class="entry tall run"
                data-run=id
                aria-current=move || current.get().then_some("true")
                on:click=choose
            >
                {move || run.get().map(|run| content(&run))}
            </button>
        </li>
    }
}

fn content(run: &RunView) -> impl IntoView + use<> {
    let (name, began) = (run.executor.clone(), clock::of(&run.began_at));
    let done = count(run.trail.len(), "sub-goal");
    let replans = (run.replans > 0).then(|| {
        let times = run.replans;
        view! { <span class="hint">{format!("re-planned {times}×")}</span> }
    });
    let left = run.departure.map(|_| view! { <span class="tag bad">"left the automaton"</span> });
    view! {
        <span class="entry-head">
            <span class=format!("tag phase {}", phase(run.phase))>{phase(run.phase)}</span>
            <span class="entry-name" dir="auto">{name} " · " {short_id(&run.run).to_owned()}</span>
        </span>
        <span class="entry-head">
            <span class="hint entry-name" dir="auto">{format!("{} r{} · {began}", run.name, run.revision)}</span>
        </span>
        <span class="row">
            <span class="hint">{done} " done"</span> {replans} {left}
        </span>
    }
}
