//! Reading words and automaton again after the alphabet has changed.

use std::collections::{BTreeMap, BTreeSet};

use super::ids::NewIds;
use super::{EditError, Folded};
use crate::pdfa::{Pdfa, State, StateId, Symbol, Word};
use crate::specification::Specification;

/// What becomes of symbols: the sub-goal that stands for one from now on, or none.
pub(super) type Projection<'a> = &'a dyn Fn(Symbol) -> Option<Symbol>;

/// Reads words and automaton again; `once` is a symbol of which only the first stays in a word.
///
/// States are recognized by their completed sub-goals; each keeps the smallest id that has them, the initial one its
/// own. Names stay with ids. Weights and ends that differ from their counts were set by an expert and stay where
/// source, symbol and target are the same.
///
/// # Complexity
///
/// That of [`Pdfa::from_words`], and O(Q · A log Q) for Q states and A symbols.
pub(super) fn reread(
    specification: &mut Specification,
    projection: Projection<'_>,
    once: Option<Symbol>,
    first_new: StateId,
) -> Result<Folded, EditError> {
    if specification.demonstrations.is_empty() {
        return without_words(specification, projection);
    }
    for demonstration in &mut specification.demonstrations {
        demonstration.word = projected(&demonstration.word, projection, once);
    }
    let words: Vec<Word> =
        specification.demonstrations.iter().map(|demonstration| demonstration.word.clone()).collect();
    let old = &specification.pdfa;
    let mut by_completed: BTreeMap<BTreeSet<Symbol>, StateId> = BTreeMap::new();
    let set = |state: &State| state.completed.iter().filter_map(|&symbol| projection(symbol)).collect();
    for (&id, state) in old.states.iter().filter(|&(&id, _)| id != old.initial) {
        by_completed.entry(set(state)).or_insert(id);
    }
    by_completed.insert(BTreeSet::new(), old.initial);
    let mut pdfa = renumbered(Pdfa::from_words(&words), &by_completed, NewIds::above(old, first_new)?)?;
    for (id, state) in &mut pdfa.states {
        if let Some(before) = old.states.get(id) {
            carry_over(before, state);
        }
    }
    let of = |id: &StateId| Some((*id, *by_completed.get(&set(old.states.get(id)?))?));
    let gone = old.states.keys().filter(|id| !pdfa.states.contains_key(id));
    let folded = gone.filter_map(of).filter(|(_, stays)| pdfa.states.contains_key(stays)).collect();
    specification.pdfa = pdfa;
    Ok(folded)
}

/// An automaton without demonstrations, such as one that was drawn elsewhere, cannot be read again: what a symbol of it
/// means cannot be changed, but one that no transition uses can go.
fn without_words(specification: &mut Specification, projection: Projection<'_>) -> Result<Folded, EditError> {
    if let Some((_, symbol, _)) = specification.pdfa.transitions().find(|it| projection(it.1) != Some(it.1)) {
        return Err(EditError::NoWords(symbol));
    }
    for state in specification.pdfa.states.values_mut() {
        state.completed = state.completed.iter().filter_map(|&symbol| projection(symbol)).collect();
    }
    Ok(Folded::new())
}

fn projected(word: &[Symbol], projection: Projection<'_>, once: Option<Symbol>) -> Word {
    let mut seen = false;
    let first = |symbol: &Symbol| Some(*symbol) != once || !std::mem::replace(&mut seen, true);
    word.iter().filter_map(|&symbol| projection(symbol)).filter(first).collect()
}

/// `pdfa` with the ids of `by_completed`, and `new` ones for other states.
fn renumbered(
    pdfa: Pdfa,
    by_completed: &BTreeMap<BTreeSet<Symbol>, StateId>,
    mut new: NewIds,
) -> Result<Pdfa, EditError> {
    let mut ids = BTreeMap::new();
    for (&id, state) in &pdfa.states {
        let known = by_completed.get(&state.completed);
        ids.insert(id, known.map_or_else(|| new.next(), |&known| Ok(known))?);
    }
    let id_of = |id: StateId| ids.get(&id).copied().unwrap_or(id);
    let rename = |(id, mut state): (StateId, State)| {
        for way in state.transitions.values_mut() {
            way.target = id_of(way.target);
        }
        (id_of(id), state)
    };
    Ok(Pdfa { initial: id_of(pdfa.initial), states: pdfa.states.into_iter().map(rename).collect() })
}

/// Gives `state` what an expert changed in the one that had its id `before`.
fn carry_over(before: &State, state: &mut State) {
    state.name.clone_from(&before.name);
    if differs(before.end_weight, before.end_count) || before.accepting != (before.end_count > 0) {
        state.accepting = before.accepting;
        state.end_weight = before.end_weight;
    }
    for (symbol, way) in &before.transitions {
        if let Some(present) = state.transitions.get_mut(symbol)
            && way.target == present.target
            && differs(way.weight, way.count)
        {
            present.weight = way.weight;
        }
    }
}

/// Whether an expert has changed the weight.
fn differs(weight: f64, count: u64) -> bool {
    (weight - count as f64).abs() > 0.0
}
