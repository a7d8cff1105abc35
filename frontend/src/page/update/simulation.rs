//! Walking through the automaton.

use goalgraph::pdfa::Symbol;
use leptos::prelude::*;

use super::App;
use crate::page::derived::ways;
use crate::page::model::Notice;

impl App {
    /// Begins a walk at the initial state, or ends it.
    pub(super) fn walk(self, on: bool) {
        self.model.simulation.update(|walk| {
            walk.on = on;
            walk.word.clear();
        });
        self.model.draft.set(None);
        self.say(Notice::calm(if on {
            "Simulating: click a transition to take it."
        } else {
            "The walk is over."
        }));
    }

    /// Completes a sub-goal, where there is a way.
    pub(super) fn step(self, symbol: Symbol) {
        let (Some(specification), Some(state)) =
            (self.derived.specification.get_untracked(), self.derived.present.get_untracked())
        else {
            return;
        };
        let name = specification.name_of(symbol);
        if specification.pdfa.transition(state, symbol).is_none() {
            return self.say(Notice::alarm(format!("{name} is not possible in {state}.")));
        }
        if self.model.unavailable.with_untracked(|unavailable| unavailable.contains(&symbol)) {
            return self.say(Notice::alarm(format!("{name} is switched off.")));
        }
        self.model.simulation.update(|walk| {
            // An edit may have taken the later steps.
            let taken = ways(&specification.pdfa, &walk.word).len();
            walk.word.truncate(taken);
            walk.word.push(symbol);
        });
    }

    /// Goes back to after the first `steps` steps.
    pub(super) fn step_back(self, steps: usize) {
        self.model.simulation.update(|walk| walk.word.truncate(steps));
    }
}
