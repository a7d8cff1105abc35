//! Edits of one state.

use super::ids::NewIds;
use super::{EditError, name};
use crate::pdfa::{Pdfa, State, StateId};

/// The state `id`.
pub(super) fn state(pdfa: &Pdfa, id: StateId) -> Result<&State, EditError> {
    pdfa.states.get(&id).ok_or(EditError::NoState(id))
}

/// The state `id`, to be changed.
pub(super) fn state_mut(pdfa: &mut Pdfa, id: StateId) -> Result<&mut State, EditError> {
    pdfa.states.get_mut(&id).ok_or(EditError::NoState(id))
}

/// Makes weights equal to counts.
pub(super) fn reset_weights(pdfa: &mut Pdfa, id: StateId) -> Result<(), EditError> {
    let state = state_mut(pdfa, id)?;
    let ends = state.accepting && state.end_count > 0;
    if !ends && state.transitions.values().all(|way| way.count == 0) {
        return Err(EditError::NoEvidence(id));
    }
    state.end_weight = if ends { state.end_count as f64 } else { 0.0 };
    for way in state.transitions.values_mut() {
        way.weight = way.count as f64;
    }
    Ok(())
}

/// Lets words end in `id`, or not.
pub(super) fn set_accepting(pdfa: &mut Pdfa, id: StateId, accepting: bool) -> Result<(), EditError> {
    let state = state_mut(pdfa, id)?;
    state.accepting = accepting;
    if !accepting {
        state.end_weight = 0.0;
    } else if state.end_weight == 0.0 {
        state.end_weight = state.end_count.max(1) as f64;
    }
    Ok(())
}

/// Names `id`, or takes its name away.
pub(super) fn rename_state(pdfa: &mut Pdfa, id: StateId, name: &str) -> Result<(), EditError> {
    state_mut(pdfa, id)?.name = name::optional(name)?;
    Ok(())
}

/// Adds a state to which nothing leads.
pub(super) fn add_state(pdfa: &mut Pdfa, id: StateId) -> Result<(), EditError> {
    let id = NewIds::above(pdfa, id)?.next()?;
    pdfa.states.insert(id, State::default());
    Ok(())
}
