//! Which sub-goals and states of two specifications are the same.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::pdfa::{Pdfa, State, StateId, Symbol, Transition, Word};
use crate::specification::{DemonstrationWord, Specification, SubGoal};

/// The symbol in the union of every sub-goal of `before`: that of its counterpart, or else one that nothing after has.
pub(super) fn symbols(before: &[SubGoal], after: &[SubGoal]) -> BTreeMap<Symbol, Symbol> {
    let mut matched = BTreeMap::new();
    let mut taken = BTreeSet::new();
    let agreements: [fn(&SubGoal, &SubGoal) -> bool; 3] = [
        |old, new| old.id == new.id && old.name == new.name,
        |old, new| old.name == new.name,
        |old, new| old.id == new.id && old.ball == new.ball,
    ];
    for agree in agreements {
        for old in before {
            let same = after.iter().find(|new| agree(old, new) && !taken.contains(&new.id));
            if let Some(new) = same.filter(|_| !matched.contains_key(&old.id)) {
                matched.insert(old.id, new.id);
                taken.insert(new.id);
            }
        }
    }
    let mut free = Free::beside(after.iter().map(|sub_goal| sub_goal.id.0));
    for old in before {
        matched.entry(old.id).or_insert_with(|| Symbol(free.take(old.id.0, before.iter().map(|it| it.id.0))));
    }
    matched
}

/// Numbers that are not used yet.
pub(super) struct Free {
    used: BTreeSet<u32>,
}

impl Free {
    /// All but those.
    pub(super) fn beside(used: impl Iterator<Item = u32>) -> Self {
        Self { used: used.collect() }
    }

    /// `wanted` where it is free, or else one above all used ones and `others`.
    pub(super) fn take(&mut self, wanted: u32, others: impl Iterator<Item = u32>) -> u32 {
        let above = || self.used.iter().copied().chain(others).max().map_or(0, |last| last.saturating_add(1));
        let number = if self.used.contains(&wanted) { above() } else { wanted };
        // Above the largest number there is none: the first that is free, then.
        let number = if self.used.contains(&number) {
            (0..=u32::MAX).find(|number| !self.used.contains(number)).unwrap_or(number)
        } else {
            number
        };
        self.used.insert(number);
        number
    }
}

/// `specification` with other symbols. One that is no sub-goal stays.
pub(super) fn with_symbols(
    specification: &Specification,
    symbols: &BTreeMap<Symbol, Symbol>,
) -> Specification {
    let named = |symbol: &Symbol| symbols.get(symbol).copied().unwrap_or(*symbol);
    let way = |(symbol, way): (&Symbol, &Transition)| (named(symbol), way.clone());
    let state = |(&id, state): (&StateId, &State)| {
        let completed = state.completed.iter().map(named).collect();
        let transitions = state.transitions.iter().map(way).collect();
        (id, State { completed, transitions, ..state.clone() })
    };
    let word = |word: &Word| word.iter().map(named).collect();
    let sub_goal = |it: &SubGoal| SubGoal { id: named(&it.id), ..it.clone() };
    let demonstration = |it: &DemonstrationWord| DemonstrationWord { word: word(&it.word), ..it.clone() };
    let pdfa = Pdfa {
        initial: specification.pdfa.initial,
        states: specification.pdfa.states.iter().map(state).collect(),
    };
    Specification {
        sub_goals: specification.sub_goals.iter().map(sub_goal).collect(),
        demonstrations: specification.demonstrations.iter().map(demonstration).collect(),
        pdfa,
        ..specification.clone()
    }
}

/// The ids, in the union, of the states before.
#[derive(Debug, Default)]
pub(super) struct States {
    matched: BTreeMap<StateId, StateId>,
    taken: BTreeSet<StateId>,
    removed: BTreeMap<StateId, StateId>,
}

/// Whether two states may be the same: id and state before, id and state after.
type Agree = fn((StateId, &State), (StateId, &State)) -> bool;

/// Matches the states of two automata over the same symbols, see [`super::difference`].
pub(super) fn states(before: &Pdfa, after: &Pdfa) -> States {
    let completed: Agree = |(_, old), (_, new)| old.completed == new.completed;
    let mut states = States::default();
    states.pair(before.initial, after.initial);
    states.walk(before, after, |(old, _), (new, _)| old == new);
    states.by_id(before, after, completed);
    states.walk(before, after, completed);
    states.walk(before, after, |_, _| true);
    states.by_id(before, after, |_, _| true);
    let mut free = Free::beside(after.states.keys().map(|id| id.0));
    for old in before.states.keys().filter(|id| !states.matched.contains_key(id)) {
        let id = StateId(free.take(old.0, before.states.keys().map(|id| id.0)));
        states.removed.insert(*old, id);
    }
    states
}

impl States {
    /// The id in the union of a state before.
    pub(super) fn in_union(&self, old: StateId) -> StateId {
        self.matched.get(&old).or_else(|| self.removed.get(&old)).copied().unwrap_or(old)
    }

    /// The states that are no more, each with its id in the union.
    pub(super) fn removed(&self) -> impl Iterator<Item = (StateId, StateId)> + '_ {
        self.removed.iter().map(|(old, id)| (*old, *id))
    }

    fn pair(&mut self, old: StateId, new: StateId) {
        self.matched.insert(old, new);
        self.taken.insert(new);
    }

    fn is_free(&self, old: StateId, new: StateId) -> bool {
        !self.matched.contains_key(&old) && !self.taken.contains(&new)
    }

    /// Pairs what the same sub-goals lead to from states that are paired, in breadth.
    fn walk(&mut self, before: &Pdfa, after: &Pdfa, agree: Agree) {
        let mut open: VecDeque<(StateId, StateId)> =
            self.matched.iter().map(|(old, new)| (*old, *new)).collect();
        while let Some((old, new)) = open.pop_front() {
            let (Some(old), Some(new)) = (before.states.get(&old), after.states.get(&new)) else { continue };
            for (symbol, way) in &old.transitions {
                let Some(other) = new.transitions.get(symbol) else { continue };
                let pair = (way.target, other.target);
                if self.is_free(pair.0, pair.1) && agreeing(before, after, pair, agree) {
                    self.pair(pair.0, pair.1);
                    open.push_back(pair);
                }
            }
        }
    }

    fn by_id(&mut self, before: &Pdfa, after: &Pdfa, agree: Agree) {
        for &id in before.states.keys() {
            if self.is_free(id, id) && agreeing(before, after, (id, id), agree) {
                self.pair(id, id);
            }
        }
    }
}

fn agreeing(before: &Pdfa, after: &Pdfa, (old, new): (StateId, StateId), agree: Agree) -> bool {
    let both = before.states.get(&old).zip(after.states.get(&new));
    both.is_some_and(|(old_state, new_state)| agree((old, old_state), (new, new_state)))
}
