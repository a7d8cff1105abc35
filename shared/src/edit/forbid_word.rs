//! Making a word rejected, and nothing else.

use std::collections::BTreeMap;

use super::add_word::{accepts, total_weight};
use super::ids::NewIds;
use super::{EditError, alphabet};
use crate::pdfa::{Pdfa, State, StateId, Symbol, Word};
use crate::specification::Specification;

/// Takes `word` out of the language.
///
/// From the first state on that something else leads to as well, the states on the word's way are doubled: the doubles
/// belong to this word alone. Then its end goes, and each transition of its way loses the weight that led there, so
/// that the probabilities of all other words keep their proportions.
///
/// # Complexity
///
/// O(n · A + T) for n symbols, A symbols in the alphabet and T transitions.
pub(super) fn forbid_word(
    specification: &mut Specification,
    word: &[Symbol],
    first_new: StateId,
) -> Result<(), EditError> {
    word.iter().try_for_each(|&symbol| alphabet::known(specification, symbol))?;
    if !accepts(&specification.pdfa, word) {
        return Err(EditError::NotAccepted);
    }
    let words = specification.demonstrations.iter().map(|demonstration| &demonstration.word);
    let evidence = evidence(words, word);
    let pdfa = &mut specification.pdfa;
    let new = NewIds::above(pdfa, first_new)?;
    let path = split(pdfa, word, &evidence, new)?;
    take_away(pdfa, word, &path);
    trim(pdfa, word, &path);
    Ok(())
}

/// What demonstrations did next once they had begun like the word.
#[derive(Clone, Default)]
struct Evidence {
    ended: u64,
    went_on: BTreeMap<Symbol, u64>,
}

/// One for each prefix of `word`, the empty one and itself included.
fn evidence<'a>(demonstrated: impl Iterator<Item = &'a Word>, word: &[Symbol]) -> Vec<Evidence> {
    let mut evidence = vec![Evidence::default(); word.len() + 1];
    for shown in demonstrated {
        let common = shown.iter().zip(word).take_while(|(one, other)| one == other).count();
        for (next, at) in shown.iter().zip(&mut evidence[..=common]) {
            *at.went_on.entry(*next).or_default() += 1;
        }
        if common == shown.len() {
            evidence[common].ended += 1;
        }
    }
    evidence
}

/// Splits the states that `word` shares with other ways; returns the states on its way, which are its own now.
fn split(
    pdfa: &mut Pdfa,
    word: &[Symbol],
    evidence: &[Evidence],
    mut new: NewIds,
) -> Result<Vec<StateId>, EditError> {
    let mut path = vec![pdfa.initial];
    for &symbol in word {
        let before = path.last().copied().unwrap_or(pdfa.initial);
        path.extend(pdfa.transition(before, symbol).map(|way| way.target));
    }
    let shared = first_shared(pdfa, &path);
    for at in shared..path.len() {
        let double = new.next()?;
        if let Some(state) = pdfa.states.get_mut(&path[at]) {
            let state = double_of(state, &evidence[at]);
            pdfa.states.insert(double, state);
        }
        path[at] = double;
    }
    for at in shared..path.len() {
        match at.checked_sub(1) {
            None => pdfa.initial = path[0],
            Some(before) => {
                let state = pdfa.states.get_mut(&path[before]);
                if let Some(way) = state.and_then(|state| state.transitions.get_mut(&word[before])) {
                    way.target = path[at];
                }
            }
        }
    }
    Ok(path)
}

/// How many states at the beginning of `path` are reached by no other word than this one's beginnings.
fn first_shared(pdfa: &Pdfa, path: &[StateId]) -> usize {
    let mut incoming: BTreeMap<StateId, usize> = BTreeMap::from([(pdfa.initial, 1)]);
    for (_, _, way) in pdfa.transitions() {
        *incoming.entry(way.target).or_default() += 1;
    }
    path.iter().take_while(|id| incoming.get(id) == Some(&1)).count()
}

/// A state like `state`, which gives it what is its evidence. The name stays with the first.
fn double_of(state: &mut State, evidence: &Evidence) -> State {
    let mut double = State { name: None, ..state.clone() };
    double.end_count = state.end_count.min(evidence.ended);
    state.end_count -= double.end_count;
    for (symbol, way) in &mut double.transitions {
        if let Some(present) = state.transitions.get_mut(symbol) {
            way.count = present.count.min(evidence.went_on.get(symbol).copied().unwrap_or(0));
            present.count -= way.count;
        }
    }
    double
}

/// Takes the end of `path` away and, backwards, the weight that led to it.
fn take_away(pdfa: &mut Pdfa, word: &[Symbol], path: &[StateId]) {
    let mut left = 0.0;
    for (at, id) in path.iter().enumerate().rev() {
        let Some(state) = pdfa.states.get_mut(id) else { return };
        let before = total_weight(state);
        match word.get(at) {
            None => {
                state.accepting = false;
                state.end_weight = 0.0;
            }
            Some(symbol) => {
                if let Some(way) = state.transitions.get_mut(symbol) {
                    let rest = way.weight * left;
                    // What is left of the smallest numbers may have no number: words beyond must not go with it.
                    if rest > 0.0 || left == 0.0 {
                        way.weight = rest;
                    }
                }
            }
        }
        left = (total_weight(state) / before).min(1.0);
    }
}

/// Removes states at the end of `path` where nothing is left to do. The initial state stays.
fn trim(pdfa: &mut Pdfa, word: &[Symbol], path: &[StateId]) {
    for (before, symbol) in word.iter().enumerate().rev() {
        let id = path[before + 1];
        if pdfa.states.get(&id).is_none_or(|state| state.accepting || !state.transitions.is_empty()) {
            return;
        }
        pdfa.states.remove(&id);
        if let Some(state) = pdfa.states.get_mut(&path[before]) {
            state.transitions.remove(symbol);
        }
    }
}
