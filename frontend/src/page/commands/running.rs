//! Commands for executors and runs. None that sets a robot in motion has a key of its own: a slip does not start it.

use goalgraph::protocol::executor::Command as Order;
use leptos::prelude::*;

use super::{Command, always};
use crate::page::model::{RunMode, Tab};
use crate::page::run_text::refusal;
use crate::page::update::{Action, App, KeepAction, WatchAction};

pub(super) const COMMANDS: &[Command] = &[
    Command {
        id: "monitor",
        label: "Monitor runs",
        help: "Watch executors and their runs; nothing is edited meanwhile.",
        keys: &["5"],
        in_menu: false,
        enabled: always,
        run: |app| show(app, RunMode::Monitor),
    },
    Command {
        id: "try-out",
        label: "Plan and simulate",
        help: "Try the automaton without a robot: switch sub-goals off, see the plan, walk.",
        keys: &["6"],
        in_menu: false,
        enabled: always,
        run: |app| show(app, RunMode::Simulate),
    },
    Command {
        id: "start-run",
        label: "Start a run",
        help: "Tell the executor to begin a run with the specification that it has accepted.",
        keys: &[],
        in_menu: false,
        enabled: |app| can(app, Order::Start),
        run: |app| order(app, Order::Start),
    },
    Command {
        id: "pause-run",
        label: "Pause the run",
        help: "Tell the executor to pause before the next sub-goal.",
        keys: &["Ctrl+,"],
        in_menu: false,
        enabled: |app| can(app, Order::Pause),
        run: |app| order(app, Order::Pause),
    },
    Command {
        id: "resume-run",
        label: "Resume the run",
        help: "Tell the executor to go on after a pause.",
        keys: &[],
        in_menu: false,
        enabled: |app| can(app, Order::Resume),
        run: |app| order(app, Order::Resume),
    },
    Command {
        id: "stop-run",
        label: "Stop the run",
        help: "Tell the executor to end its run.",
        keys: &["Ctrl+."],
        in_menu: false,
        enabled: |app| can(app, Order::Stop),
        run: |app| order(app, Order::Stop),
    },
    Command {
        id: "replay",
        label: "Play or pause the replay",
        help: "Show the run event by event, from the moment that is on display.",
        keys: &[" "],
        in_menu: false,
        enabled: |app| is_watched(app) && has_events(app),
        run: |app| {
            let playing = app.model.watching.replay.with_untracked(|it| it.is_some_and(|it| it.playing));
            app.act(Action::Watch(WatchAction::Play(!playing)));
        },
    },
    Command {
        id: "replay-back",
        label: "Previous event",
        help: "Show the run as it was one event earlier.",
        keys: &[","],
        in_menu: false,
        enabled: |app| is_watched(app) && has_events(app),
        run: |app| app.act(Action::Watch(WatchAction::StepReplay(-1))),
    },
    Command {
        id: "replay-on",
        label: "Next event",
        help: "Show the run as it was one event later.",
        keys: &["."],
        in_menu: false,
        enabled: |app| is_watched(app) && app.model.watching.replay.with(Option::is_some),
        run: |app| app.act(Action::Watch(WatchAction::StepReplay(1))),
    },
    Command {
        id: "replay-end",
        label: "Back to now",
        help: "Leave the replay and show the run as it is.",
        keys: &["End"],
        in_menu: false,
        enabled: |app| is_watched(app) && app.model.watching.replay.with(Option::is_some),
        run: |app| app.act(Action::Watch(WatchAction::Replay(None))),
    },
    Command {
        id: "next-run",
        label: "Next run",
        help: "Look at the run that began before this one.",
        keys: &[">"],
        in_menu: false,
        enabled: is_watched,
        run: |app| app.act(Action::Watch(WatchAction::StepRun(1))),
    },
    Command {
        id: "previous-run",
        label: "Previous run",
        help: "Look at the run that began after this one.",
        keys: &["<"],
        in_menu: false,
        enabled: is_watched,
        run: |app| app.act(Action::Watch(WatchAction::StepRun(-1))),
    },
    Command {
        id: "open-followed",
        label: "Open the revision of the run",
        help: "Open the revision that the run follows, as a step that can be undone.",
        keys: &[],
        in_menu: false,
        enabled: |app| has_run(app) && !app.derived.watched.agrees.get(),
        run: open_followed,
    },
    Command {
        id: "promote",
        label: "Promote to a demonstration",
        help: "Add what a run that left the automaton completed as a word. Shows what that changes before it happens.",
        keys: &[],
        in_menu: false,
        enabled: |app| app.promotion_refusal().is_none(),
        run: |app| app.act(Action::Watch(WatchAction::Promote)),
    },
];

fn show(app: App, mode: RunMode) {
    app.act(Action::GoTo(Tab::Run));
    app.act(Action::Watch(WatchAction::Mode(mode)));
}

fn is_watched(app: App) -> bool {
    app.derived.watched.monitoring.get() && has_run(app)
}

fn has_run(app: App) -> bool {
    app.derived.watched.run.with(Option::is_some)
}

fn has_events(app: App) -> bool {
    app.derived.watched.run.with(|run| run.as_ref().is_some_and(|run| run.events > 0))
}

fn can(app: App, command: Order) -> bool {
    let Some(executor) = app.derived.watched.executor.get() else { return false };
    app.model.watching.heard.with(|heard| {
        let run = executor.view.run.as_ref().and_then(|run| heard.run(run));
        refusal(&executor.view, run, command).is_none()
    })
}

fn order(app: App, command: Order) {
    if let Some(executor) = app.derived.watched.executor.get_untracked() {
        app.act(Action::Watch(WatchAction::Order(executor.view.executor, command)));
    }
}

fn open_followed(app: App) {
    if let Some(run) = app.derived.watched.run.get_untracked() {
        app.act(Action::Keep(KeepAction::Open(run.specification, Some(run.revision))));
    }
}
