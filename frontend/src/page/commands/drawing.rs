//! Commands for the drawing: what of it is seen, and where things are.

use leptos::prelude::*;

use super::{Command, has_automaton};
use crate::page::model::{Selection, TextPane};
use crate::page::update::{Action, App, Flow};
use crate::page::view::graph;

pub(super) const COMMANDS: &[Command] = &[
    Command {
        id: "fit",
        label: "Fit",
        help: "Show the whole automaton.",
        keys: &["Shift+1"],
        in_menu: false,
        enabled: has_automaton,
        run: graph::fit,
    },
    Command {
        id: "zoom-in",
        label: "Zoom in",
        help: "Make the drawing larger.",
        keys: &["+"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| graph::zoom(app, graph::ZOOM_STEP),
    },
    Command {
        id: "zoom-out",
        label: "Zoom out",
        help: "Make the drawing smaller.",
        keys: &["-"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| graph::zoom(app, 1.0 / graph::ZOOM_STEP),
    },
    Command {
        id: "table",
        label: "Show as table",
        help: "Change between the graph and the same content as a table.",
        keys: &["t"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| app.act(Action::ToggleTable),
    },
    Command {
        id: "zoom-selection",
        label: "Zoom to selection",
        help: "Show what is selected as large as can be.",
        keys: &["Shift+2"],
        in_menu: true,
        enabled: has_selection,
        run: |app| graph::show(app, &app.model.selection.get_untracked()),
    },
    Command {
        id: "tidy",
        label: "Tidy",
        help: "Place everything anew. What is pinned stays where it is.",
        keys: &["y"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| app.act(Action::Tidy),
    },
    Command {
        id: "unpin",
        label: "Unpin",
        help: "Let the selected states, or else all, go where the layout puts them when everything is tidied.",
        keys: &["u"],
        in_menu: true,
        enabled: |app| !pinned(app).is_empty(),
        run: |app| app.act(Action::Unpin(untrack(|| pinned(app)))),
    },
    Command {
        id: "search",
        label: "Search",
        help: "Look for states and transitions by id, name or sub-goal.",
        keys: &["Ctrl+f"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| {
            app.act(Action::GoTo(crate::page::model::Tab::Automaton));
            app.act(Action::Search(Some(String::new())));
        },
    },
    Command {
        id: "select-all",
        label: "Select all states",
        help: "Select every state.",
        keys: &["Ctrl+a"],
        in_menu: false,
        enabled: has_automaton,
        run: select_all,
    },
    Command {
        id: "upstream",
        label: "Select upstream",
        help: "Select everything that leads to the selected states as well.",
        keys: &["["],
        in_menu: true,
        enabled: has_states,
        run: |app| app.act(Action::SelectFlow(Flow::Upstream)),
    },
    Command {
        id: "downstream",
        label: "Select downstream",
        help: "Select everything that the selected states lead to as well.",
        keys: &["]"],
        in_menu: true,
        enabled: has_states,
        run: |app| app.act(Action::SelectFlow(Flow::Downstream)),
    },
    Command {
        id: "text",
        label: "Show as text",
        help: "Show or hide the specification as DOT or JSON beside the graph.",
        keys: &["x"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| {
            let shown = app.model.text_pane.get_untracked();
            app.act(Action::ShowText(shown.is_none().then_some(TextPane::Dot)));
        },
    },
];

fn has_selection(app: App) -> bool {
    app.model.selection.with(|selection| !selection.is_empty())
}

fn has_states(app: App) -> bool {
    app.model.selection.with(|selection| selection.iter().any(|item| matches!(item, Selection::State(_))))
}

/// The pinned states among the selected ones, or all when nothing is selected.
fn pinned(app: App) -> Vec<goalgraph::pdfa::StateId> {
    let selection = app.model.selection.get();
    let chosen =
        |id: &goalgraph::pdfa::StateId| selection.is_empty() || selection.contains(&Selection::State(*id));
    app.model.held.with(|held| held.keys().copied().filter(|id| chosen(id)).collect())
}

fn select_all(app: App) {
    if let Some(specification) = app.derived.specification.get_untracked() {
        app.act(Action::SelectAll(
            specification.pdfa.states.keys().map(|&id| Selection::State(id)).collect(),
        ));
    }
}
