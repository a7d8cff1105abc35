//! Folding: making states one, and all that must be one because of it.

use super::Folded;
use crate::pdfa::{Pdfa, State, StateId, Symbol, Transition};

/// The largest weight of a file.
pub(super) const LARGEST_WEIGHT: f64 = 1e100;

/// Merges both states of each pair, and where that gives a state two transitions by one symbol, their targets, and so
/// on: the finest partition of the states that has every pair in one block and is deterministic.
///
/// The block of `kept` keeps that id, every other block its smallest. The result does not depend on the order in which
/// pairs are merged, but for the last digit of weights that are no whole numbers.
///
/// # Complexity
///
/// O(Q · A · log Q) for Q states that are merged and A symbols, O(T log Q) for T transitions that are renamed.
pub(super) fn fold(pdfa: &mut Pdfa, mut pairs: Vec<(StateId, StateId)>, kept: Option<StateId>) -> Folded {
    let mut folded = Folded::new();
    while let Some((one, other)) = pairs.pop() {
        let (one, other) = (find(&mut folded, one), find(&mut folded, other));
        let (stays, goes) = if Some(other) == kept || (other < one && Some(one) != kept) {
            (other, one)
        } else {
            (one, other)
        };
        if stays == goes {
            continue;
        }
        if let Some(gone) = pdfa.states.remove(&goes)
            && let Some(state) = pdfa.states.get_mut(&stays)
        {
            add(state, gone, &mut pairs);
        }
        folded.insert(goes, stays);
    }
    if folded.is_empty() {
        return folded;
    }
    for way in pdfa.states.values_mut().flat_map(|state| state.transitions.values_mut()) {
        way.target = find(&mut folded, way.target);
    }
    pdfa.initial = find(&mut folded, pdfa.initial);
    let gone: Vec<StateId> = folded.keys().copied().collect();
    gone.into_iter().map(|id| (id, find(&mut folded, id))).collect()
}

/// What `id` is part of now; remembers it for everything on the way there.
fn find(folded: &mut Folded, id: StateId) -> StateId {
    let mut root = id;
    while let Some(&next) = folded.get(&root) {
        root = next;
    }
    let mut next = id;
    while next != root {
        next = folded.insert(next, root).unwrap_or(root);
    }
    root
}

/// Makes `gone` part of `state`; the targets of two transitions by one symbol become another pair.
fn add(state: &mut State, gone: State, pairs: &mut Vec<(StateId, StateId)>) {
    let end_weight = plus(final_weight(state), final_weight(&gone));
    state.end_weight = end_weight;
    state.accepting |= gone.accepting;
    state.end_count = state.end_count.saturating_add(gone.end_count);
    state.completed.retain(|symbol| gone.completed.contains(symbol));
    if state.name.is_none() {
        state.name = gone.name;
    }
    for (symbol, way) in gone.transitions {
        add_way(state, symbol, way, pairs);
    }
}

/// What the end of a state weighs: where no word may end, a weight that a file has left there does not count.
fn final_weight(state: &State) -> f64 {
    if state.accepting { state.end_weight } else { 0.0 }
}

/// Gives `state` one more way out by `symbol`.
pub(super) fn add_way(
    state: &mut State,
    symbol: Symbol,
    way: Transition,
    pairs: &mut Vec<(StateId, StateId)>,
) {
    match state.transitions.get_mut(&symbol) {
        Some(present) => {
            present.count = present.count.saturating_add(way.count);
            present.weight = plus(present.weight, way.weight);
            if present.target != way.target {
                pairs.push((present.target, way.target));
            }
        }
        None => {
            state.transitions.insert(symbol, way);
        }
    }
}

/// The sum of two weights, as far as a file can hold it.
pub(super) fn plus(one: f64, other: f64) -> f64 {
    (one + other).min(LARGEST_WEIGHT)
}
