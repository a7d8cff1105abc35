//! Over the graph: which run it is, how it stands, what is done, what comes; and a new plan at the moment it is made.

use goalgraph::pdfa::Symbol;
use goalgraph::protocol::monitor::RunView;
use leptos::prelude::*;

use crate::page::colors;
use crate::page::run_text::{self, phase, short_id};
use crate::page::update::{Action, App, WatchAction};

/// The run in words and chips.
pub(super) fn headline(app: App) -> impl IntoView {
    let shown = app.derived.watched.shown;
    // A new plan is announced once, not again with every event after it.
    let there = Memo::new(move |_| shown.with(Option::is_some));
    view! {
        <header class="headline">
            <div class="headline-title">
                {move || match shown.get() {
                    None => view! { <h2>"No run yet"</h2> }.into_any(),
                    Some(run) => title(app, &run).into_any(),
                }}
                <span class="read-only" title="Runs are only watched here: edit on the Automaton tab.">"Read-only"</span>
            </div>
            {move || shown.get().map(|run| progress(app, &run))}
            <div class="replanned" role="status" aria-live="polite">{move || there.get().then(|| replanned(app))}</div>
        </header>
    }
}

fn title(app: App, run: &RunView) -> impl IntoView + use<> {
    let place = match (run.state, run.states.last()) {
        (Some(state), _) => format!("in {state}"),
        (None, Some(last)) => format!("left the automaton after {last}"),
        (None, None) => "left the automaton".to_owned(),
    };
    let at = move || app.model.watching.replay.get().map(|replay| replay.at);
    view! {
        <div class="headline-run">
            <h2 dir="auto">{run.executor.clone()} ", run " {short_id(&run.run).to_owned()}</h2>
            <span class=format!("tag phase {}", phase(run.phase))>{phase(run.phase)}</span>
            <span class="hint" dir="auto">{place} " · " {run.name.clone()} " r" {run.revision}</span>
            {move || at().map(|at| view! { <span class="tag replaying">{format!("replay, event {at}")}</span> })}
        </div>
    }
}

/// What is done, what is being done, what comes, and what cannot be done.
fn progress(app: App, run: &RunView) -> impl IntoView + use<> {
    let active = run.active;
    let done = run.trail.iter().map(|&symbol| item(app, symbol, "done", "done")).collect_view();
    // What is being done is the first of what lies ahead.
    let doing = active.filter(|active| !run.plan.contains(active));
    let doing = doing.map(|symbol| item(app, symbol, "doing", "now"));
    let ahead = run.plan.iter().map(|&symbol| {
        if Some(symbol) == active {
            item(app, symbol, "doing", "now")
        } else {
            item(app, symbol, "ahead", "ahead")
        }
    });
    let out = (!run.unavailable.is_empty()).then(|| {
        let chips =
            run.unavailable.iter().map(|&symbol| item(app, symbol, "out", "unavailable")).collect_view();
        view! {
            <span class="hint">"Unavailable"</span>
            <ol class="word" aria-label="Unavailable">{chips}</ol>
        }
    });
    view! {
        <div class="progress-row">
            <ol class="word" aria-label="Done and ahead">{done} {doing} {ahead.collect_view()}</ol>
            {out}
        </div>
    }
}

fn item(app: App, symbol: Symbol, class: &'static str, state: &'static str) -> impl IntoView + use<> {
    view! {
        <li class=format!("stage {class}")>
            {run_chip(app, symbol)}
            <span class="visually-hidden">{state}</span>
        </li>
    }
}

/// A sub-goal as the specification calls it that the run follows.
pub(super) fn run_chip(app: App, symbol: Symbol) -> impl IntoView {
    let followed = app.derived.watched.followed.get();
    let specification = followed.as_ref().map(|it| &*it.specification);
    let class = specification.and_then(|it| colors::colors(it).get(&symbol).map(|color| color.class()));
    let name = run_text::name(specification, symbol);
    view! { <span class=format!("chip {}", class.unwrap_or_default())>{name}</span> }
}

/// The last new plan, with the way to its event. The line is there from the first plan on, so that the graph below it
/// does not jump when a new one is made.
fn replanned(app: App) -> AnyView {
    let Some(replanned) = app.derived.watched.replanned.get() else {
        return view! { <p class="hint">"No new plan so far."</p> }.into_any();
    };
    let followed = app.derived.watched.followed.get();
    let specification = followed.as_ref().map(|it| &*it.specification);
    let text = run_text::replanned(specification, &replanned.unavailable, &replanned.word);
    let number = replanned.number;
    let go = move |_| app.act(Action::Watch(WatchAction::Replay(Some(number))));
    let title = text.clone();
    let line = view! {
        <p class="replanned-text" title=title data-replanned=number.to_string()>
            <span class="turn" aria-hidden="true">"↻"</span>
            <span>{text}</span>
            <button type="button" class="link" on:click=go>{format!("event {number}")}</button>
        </p>
    };
    line.into_any()
}
