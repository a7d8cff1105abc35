//! Commands that change the automaton. What has a consequence is begun here and made once it was seen.

use std::collections::BTreeMap;

use goalgraph::edit::{Edit, Pruned};
use goalgraph::pdfa::StateId;
use goalgraph::specification::{Severity, Specification};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::HtmlElement;

use super::{Command, has_automaton};
use crate::page::model::{Draft, Selection, Side, Tab};
use crate::page::update::{Action, App};

pub(super) const COMMANDS: &[Command] = &[
    Command {
        id: "undo",
        label: "Undo",
        help: "Take the last edit back. There is no limit.",
        keys: &["Ctrl+z"],
        in_menu: false,
        enabled: |app| app.model.history.with(|it| it.as_ref().is_some_and(|it| it.position() > 0)),
        run: |app| app.act(Action::Undo),
    },
    Command {
        id: "redo",
        label: "Redo",
        help: "Make the edit again that was taken back.",
        keys: &["Ctrl+Shift+z", "Ctrl+y"],
        in_menu: false,
        enabled: |app| {
            app.model.history.with(|it| it.as_ref().is_some_and(|it| it.position() < it.labels().len()))
        },
        run: |app| app.act(Action::Redo),
    },
    Command {
        id: "mark-approved",
        label: "Mark as approved",
        help: "Mark the present step of the history as approved; not while there are errors. What is on a server is approved there.",
        keys: &[],
        in_menu: false,
        enabled: |app| has_automaton(app) && !has_errors(app) && !super::keeping::is_kept(app),
        run: |app| app.act(Action::MarkApproved),
    },
    Command {
        id: "merge",
        label: "Merge",
        help: "Make the selected states one: the last into the first. Shows what folds before it happens.",
        keys: &["Ctrl+m"],
        in_menu: true,
        enabled: |app| states(app).len() > 1,
        run: merge,
    },
    Command {
        id: "prune",
        label: "Prune",
        help: "Remove what is selected, and what can no longer be reached. The other ways share its probability.",
        keys: &["Delete", "Backspace"],
        in_menu: true,
        enabled: has_selection,
        run: |app| prune(app, Pruned::Cut),
    },
    Command {
        id: "heal",
        label: "Prune and heal",
        help: "Remove what is selected, but keep the ways past it: they take over its probability.",
        keys: &["Ctrl+Delete", "Ctrl+Backspace"],
        in_menu: true,
        enabled: has_selection,
        run: |app| prune(app, Pruned::Heal),
    },
    Command {
        id: "accepting",
        label: "Accepting or not",
        help: "Let the task end in the selected states, or not any more.",
        keys: &["a"],
        in_menu: true,
        enabled: |app| !states(app).is_empty(),
        run: toggle_accepting,
    },
    Command {
        id: "reset-weights",
        label: "Reset weights to counts",
        help: "Let the counts of the selected states decide again.",
        keys: &["r"],
        in_menu: true,
        enabled: |app| !states(app).is_empty(),
        run: reset_weights,
    },
    Command {
        id: "rename",
        label: "Rename",
        help: "Name the selected state.",
        keys: &["F2"],
        in_menu: true,
        enabled: |app| states(app).len() == 1 && app.model.selection.with(Vec::len) == 1,
        run: |_| focus("[data-name-field]"),
    },
    Command {
        id: "reweight",
        label: "Reweight",
        help: "Go to the probability of what is selected, to type another one.",
        keys: &["w"],
        in_menu: true,
        enabled: |app| app.model.selection.with(Vec::len) == 1,
        run: |_| focus(".probability:not(:disabled)"),
    },
    Command {
        id: "add-state",
        label: "Add a state",
        help: "Add a state that nothing leads to yet; drag from another state's handle to it.",
        keys: &["n"],
        in_menu: false,
        enabled: has_automaton,
        run: add_state,
    },
    Command {
        id: "next-merge",
        label: "Next merge",
        help: "Begin the best merge that was not vetoed, or veto the one that is shown and go to the next.",
        keys: &["k"],
        in_menu: false,
        enabled: has_automaton,
        run: next_merge,
    },
    Command {
        id: "apply",
        label: "Apply",
        help: "Make the edit that is shown.",
        keys: &["Enter"],
        in_menu: false,
        enabled: |app| {
            is_begun(app) && is_seen(app) && app.derived.preview.with(|it| matches!(it, Some(Ok(_))))
        },
        run: |app| app.act(Action::Apply),
    },
    Command {
        id: "cancel-edit",
        label: "Cancel the edit",
        help: "Forget the edit that is shown. Nothing is left of it.",
        keys: &[],
        in_menu: false,
        enabled: is_begun,
        run: |app| app.act(Action::CancelDraft),
    },
    Command {
        id: "escape",
        label: "Cancel or deselect",
        help: "Break off what is being done; when nothing is, select nothing.",
        keys: &["Escape"],
        in_menu: false,
        enabled: |_| true,
        run: escape,
    },
];

fn states(app: App) -> Vec<StateId> {
    let state = |item: &Selection| match item {
        Selection::State(id) => Some(*id),
        Selection::Transition(..) => None,
    };
    app.model.selection.with(|selection| selection.iter().filter_map(state).collect())
}

fn has_selection(app: App) -> bool {
    app.model.selection.with(|selection| !selection.is_empty())
}

fn is_begun(app: App) -> bool {
    app.model.draft.with(|draft| draft.as_ref().is_some_and(|it| it.begun))
}

fn has_errors(app: App) -> bool {
    app.derived.problems.with(|problems| problems.iter().any(|it| it.severity == Severity::Error))
}

/// A preview is seen on these tabs only.
fn is_seen(app: App) -> bool {
    matches!(app.model.tab.get(), Tab::Automaton | Tab::SubGoals)
}

/// All of the others into the first; what an earlier merge has folded in already is left out.
fn merge(app: App) {
    let Some(specification) = app.derived.specification.get_untracked() else { return };
    let states = untrack(|| states(app));
    let Some((&kept, others)) = states.split_first() else { return };
    let mut after = Specification::clone(&specification);
    let (mut edits, mut stays) = (Vec::new(), kept);
    let mut folded: BTreeMap<StateId, StateId> = BTreeMap::new();
    for &other in others {
        let merged = *folded.get(&other).unwrap_or(&other);
        if merged == stays {
            continue;
        }
        let edit = Edit::MergeStates { kept: stays, merged };
        // A refusal is seen in the preview.
        if let Ok(change) = edit.apply(&mut after) {
            for into in folded.values_mut() {
                *into = *change.folded.get(into).unwrap_or(into);
            }
            stays = *change.folded.get(&stays).unwrap_or(&stays);
            folded.extend(change.folded);
        }
        edits.push(edit);
    }
    app.act(Action::Begin(edits));
}

/// What an earlier one has taken along is left out.
fn prune(app: App, ways: Pruned) {
    let Some(specification) = app.derived.specification.get_untracked() else { return };
    let mut after = Specification::clone(&specification);
    let mut edits = Vec::new();
    let edit = |item: Selection| match item {
        Selection::State(state) => Edit::PruneState { state, ways },
        Selection::Transition(source, symbol) => Edit::PruneTransition { source, symbol, ways },
    };
    for item in app.model.selection.get_untracked() {
        let there = match item {
            Selection::State(id) => after.pdfa.states.contains_key(&id),
            Selection::Transition(source, symbol) => after.pdfa.transition(source, symbol).is_some(),
        };
        if there {
            let edit = edit(item);
            // A refusal is seen in the preview.
            let _ = edit.apply(&mut after);
            edits.push(edit);
        }
    }
    app.act(Action::Begin(edits));
}

/// All of them become what most of them are not.
fn toggle_accepting(app: App) {
    let Some(specification) = app.derived.specification.get_untracked() else { return };
    let states = untrack(|| states(app));
    let is_accepting = |id| specification.pdfa.states.get(id).is_some_and(|state| state.accepting);
    let accepting = !states.iter().all(is_accepting);
    app.act(Action::Begin(states.into_iter().map(|state| Edit::SetAccepting { state, accepting }).collect()));
}

fn reset_weights(app: App) {
    let states = untrack(|| states(app));
    app.act(Action::Begin(states.into_iter().map(|state| Edit::ResetWeights { state }).collect()));
}

fn add_state(app: App) {
    app.act(Action::GoTo(Tab::Automaton));
    let id = app.next_state();
    app.act(Action::Edit(None, vec![Edit::AddState { id }]));
    app.act(Action::Select(Some(Selection::State(id))));
}

fn next_merge(app: App) {
    app.act(Action::GoTo(Tab::Automaton));
    app.act(Action::ShowSide(Side::Merges));
    if let Some(Draft { edits, begun: true, .. }) = app.model.draft.get_untracked()
        && let [Edit::MergeStates { kept, merged }] = edits.as_slice()
    {
        app.act(Action::Veto(*kept, *merged));
    }
    app.act(Action::CancelDraft);
    if let Some(next) = app.derived.candidates.get_untracked().first() {
        app.act(Action::Begin(vec![Edit::MergeStates { kept: next.kept, merged: next.merged }]));
    }
}

fn focus(selector: &str) {
    let field = document().query_selector(&format!(".inspector {selector}")).ok().flatten();
    if let Some(field) = field.and_then(|field| field.dyn_into::<HtmlElement>().ok()) {
        // An element of this page always takes the focus.
        let _ = field.focus();
    }
}

fn escape(app: App) {
    if app.model.gesture.with_untracked(Option::is_some) {
        app.act(Action::Abort);
        app.act(Action::ConsiderNoMore);
    } else if app.model.menu.get_untracked().is_some() {
        app.act(Action::Menu(None));
    } else if app.model.draft.with_untracked(Option::is_some) {
        app.act(Action::CancelDraft);
    } else if app.model.search.with_untracked(|search| search.text.is_some()) {
        app.act(Action::Search(None));
    } else {
        app.act(Action::Select(None));
    }
}
