//! Making a word accepted.

use std::collections::{BTreeMap, BTreeSet};

use super::automaton::state_mut;
use super::fold::plus;
use super::ids::NewIds;
use super::{EditError, alphabet};
use crate::pdfa::{Pdfa, State, StateId, Symbol, Transition};
use crate::specification::Specification;

/// Lets `word` weigh one demonstration more on all of its way.
pub(super) fn add_word(
    specification: &mut Specification,
    word: &[Symbol],
    first_new: StateId,
) -> Result<(), EditError> {
    word.iter().try_for_each(|&symbol| alphabet::known(specification, symbol))?;
    let pdfa = &mut specification.pdfa;
    if accepts(pdfa, word) {
        return Err(EditError::Accepted);
    }
    let mut new = NewIds::above(pdfa, first_new)?;
    let mut by_completed: BTreeMap<BTreeSet<Symbol>, StateId> = BTreeMap::new();
    for (&id, state) in &pdfa.states {
        by_completed.entry(state.completed.clone()).or_insert(id);
    }
    let mut source = pdfa.initial;
    for &symbol in word {
        source = step(pdfa, source, symbol, &mut by_completed, &mut new)?;
    }
    let end = state_mut(pdfa, source)?;
    end.end_weight = if end.accepting { plus(end.end_weight, 1.0) } else { 1.0 };
    end.accepting = true;
    Ok(())
}

/// Goes on by `symbol`, where need be by a new transition and to a new state; returns where it leads.
fn step(
    pdfa: &mut Pdfa,
    source: StateId,
    symbol: Symbol,
    by_completed: &mut BTreeMap<BTreeSet<Symbol>, StateId>,
    new: &mut NewIds,
) -> Result<StateId, EditError> {
    let state = state_mut(pdfa, source)?;
    if let Some(way) = state.transitions.get_mut(&symbol) {
        way.weight = plus(way.weight, 1.0);
        return Ok(way.target);
    }
    let mut completed = state.completed.clone();
    completed.insert(symbol);
    let target = match by_completed.get(&completed) {
        Some(&target) => target,
        None => new.next()?,
    };
    state.transitions.insert(symbol, Transition { target, count: 0, weight: 1.0 });
    by_completed.insert(completed.clone(), target);
    pdfa.states.entry(target).or_insert_with(|| State { completed, ..State::default() });
    Ok(target)
}

/// Whether `word` has a probability above zero, however small: every step on its way has.
pub(super) fn accepts(pdfa: &Pdfa, word: &[Symbol]) -> bool {
    let mut id = pdfa.initial;
    for &symbol in word {
        let Some(state) = pdfa.states.get(&id) else { return false };
        match state.transitions.get(&symbol) {
            Some(way) if way.weight / total_weight(state) > 0.0 => id = way.target,
            _ => return false,
        }
    }
    let ends = |state: &State| state.accepting && state.end_weight / total_weight(state) > 0.0;
    pdfa.states.get(&id).is_some_and(ends)
}

/// The sum of the weights of all that may happen in `state`.
pub(super) fn total_weight(state: &State) -> f64 {
    let end_weight = if state.accepting { state.end_weight } else { 0.0 };
    state.transitions.values().map(|way| way.weight).sum::<f64>() + end_weight
}
