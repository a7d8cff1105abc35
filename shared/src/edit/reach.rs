//! Which states words can get to.

use std::collections::BTreeSet;

use crate::pdfa::{Pdfa, StateId};

/// The states to which transitions lead from the initial state, whatever their weights, itself included.
pub(super) fn reachable(pdfa: &Pdfa) -> BTreeSet<StateId> {
    let mut reached = BTreeSet::new();
    let mut open = vec![pdfa.initial];
    while let Some(id) = open.pop() {
        if reached.insert(id) {
            open.extend(
                pdfa.states
                    .get(&id)
                    .into_iter()
                    .flat_map(|state| state.transitions.values().map(|way| way.target)),
            );
        }
    }
    reached
}

/// Removes the states that were among `reachable` and cannot be reached any longer.
///
/// A state that an expert has added but not yet connected stays.
pub(super) fn drop_unreachable(pdfa: &mut Pdfa, was_reachable: &BTreeSet<StateId>) {
    let reached = reachable(pdfa);
    pdfa.states.retain(|id, _| reached.contains(id) || !was_reachable.contains(id));
    // What stays without being reached may lead to what is gone.
    let ids: BTreeSet<StateId> = pdfa.states.keys().copied().collect();
    for state in pdfa.states.values_mut() {
        state.transitions.retain(|_, way| ids.contains(&way.target));
    }
}
