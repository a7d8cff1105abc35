//! Taking states and transitions out, with or without the ways through them.

use super::automaton::{state, state_mut};
use super::fold::{add_way, fold, plus};
use super::reach::{drop_unreachable, reachable};
use super::{EditError, Folded, Pruned};
use crate::pdfa::{Pdfa, State, StateId, Symbol, Transition};

/// Removes the state `id`.
pub(super) fn prune_state(pdfa: &mut Pdfa, id: StateId, ways: Pruned) -> Result<Folded, EditError> {
    if id == pdfa.initial {
        return Err(EditError::InitialPruned(id));
    }
    let was_reachable = reachable(pdfa);
    let pruned = pdfa.states.remove(&id).ok_or(EditError::NoState(id))?;
    let mut pairs = Vec::new();
    for state in pdfa.states.values_mut() {
        let incoming = state.transitions.extract_if(.., |_, way| way.target == id);
        let incoming: Vec<f64> = incoming.map(|(_, way)| way.weight).collect();
        for weight in incoming.into_iter().filter(|_| ways == Pruned::Heal) {
            take_over(state, id, &pruned, weight, &mut pairs);
        }
    }
    let mut folded = fold(pdfa, pairs, None);
    drop_unreachable(pdfa, &was_reachable);
    folded.retain(|_, stays| pdfa.states.contains_key(stays));
    Ok(folded)
}

/// Removes the transition by `symbol` out of `source`.
pub(super) fn prune_transition(
    pdfa: &mut Pdfa,
    source: StateId,
    symbol: Symbol,
    ways: Pruned,
) -> Result<Folded, EditError> {
    let was_reachable = reachable(pdfa);
    let from = state_mut(pdfa, source)?;
    let gone = from.transitions.remove(&symbol).ok_or(EditError::NoTransition(source, symbol))?;
    let mut pairs = Vec::new();
    if ways == Pruned::Heal && gone.target != source {
        let target = state(pdfa, gone.target)?.clone();
        take_over(state_mut(pdfa, source)?, gone.target, &target, gone.weight, &mut pairs);
    }
    let mut folded = fold(pdfa, pairs, None);
    drop_unreachable(pdfa, &was_reachable);
    folded.retain(|_, stays| pdfa.states.contains_key(stays));
    Ok(folded)
}

/// Gives `state` the outcomes of `pruned`, whose id is `id`, with a share of `weight` each in proportion to theirs.
///
/// A self-loop of `pruned` only delays its other outcomes, which share its part. Where all weigh nothing, they weigh
/// nothing here, too.
fn take_over(
    state: &mut State,
    id: StateId,
    pruned: &State,
    weight: f64,
    pairs: &mut Vec<(StateId, StateId)>,
) {
    let ways = || pruned.transitions.iter().filter(|(_, way)| way.target != id);
    let end_weight = if pruned.accepting { pruned.end_weight } else { 0.0 };
    let total = ways().map(|(_, way)| way.weight).sum::<f64>() + end_weight;
    let share = |part: f64| if total > 0.0 { weight * (part / total) } else { 0.0 };
    for (&symbol, way) in ways() {
        let healed = Transition { target: way.target, count: 0, weight: share(way.weight) };
        add_way(state, symbol, healed, pairs);
    }
    if pruned.accepting {
        let before = if state.accepting { state.end_weight } else { 0.0 };
        state.end_weight = plus(before, share(end_weight));
        state.accepting = true;
    }
}
