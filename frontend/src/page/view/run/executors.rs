//! The executors: who they are, what they hold, what they can be told.

use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::RunView;
use leptos::prelude::*;

use super::holding::holding;
use crate::page::clock;
use crate::page::model::{Notice, SeenExecutor};
use crate::page::run_text;
use crate::page::update::{Action, App, WatchAction};

/// The list of executors.
pub(super) fn executors(app: App) -> impl IntoView {
    let names = Memo::new(move |_| {
        app.model.watching.heard.with(|heard| heard.executors.keys().cloned().collect::<Vec<_>>())
    });
    view! {
        <header class="section-head"><h2>"Executors"</h2></header>
        {move || names.with(Vec::is_empty).then(|| view! {
            <p class="hint">"None is connected. A robot, or " <code>"goalgraph executor"</code> ", connects to this server."</p>
        })}
        <ul class="executors">
            <For each=move || names.get() key=String::clone children=move |name| executor(app, &name) />
        </ul>
    }
}

fn executor(app: App, name: &str) -> impl IntoView + use<> {
    let key = name.to_owned();
    let seen = Memo::new(move |_| app.model.watching.heard.with(|heard| heard.executors.get(&key).cloned()));
    let run = Memo::new(move |_| {
        let id = seen.get()?.view.run?;
        app.model.watching.heard.with(|heard| heard.run(&id).cloned())
    });
    let chosen = Memo::new({
        let name = name.to_owned();
        move |_| {
            app.derived.watched.executor.with(|it| it.as_ref().is_some_and(|it| it.view.executor == name))
        }
    });
    let choose = {
        let name = name.to_owned();
        move |_| app.act(Action::Watch(WatchAction::ChooseExecutor(name.clone())))
    };
    let connected = move || seen.with(|seen| seen.as_ref().is_some_and(|it| it.view.connected));
    let software = move || seen.with(|seen| seen.as_ref().and_then(|it| it.view.software.clone()));
    let order = |command| order_button(app, name.to_owned(), seen, run, command);
    let orders = [Command::Start, Command::Pause, Command::Resume, Command::Stop].map(order).collect_view();
    view! {
        <li
            class="executor"
            class:chosen=move || chosen.get()
            data-executor=name.to_owned()
            data-connected=move || connected().to_string()
        >
            <header class="entry-head">
                <span class="lamp" aria-hidden="true"></span>
                <button
                    type="button"
                    class="executor-name entry-name"
                    dir="auto"
                    title="Commands from the palette and by keys go to this executor"
                    aria-pressed=move || chosen.get().to_string()
                    on:click=choose
                >
                    {name.to_owned()}
                </button>
            </header>
            <p class="hint">
                {move || seen.get().map(|seen| presence(&seen))}
                {move || software().map(|software| view! { <span dir="auto">" · " {software}</span> })}
            </p>
            {move || seen.get().map(|seen| holding(app, seen.view.holds))}
            {move || run.get().map(|run| its_run(app, &run))}
            <div class="row orders" role="group" aria-label=format!("Commands to {name}")>{orders}</div>
        </li>
    }
}

fn presence(seen: &SeenExecutor) -> String {
    let what = if seen.view.connected { "connected" } else { "not connected" };
    match seen.since_ms {
        Some(since_ms) => format!("{what} since {}", clock::of_ms(since_ms)),
        None => what.to_owned(),
    }
}

fn its_run(app: App, run: &RunView) -> impl IntoView + use<> {
    let id = run.run.clone();
    let text = format!("Run {}", run_text::short_id(&id));
    let phase = run_text::phase(run.phase);
    let place = run.state.map(|state| format!(" in {state}"));
    view! {
        <p class="row">
            <button type="button" class="link" on:click=move |_| app.act(Action::Watch(WatchAction::Choose(Some(id.clone()))))>{text}</button>
            <span class="hint">{phase} {place}</span>
        </p>
    }
}

/// A button that stays within reach of the keyboard when it makes no sense, and then says why.
fn order_button(
    app: App,
    executor: String,
    seen: Memo<Option<SeenExecutor>>,
    run: Memo<Option<RunView>>,
    command: Command,
) -> impl IntoView {
    let refusal = Memo::new(move |_| {
        let Some(seen) = seen.get() else { return Some("The executor is gone".to_owned()) };
        run.with(|run| run_text::refusal(&seen.view, run.as_ref(), command))
    });
    let label = run_text::command(command);
    let name = format!("{label} {executor}");
    let press = move |_| match refusal.get_untracked() {
        Some(reason) => app.act(Action::Say(Notice::alarm(format!("Not done: {reason}.")))),
        None => app.act(Action::Watch(WatchAction::Order(executor.clone(), command))),
    };
    view! {
        <button
            type="button"
            class="button small"
            class:primary=move || command == Command::Start && refusal.with(Option::is_none)
            class:stop={command == Command::Stop}
            aria-label=name
            aria-disabled=move || refusal.with(Option::is_some).to_string()
            title=move || refusal.get()
            on:click=press
        >
            {label}
        </button>
    }
}
