//! Commands to go around in the page.

use leptos::prelude::*;

use super::{Command, always, has_automaton};
use crate::page::model::{Overlay, RunMode, Side, Tab};
use crate::page::update::{Action, App, WatchAction};

pub(super) const COMMANDS: &[Command] = &[
    Command {
        id: "demonstrations",
        label: "Go to Demonstrations",
        help: "Files with their verdicts, and what was recorded.",
        keys: &["1"],
        in_menu: false,
        enabled: always,
        run: |app| app.act(Action::GoTo(Tab::Demonstrations)),
    },
    Command {
        id: "sub-goals",
        label: "Go to Sub-goals",
        help: "What was found in each feature subset, and the words.",
        keys: &["2"],
        in_menu: false,
        enabled: always,
        run: |app| app.act(Action::GoTo(Tab::SubGoals)),
    },
    Command {
        id: "automaton",
        label: "Go to Automaton",
        help: "The graph with the probability of every transition.",
        keys: &["3"],
        in_menu: false,
        enabled: always,
        run: |app| app.act(Action::GoTo(Tab::Automaton)),
    },
    Command {
        id: "run",
        label: "Go to Run",
        help: "The plan for what is available.",
        keys: &["4"],
        in_menu: false,
        enabled: always,
        run: |app| app.act(Action::GoTo(Tab::Run)),
    },
    Command {
        id: "theme",
        label: "Light or dark",
        help: "Change between the light and the dark theme.",
        keys: &["m"],
        in_menu: false,
        enabled: always,
        run: |app| app.act(Action::ToggleTheme),
    },
    Command {
        id: "palette",
        label: "Commands",
        help: "Search all commands.",
        keys: &["Ctrl+k"],
        in_menu: false,
        enabled: always,
        run: |app| app.act(Action::Overlay(Some(Overlay::Palette))),
    },
    Command {
        id: "help",
        label: "Help",
        help: "Show all commands and their keys.",
        keys: &["?"],
        in_menu: false,
        enabled: always,
        run: |app| app.act(Action::Overlay(Some(Overlay::Help))),
    },
    Command {
        id: "variants",
        label: "Show variants",
        help: "List the distinct words, their shares and how they fare.",
        keys: &["v"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| show(app, Side::Variants),
    },
    Command {
        id: "merges",
        label: "Show merges",
        help: "List states with futures that are alike.",
        keys: &["g"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| show(app, Side::Merges),
    },
    Command {
        id: "problems",
        label: "Show problems",
        help: "List what is wrong.",
        keys: &["p"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| show(app, Side::Problems),
    },
    Command {
        id: "history",
        label: "Show history",
        help: "List what was done.",
        keys: &["h"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| show(app, Side::History),
    },
    Command {
        id: "benchmark",
        label: "Benchmark",
        help: "Measure how long previews and layouts take in this browser.",
        keys: &[],
        in_menu: false,
        enabled: always,
        run: |app| app.act(Action::Overlay(Some(Overlay::Benchmark))),
    },
    Command {
        id: "simulate",
        label: "Simulate",
        help: "Walk through the automaton by clicking what is possible.",
        keys: &["e"],
        in_menu: false,
        enabled: |app| has_automaton(app) && !is_walking(app),
        run: |app| {
            app.act(Action::GoTo(Tab::Run));
            app.act(Action::Watch(WatchAction::Mode(RunMode::Simulate)));
            app.act(Action::Walk(true));
        },
    },
    Command {
        id: "walk-restart",
        label: "Start again",
        help: "Begin the simulation again at the initial state.",
        keys: &[],
        in_menu: false,
        enabled: is_walking,
        run: |app| app.act(Action::StepBack(0)),
    },
    Command {
        id: "walk-end",
        label: "End the simulation",
        help: "Stop walking through the automaton.",
        keys: &[],
        in_menu: false,
        enabled: is_walking,
        run: |app| app.act(Action::Walk(false)),
    },
];

fn is_walking(app: App) -> bool {
    app.model.simulation.with(|walk| walk.on)
}

fn show(app: App, side: Side) {
    app.act(Action::GoTo(Tab::Automaton));
    app.act(Action::ShowSide(side));
}
