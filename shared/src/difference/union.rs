//! One automaton that shows what is and what is no more.

use std::collections::BTreeMap;

use super::matching::{Free, States};
use crate::pdfa::{State, StateId, Symbol, Transition};
use crate::specification::Specification;

/// The union, with what its transitions meant where they come from.
pub(super) struct Union {
    /// What is after, and what is no more.
    pub(super) specification: Specification,
    /// The probability of every transition where it comes from.
    pub(super) chances: BTreeMap<(StateId, Symbol), f64>,
    /// Transitions that lead elsewhere now, each with the symbol under which it is shown as it was.
    pub(super) ghosts: BTreeMap<(StateId, Symbol), Symbol>,
}

/// The union of two specifications over the same symbols.
pub(super) fn union(before: &Specification, after: &Specification, states: &States) -> Union {
    let now = super::chances(after);
    let chance = |(source, symbol, _): (StateId, Symbol, &Transition)| {
        ((source, symbol), now.transition(source, symbol))
    };
    let mut union = Union {
        chances: after.pdfa.transitions().map(chance).collect(),
        specification: after.clone(),
        ghosts: BTreeMap::new(),
    };
    let gone = before.sub_goals.iter().filter(|it| after.sub_goal(it.id).is_none());
    union.specification.sub_goals.extend(gone.cloned());
    for (old, id) in states.removed() {
        let state = before.pdfa.states.get(&old).cloned().unwrap_or_default();
        let state = State { transitions: BTreeMap::new(), end_count: 0, end_weight: 0.0, ..state };
        union.specification.pdfa.states.insert(id, state);
    }
    union.add_transitions(before, states);
    union
}

impl Union {
    fn add_transitions(&mut self, before: &Specification, states: &States) {
        let were = super::chances(before);
        let used = self.specification.sub_goals.iter().map(|it| it.id.0);
        let ways = self.specification.pdfa.transitions().map(|(_, symbol, _)| symbol.0);
        let mut free = Free::beside(used.chain(ways).collect::<Vec<_>>().into_iter());
        let mut looks = BTreeMap::new();
        for (old_source, symbol, way) in before.pdfa.transitions() {
            let (source, target) = (states.in_union(old_source), states.in_union(way.target));
            let shown = match self.specification.pdfa.transition(source, symbol) {
                Some(there) if there.target == target => continue,
                Some(_) => {
                    let ghost = *looks.entry(symbol).or_insert_with(|| self.ghost(&mut free, symbol));
                    self.ghosts.insert((source, symbol), ghost);
                    ghost
                }
                None => symbol,
            };
            let gone = Transition { target, count: 0, weight: 0.0 };
            if let Some(state) = self.specification.pdfa.states.get_mut(&source) {
                state.transitions.insert(shown, gone);
                self.chances.insert((source, shown), were.transition(old_source, symbol));
            }
        }
    }

    /// A symbol for transitions as they were, beside `symbol` for what they are now. It looks like the sub-goal itself.
    fn ghost(&mut self, free: &mut Free, symbol: Symbol) -> Symbol {
        let ghost = Symbol(free.take(symbol.0, std::iter::empty()));
        if let Some(mut sub_goal) = self.specification.sub_goal(symbol).cloned() {
            sub_goal.id = ghost;
            self.specification.sub_goals.push(sub_goal);
        }
        ghost
    }
}
