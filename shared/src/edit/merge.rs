//! Two states become one.

use super::automaton::state;
use super::fold::fold;
use super::{EditError, Folded};
use crate::pdfa::{Pdfa, StateId};

/// Makes `merged` part of `kept` and folds what follows.
pub(super) fn merge_states(pdfa: &mut Pdfa, kept: StateId, merged: StateId) -> Result<Folded, EditError> {
    state(pdfa, kept)?;
    state(pdfa, merged)?;
    if kept == merged {
        return Err(EditError::SameState(kept));
    }
    Ok(fold(pdfa, vec![(kept, merged)], Some(kept)))
}
