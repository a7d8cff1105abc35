//! Small automata of any shape, and their words written out.

#![allow(dead_code, reason = "every test uses some of it")]

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::pdfa::{Pdfa, Probabilities, Semantics, State, StateId, Symbol, Transition, Word};
use goalgraph::specification::{DemonstrationWord, Specification};
use proptest::prelude::*;

/// Source, symbol, target, weight.
pub(crate) type Way = (u32, u32, u32, f64);

/// An automaton with these ways and these weights of ending in its states; it starts in state 0.
pub(crate) fn automaton(ways: &[Way], ends: &[f64]) -> Pdfa {
    let state = |&end_weight: &f64| State { accepting: end_weight > 0.0, end_weight, ..State::default() };
    let mut states: BTreeMap<StateId, State> =
        ends.iter().enumerate().map(|(index, end)| (StateId(index as u32), state(end))).collect();
    for &(source, symbol, target, weight) in ways {
        let way = Transition { target: StateId(target), count: 0, weight };
        states.get_mut(&StateId(source)).unwrap().transitions.insert(Symbol(symbol), way);
    }
    Pdfa { initial: StateId(0), states }
}

/// Five states, three symbols: cycles, dead ends, weights of zero and states that cannot be reached.
pub(crate) fn any_automaton() -> impl Strategy<Value = Pdfa> {
    let ways = prop::collection::vec((0..5_u32, 0..3_u32, 0..5_u32, (0..4_u32).prop_map(f64::from)), 0..14);
    let ends = prop::collection::vec(prop_oneof![2 => Just(0.0), 1 => (0..3_u32).prop_map(f64::from)], 5);
    (ways, ends).prop_map(|(ways, ends)| automaton(&ways, &ends))
}

/// As [`any_automaton`], without cycles.
pub(crate) fn acyclic_automaton() -> impl Strategy<Value = Pdfa> {
    any_automaton().prop_map(without_cycles)
}

/// Two automata that agree on many of their states, as before and after a correction.
pub(crate) fn any_change() -> impl Strategy<Value = (Pdfa, Pdfa)> {
    let change = (0..5_u32, 0..3_u32, 0..5_u32, (0..4_u32).prop_map(f64::from));
    let changed = (any_automaton(), change).prop_map(|(before, (source, symbol, target, weight))| {
        let mut after = before.clone();
        let way = Transition { target: StateId(target), count: 0, weight };
        after.states.get_mut(&StateId(source)).unwrap().transitions.insert(Symbol(symbol), way);
        (before, after)
    });
    prop_oneof![(any_automaton(), any_automaton()), changed]
}

/// As [`any_change`], without cycles.
pub(crate) fn acyclic_change() -> impl Strategy<Value = (Pdfa, Pdfa)> {
    any_change().prop_map(|(before, after)| (without_cycles(before), without_cycles(after)))
}

fn without_cycles(mut pdfa: Pdfa) -> Pdfa {
    for (&source, state) in &mut pdfa.states {
        state.transitions.retain(|_, way| way.target > source);
    }
    pdfa
}

pub(crate) fn probabilities(pdfa: &Pdfa) -> Probabilities {
    pdfa.probabilities(Semantics::MaximumLikelihood)
}

/// All words of at most `length` symbols that are accepted from the initial state, with their probabilities.
pub(crate) fn words(pdfa: &Pdfa, length: usize) -> BTreeMap<Word, f64> {
    let probabilities = probabilities(pdfa);
    let mut words = BTreeMap::new();
    let mut open = vec![(Word::new(), pdfa.initial, 1.0)];
    while let Some((word, state, probability)) = open.pop() {
        let end = probabilities.end(state);
        if end > 0.0 {
            words.insert(word.clone(), probability * end);
        }
        for (&symbol, way) in &pdfa.states[&state].transitions {
            let taken = probabilities.transition(state, symbol);
            if taken > 0.0 && word.len() < length {
                let longer = word.iter().copied().chain([symbol]).collect();
                open.push((longer, way.target, probability * taken));
            }
        }
    }
    words
}

/// The words of `words` that are not in `others`, shortest first, then in the order of the alphabet.
pub(crate) fn only_in(words: &BTreeMap<Word, f64>, others: &BTreeMap<Word, f64>) -> Vec<(Word, f64)> {
    let mut only: Vec<(Word, f64)> = words
        .iter()
        .filter(|(word, _)| !others.contains_key(*word))
        .map(|(word, p)| (word.clone(), *p))
        .collect();
    only.sort_by_key(|(word, _)| (word.len(), word.clone()));
    only
}

/// The states from which an end of probability above zero can be reached, found by trying all ways again and again.
pub(crate) fn live(pdfa: &Pdfa, probabilities: &Probabilities) -> BTreeSet<StateId> {
    let mut live: BTreeSet<StateId> =
        pdfa.states.keys().copied().filter(|&state| probabilities.end(state) > 0.0).collect();
    for _ in 0..pdfa.states.len() {
        for (source, symbol, way) in pdfa.transitions() {
            if probabilities.transition(source, symbol) > 0.0 && live.contains(&way.target) {
                live.insert(source);
            }
        }
    }
    live
}

/// An automaton in which `number` sub-goals are completed in any order, all orders alike.
pub(crate) fn any_order(number: u32) -> Pdfa {
    let states = (0..1_u32 << number).map(|done| {
        let open = (0..number).filter(|symbol| done >> symbol & 1 == 0);
        let way = |symbol: u32| {
            let target = StateId(done | 1 << symbol);
            (Symbol(symbol), Transition { target, count: 0, weight: 1.0 })
        };
        let last = done + 1 == 1 << number;
        let state = State {
            completed: (0..number).filter(|symbol| done >> symbol & 1 == 1).map(Symbol).collect(),
            accepting: last,
            end_count: 0,
            end_weight: f64::from(u8::from(last)),
            transitions: open.map(way).collect(),
            ..State::default()
        };
        (StateId(done), state)
    });
    Pdfa { initial: StateId(0), states: states.collect() }
}

/// The paper's task of two stacks, yellow (1) on red (0) and blue (3) on green (2), as demonstrated 18 times.
pub(crate) fn two_stacks() -> Vec<Word> {
    let orders = [
        (7, [0, 1, 2, 3]),
        (3, [0, 2, 1, 3]),
        (2, [0, 2, 3, 1]),
        (2, [2, 3, 0, 1]),
        (2, [2, 0, 1, 3]),
        (2, [2, 0, 3, 1]),
    ];
    let word = |order: [u32; 4]| order.map(Symbol).to_vec();
    orders.into_iter().flat_map(|(times, order)| std::iter::repeat_n(word(order), times)).collect()
}

/// A specification of this automaton and these demonstrations, and nothing else.
pub(crate) fn specification(pdfa: Pdfa, words: Vec<Word>) -> Specification {
    let demonstration = |(index, word): (usize, Word)| DemonstrationWord {
        name: format!("demonstration {index}"),
        sha256: String::new(),
        frames: 0,
        word,
    };
    Specification {
        name: "Task".to_owned(),
        semantics: Semantics::MaximumLikelihood,
        features: Vec::new(),
        subsets: Vec::new(),
        sub_goals: Vec::new(),
        pdfa,
        demonstrations: words.into_iter().enumerate().map(demonstration).collect(),
    }
}
