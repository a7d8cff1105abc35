//! Ids of new states.

use super::EditError;
use crate::pdfa::{Pdfa, StateId};

/// Ids that no state has, counted upwards.
pub(super) struct NewIds {
    next: Option<u32>,
}

impl NewIds {
    /// The ids from `first` on, which must be above all that `pdfa` has.
    pub(super) fn above(pdfa: &Pdfa, first: StateId) -> Result<Self, EditError> {
        match pdfa.states.keys().next_back() {
            Some(&last) if last.0 == u32::MAX => Ok(Self { next: None }),
            Some(&last) if first <= last => Err(EditError::IdTaken(first, last)),
            _ => Ok(Self { next: Some(first.0) }),
        }
    }

    /// The next of them.
    pub(super) fn next(&mut self) -> Result<StateId, EditError> {
        let id = self.next.ok_or(EditError::NoIdLeft)?;
        self.next = id.checked_add(1);
        Ok(StateId(id))
    }
}
