//! The executors: who they are, what they hold, what they can be told.

use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::{Answer, Held, RunView};
use leptos::prelude::*;

use crate::page::clock;
use crate::page::model::{Notice, SeenExecutor};
use crate::page::run_text;
use crate::page::update::{Action, App, KeepAction, WatchAction};

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
            {move || seen.get().map(|seen| held(app, seen.view.holds))}
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

/// What it holds, beside what is on display.
fn held(app: App, held: Option<Held>) -> AnyView {
    let Some(held) = held else {
        return view! { <p class="hint">"Holds no specification"</p> }.into_any();
    };
    let (verdict, class) = match &held.answer {
        Answer::Awaited => ("not answered yet".to_owned(), "tag"),
        Answer::Accepted => ("accepted".to_owned(), "tag good"),
        Answer::Rejected { reason } => (format!("rejected: {reason}"), "tag bad"),
    };
    let (name, number) = (held.name.clone(), held.revision);
    view! {
        <div class="held row">
            <span dir="auto">{name} " " <strong>{format!("r{number}")}</strong></span>
            <span class=class>{verdict}</span>
            {beside(app, held)}
        </div>
    }
    .into_any()
}

/// What is on display in place of what an executor holds, and the ways there.
fn beside(app: App, held: Held) -> impl IntoView {
    let number = held.revision;
    let sha256 = held.sha256.clone();
    let same =
        Memo::new(move |_| app.derived.watched.viewed_sha256.with(|viewed| viewed.as_ref() == Some(&sha256)));
    let id = held.specification.clone();
    let viewed = Memo::new(move |_| viewed(app, &id));
    move || {
        if same.get() {
            return view! { <span class="tag on-display">"on display"</span> }.into_any();
        }
        let id = held.specification.clone();
        let open = move |_| app.act(Action::Keep(KeepAction::Open(id.clone(), Some(number))));
        let (text, other) = match viewed.get() {
            Viewed::Nothing => ("nothing is open".to_owned(), None),
            Viewed::Other => ("you view something else".to_owned(), None),
            Viewed::Revision(viewed) => (format!("you view r{viewed}"), Some(viewed)),
            Viewed::Edited(viewed) => (format!("you view r{viewed} with edits"), Some(viewed)),
        };
        let difference = other.filter(|viewed| *viewed != number).map(|viewed| {
            let compare = move |_| app.act(Action::Keep(KeepAction::Compare(number, viewed)));
            let name = format!("Difference between r{number} and r{viewed}");
            view! { <button type="button" class="link" aria-label=name on:click=compare>"Difference"</button> }
        });
        view! {
            <span class="tag differs">{text}</span>
            <button type="button" class="link" on:click=open>{format!("Open r{number}")}</button>
            {difference}
        }
        .into_any()
    }
}

/// What is on display, beside a specification of the server.
#[derive(Clone, Copy, PartialEq)]
enum Viewed {
    Nothing,
    Other,
    Revision(u64),
    Edited(u64),
}

fn viewed(app: App, id: &str) -> Viewed {
    let Some(position) =
        app.model.history.with(|history| history.as_ref().map(goalgraph::history::History::position))
    else {
        return Viewed::Nothing;
    };
    app.derived.keeping.lineage.with(|lineage| match lineage {
        Some(lineage) if lineage.kept.id == id => match lineage.revisions.get(&position) {
            Some(&number) => Viewed::Revision(number),
            None => Viewed::Edited(lineage.kept.revision),
        },
        _ => Viewed::Other,
    })
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
