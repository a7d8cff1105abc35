//! Edits: thought of, made, undone.

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::edit::Edit;
use goalgraph::history::{History, Mark, Transaction};
use goalgraph::pdfa::{StateId, Symbol};
use goalgraph::specification::Specification;
use leptos::prelude::*;

use super::App;
use crate::page::model::{Draft, Notice, Selection, Tab};

impl App {
    /// Shows what `edits` would do. What somebody has begun is not replaced by what a pointer only rests on.
    pub(super) fn think_of(self, label: Option<String>, edits: Vec<Edit>, begun: bool) {
        let waiting = self.model.draft.with_untracked(|draft| draft.as_ref().is_some_and(|it| it.begun));
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        if edits.is_empty() || (waiting && !begun) {
            return;
        }
        if begun && !matches!(self.model.tab.get_untracked(), Tab::Automaton | Tab::SubGoals) {
            // Only there it is seen what the edit would do.
            self.model.tab.set(Tab::Automaton);
        }
        let label = label.unwrap_or_else(|| label_of(&edits, &specification));
        self.model.draft.set(Some(Draft { label, edits, begun }));
    }

    /// The pointer has left what it rested on.
    pub(super) fn think_no_more(self) {
        if self.model.draft.with_untracked(|draft| draft.as_ref().is_some_and(|it| !it.begun)) {
            self.model.draft.set(None);
        }
    }

    /// Makes the edit that was begun.
    pub(super) fn apply_draft(self) {
        if let Some(Draft { label, edits, .. }) = self.model.draft.get_untracked() {
            self.commit(Transaction { label, edits });
        }
    }

    /// Makes `edits` at once.
    pub(super) fn edit(self, label: Option<String>, edits: Vec<Edit>) {
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        // The preview of another edit that waits says nothing of this one.
        self.model.draft.set(None);
        let label = label.unwrap_or_else(|| label_of(&edits, &specification));
        self.commit(Transaction { label, edits });
    }

    /// The id that a new state gets.
    pub(crate) fn next_state(self) -> StateId {
        let next = self.model.history.with_untracked(|history| history.as_ref().map(History::next_state));
        next.unwrap_or(StateId(0))
    }

    /// The frame in which a demonstration completed a sub-goal, where it was recorded.
    pub(crate) fn completed_in(self, demonstration: usize, symbol: Symbol) -> Option<usize> {
        self.recording(demonstration)?;
        self.model.learned.with(|learned| {
            let completed = learned.as_ref()?.outcome.completed.get(demonstration)?;
            let at = completed.word.iter().position(|it| *it == symbol)?;
            completed.frames.get(at).copied()
        })
    }

    /// Says that something was typed that makes no sense.
    pub(crate) fn say_expected(self, what: &str, expected: &str, typed: &str) {
        let typed: String = typed.chars().take(40).collect();
        self.say(Notice::alarm(format!("Not done: {what} is {expected}, not {typed:?}.")));
    }

    fn commit(self, transaction: Transaction) {
        let label = transaction.label.clone();
        let folded = self.derived.preview.get_untracked().and_then(Result::ok).map(|it| it.folded.clone());
        let mut result = Ok(());
        self.model.draft.set(None);
        self.forget_undone_lineages();
        self.model.history.update(|history| {
            if let Some(history) = history {
                result = history.commit(transaction);
            }
        });
        match result {
            Ok(()) => {
                self.follow_selection(&folded.unwrap_or_default());
                self.say(Notice::calm(format!("{label}. Ctrl+Z undoes it.")));
            }
            Err(refusal) => self.say(Notice::alarm(format!("Not done: {refusal}."))),
        }
    }

    /// What is selected and gone is not selected any more; what was folded is selected as what it is part of now.
    fn follow_selection(self, folded: &BTreeMap<StateId, StateId>) {
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        let into = |id: StateId| *folded.get(&id).unwrap_or(&id);
        let mut next = Vec::new();
        for item in self.model.selection.get_untracked() {
            let item = match item {
                Selection::State(id) => Selection::State(into(id)),
                Selection::Transition(source, symbol) => Selection::Transition(into(source), symbol),
            };
            if is_there(&specification, item) && !next.contains(&item) {
                next.push(item);
            }
        }
        self.model.selection.set(next);
    }

    /// Goes one step back or on in the history, or to a place in it.
    pub(super) fn travel(self, go: impl FnOnce(&mut History) -> bool) {
        self.model.draft.set(None);
        let mut moved = None;
        self.model.history.update(|history| {
            let Some(history) = history else { return };
            let before = history.position();
            if go(history) {
                moved = Some((before, history.position(), history.labels()));
            }
        });
        self.follow_selection(&BTreeMap::new());
        let Some((before, after, labels)) = moved else { return };
        let named = |step: usize| labels.get(step).cloned().unwrap_or_default();
        self.say(Notice::calm(match () {
            () if before == after + 1 => format!("Undone: {}.", named(after)),
            () if after == before + 1 => format!("Redone: {}.", named(before)),
            () => format!("At step {after} of {}.", labels.len()),
        }));
    }

    /// Marks the present place in the history.
    pub(super) fn mark(self, mark: Mark) {
        self.model.history.update(|history| {
            if let Some(history) = history {
                history.mark(mark);
            }
        });
    }

    /// Puts another specification in the place of the present one, as a step that can be undone.
    pub(super) fn replace(self, label: String, specification: Specification) {
        if self.model.history.with_untracked(Option::is_none) {
            self.model.history.set(Some(History::new(specification)));
            return;
        }
        let edit = Edit::Replace { specification: specification.to_json() };
        self.forget_looks();
        self.commit(Transaction { label, edits: vec![edit] });
    }
}

impl App {
    /// Forgets what names states and sub-goals of the present automaton, when another one takes its place.
    fn forget_looks(self) {
        let model = self.model;
        model.held.set(BTreeMap::new());
        model.vetoed.update(BTreeSet::clear);
        model.locked.update(BTreeSet::clear);
        model.lit.update(BTreeSet::clear);
        model.unavailable.update(BTreeSet::clear);
        model.selection.set(Vec::new());
        model.simulation.update(|walk| walk.on = false);
    }
}

fn label_of(edits: &[Edit], specification: &Specification) -> String {
    edits.first().map(|edit| edit.label(specification)).unwrap_or_default()
}

fn is_there(specification: &Specification, item: Selection) -> bool {
    match item {
        Selection::State(id) => specification.pdfa.states.contains_key(&id),
        Selection::Transition(source, symbol) => specification.pdfa.transition(source, symbol).is_some(),
    }
}
