//! What is selected, and what follows from a selection.

use std::collections::BTreeSet;

use goalgraph::pdfa::{Pdfa, StateId};
use leptos::prelude::*;

use super::App;
use crate::page::model::Selection;

/// Which way to look from a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    /// Everything that leads to it.
    Upstream,
    /// Everything that it leads to.
    Downstream,
}

impl App {
    /// Selects `item` alone, or nothing.
    pub(super) fn select(self, item: Option<Selection>) {
        self.model.selection.set(item.into_iter().collect());
        self.model.menu.set(None);
    }

    /// Adds `item` to what is selected, or takes it out.
    pub(super) fn toggle_selected(self, item: Selection) {
        self.model.selection.update(|selection| match selection.iter().position(|it| *it == item) {
            Some(at) => drop(selection.remove(at)),
            None => selection.push(item),
        });
    }

    /// Adds all states that lead to the selected ones, or that they lead to.
    pub(super) fn select_flow(self, flow: Flow) {
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        let from = self.selected_states();
        let mut selection = self.model.selection.get_untracked();
        for id in reached(&specification.pdfa, &from, flow) {
            let item = Selection::State(id);
            if !selection.contains(&item) {
                selection.insert(0, item);
            }
        }
        self.model.selection.set(selection);
    }

    /// The selected states, in the order in which they were selected.
    pub(crate) fn selected_states(self) -> Vec<StateId> {
        let state = |item: &Selection| match item {
            Selection::State(id) => Some(*id),
            Selection::Transition(..) => None,
        };
        self.model.selection.with(|selection| selection.iter().filter_map(state).collect())
    }
}

/// What `from` leads to, or what leads to it, itself included.
fn reached(pdfa: &Pdfa, from: &[StateId], flow: Flow) -> BTreeSet<StateId> {
    let mut reached: BTreeSet<StateId> = from.iter().copied().collect();
    loop {
        let before = reached.len();
        for (source, _, way) in pdfa.transitions() {
            match flow {
                Flow::Downstream if reached.contains(&source) => reached.insert(way.target),
                Flow::Upstream if reached.contains(&way.target) => reached.insert(source),
                _ => false,
            };
        }
        if reached.len() == before {
            return reached;
        }
    }
}

#[cfg(test)]
mod tests {
    use goalgraph::pdfa::Symbol;

    use super::*;

    #[test]
    fn upstream_leads_to_a_state_and_downstream_comes_from_it() {
        let (a, b, c) = (Symbol(0), Symbol(1), Symbol(2));
        let pdfa = Pdfa::from_words(&[vec![a, b], vec![c]]);
        let ids = |flow| reached(&pdfa, &[StateId(1)], flow).into_iter().map(|id| id.0).collect::<Vec<_>>();
        assert_eq!(ids(Flow::Upstream), [0, 1]);
        assert_eq!(ids(Flow::Downstream), [1, 2]);
    }
}
