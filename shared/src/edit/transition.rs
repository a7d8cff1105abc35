//! New transitions, and new ends of present ones.

use super::automaton::{state, state_mut};
use super::{EditError, alphabet};
use crate::pdfa::{Pdfa, StateId, Symbol, Transition};
use crate::specification::Specification;

/// Adds a transition that weighs as much as one demonstration.
pub(super) fn add(
    specification: &mut Specification,
    source: StateId,
    symbol: Symbol,
    target: StateId,
) -> Result<(), EditError> {
    alphabet::known(specification, symbol)?;
    state(&specification.pdfa, source)?;
    connect(&mut specification.pdfa, source, symbol, Transition { target, count: 0, weight: 1.0 })
}

/// Moves the transition by `symbol` out of `source` to where `to` says: its new source and target.
pub(super) fn shift(
    pdfa: &mut Pdfa,
    source: StateId,
    symbol: Symbol,
    to: (StateId, StateId),
) -> Result<(), EditError> {
    let (new_source, target) = to;
    state(pdfa, new_source)?;
    let way = state_mut(pdfa, source)?.transitions.remove(&symbol);
    let way = way.ok_or(EditError::NoTransition(source, symbol))?;
    let count = if new_source == source { way.count } else { 0 };
    connect(pdfa, new_source, symbol, Transition { target, count, weight: way.weight })
}

/// Lets `way` lead out of `source`. A target to which nothing led completes what is completed on this way.
fn connect(pdfa: &mut Pdfa, source: StateId, symbol: Symbol, way: Transition) -> Result<(), EditError> {
    let target = way.target;
    let is_new = state(pdfa, target)?.completed.is_empty()
        && target != pdfa.initial
        && pdfa.transitions().all(|(_, _, other)| other.target != target);
    let from = state_mut(pdfa, source)?;
    if from.transitions.insert(symbol, way).is_some() {
        return Err(EditError::TransitionExists(source, symbol));
    }
    let mut completed = from.completed.clone();
    completed.insert(symbol);
    if is_new {
        state_mut(pdfa, target)?.completed = completed;
    }
    Ok(())
}
