//! Merge candidates against the test written out for every pair.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]
#![allow(clippy::float_cmp, reason = "the same arithmetic gives the same numbers")]

mod automata;

use std::collections::BTreeSet;

use automata::{any_automaton, any_order, specification, two_stacks};
use goalgraph::merge_candidates::{MergeCandidate, MergeTest, merge_candidates};
use goalgraph::pdfa::{Pdfa, StateId, Symbol, Word};
use goalgraph::specification::Specification;
use proptest::prelude::*;

fn candidates(specification: &Specification, limit: usize) -> Vec<MergeCandidate> {
    merge_candidates(specification, MergeTest { alpha: 0.05, limit })
}

fn seen(pdfa: &Pdfa, state: StateId) -> u64 {
    let state = &pdfa.states[&state];
    state.end_count + state.transitions.values().map(|way| way.count).sum::<u64>()
}

/// Compares two states, what the same symbols lead to, and so on; each pair that was not yet.
fn compare(
    pdfa: &Pdfa,
    a: StateId,
    b: StateId,
    done: &mut BTreeSet<(StateId, StateId)>,
    all: &mut (f64, usize),
) {
    let (n, m) = (seen(pdfa, a) as f64, seen(pdfa, b) as f64);
    if a == b || n == 0.0 || m == 0.0 || !done.insert((a.min(b), a.max(b))) {
        return;
    }
    let bound = ((2.0_f64 / 0.05).ln() / 2.0).sqrt() * (1.0 / n.sqrt() + 1.0 / m.sqrt());
    let (a, b) = (&pdfa.states[&a], &pdfa.states[&b]);
    let mut outcome = |f: u64, g: u64| {
        all.0 = all.0.max((f as f64 / n - g as f64 / m).abs() / bound);
        all.1 += 1;
    };
    outcome(a.end_count, b.end_count);
    let symbols: BTreeSet<Symbol> = a.transitions.keys().chain(b.transitions.keys()).copied().collect();
    for symbol in &symbols {
        let count = |state: &goalgraph::pdfa::State| state.transitions.get(symbol).map_or(0, |way| way.count);
        outcome(count(a), count(b));
    }
    for symbol in symbols {
        if let (Some(to_a), Some(to_b)) = (a.transitions.get(&symbol), b.transitions.get(&symbol)) {
            compare(pdfa, to_a.target, to_b.target, done, all);
        }
    }
}

/// Whether `word` is accepted from `state`, and the states that it passes.
fn accepts(pdfa: &Pdfa, mut state: StateId, word: &[Symbol]) -> Option<Vec<StateId>> {
    let mut passed = vec![state];
    for &symbol in word {
        state = pdfa.transition(state, symbol).filter(|way| way.weight > 0.0)?.target;
        passed.push(state);
    }
    let end = &pdfa.states[&state];
    (end.accepting && end.end_weight > 0.0).then_some(passed)
}

fn distinguishing(specification: &Specification, a: StateId, b: StateId) -> Option<usize> {
    let pdfa = &specification.pdfa;
    specification.demonstrations.iter().position(|demonstration| {
        let word = &demonstration.word;
        let passed = accepts(pdfa, pdfa.initial, word).unwrap_or_default();
        passed.iter().enumerate().any(|(position, &state)| {
            let other = if state == a { b } else { a };
            (state == a || state == b) && accepts(pdfa, other, &word[position..]).is_none()
        })
    })
}

/// All pairs, ranked.
fn all_candidates(specification: &Specification) -> Vec<MergeCandidate> {
    let pdfa = &specification.pdfa;
    let states: Vec<StateId> = pdfa.states.keys().copied().filter(|&state| seen(pdfa, state) > 0).collect();
    let mut all = Vec::new();
    for (index, &kept) in states.iter().enumerate() {
        for &merged in &states[index + 1..] {
            let mut found = (0.0, 0);
            compare(pdfa, kept, merged, &mut BTreeSet::new(), &mut found);
            let distinguished_by = distinguishing(specification, kept, merged);
            all.push(MergeCandidate { kept, merged, score: found.0, compared: found.1, distinguished_by });
        }
    }
    all.sort_by(|a, b| {
        let evidence = |pair: &MergeCandidate| seen(pdfa, pair.kept).min(seen(pdfa, pair.merged));
        let distinguished = |pair: &MergeCandidate| pair.distinguished_by.is_some();
        distinguished(a)
            .cmp(&distinguished(b))
            .then(a.score.total_cmp(&b.score))
            .then(evidence(b).cmp(&evidence(a)))
            .then((a.kept, a.merged).cmp(&(b.kept, b.merged)))
    });
    all
}

/// Words over four symbols, each at most once in a word.
fn any_words() -> impl Strategy<Value = Vec<Word>> {
    let word = (Just((0..4).map(Symbol).collect::<Word>()).prop_shuffle(), 0..=4_usize);
    prop::collection::vec(word.prop_map(|(order, length)| order[..length].to_vec()), 0..12)
}

/// Any automaton with any counts, and any demonstrations.
fn any_specification() -> impl Strategy<Value = Specification> {
    let words = prop::collection::vec(prop::collection::vec((0..3_u32).prop_map(Symbol), 0..5), 0..6);
    let counts = prop::collection::vec(0..9_u64, 20);
    (any_automaton(), words, counts).prop_map(|(mut pdfa, words, counts)| {
        let mut counts = counts.into_iter().cycle();
        for state in pdfa.states.values_mut() {
            state.end_count = if state.accepting { counts.next().unwrap() } else { 0 };
            for way in state.transitions.values_mut() {
                way.count = counts.next().unwrap();
            }
        }
        specification(pdfa, words)
    })
}

#[track_caller]
fn check(specification: &Specification) {
    let expected = all_candidates(specification);
    let near = |found: &MergeCandidate, expected: &MergeCandidate| {
        assert!((found.score - expected.score).abs() < 1e-12);
        assert_eq!(MergeCandidate { score: expected.score, ..found.clone() }, *expected);
    };
    for limit in [usize::MAX, 3] {
        let found = candidates(specification, limit);
        assert_eq!(found.len(), expected.len().min(limit));
        for (found, expected) in found.iter().zip(&expected) {
            near(found, expected);
        }
    }
}

proptest! {
    #[test]
    fn of_words_the_candidates_are_all_pairs_in_their_order(words in any_words()) {
        check(&specification(Pdfa::from_words(&words), words));
    }

    #[test]
    fn of_any_automaton_the_candidates_are_all_pairs_in_their_order(specification in any_specification()) {
        check(&specification);
    }
}

#[test]
fn two_states_that_differ_by_chance_are_compatible_and_by_far_are_not() {
    // After a: 60 of 100 go on with c; after b: 55 of 100, or 5 of 100. The others end.
    let words = |after_b: usize| {
        let word = |text: &[u32]| text.iter().copied().map(Symbol).collect::<Word>();
        let times = |number: usize, text: &[u32]| vec![word(text); number];
        [times(60, &[0, 2]), times(40, &[0]), times(after_b, &[1, 2]), times(100 - after_b, &[1])].concat()
    };
    let score = |after_b: usize| {
        let words = words(after_b);
        let pdfa = Pdfa::from_words(&words);
        let [a, b] = [0, 1].map(|symbol| pdfa.transition(pdfa.initial, Symbol(symbol)).unwrap().target);
        let all = candidates(&specification(pdfa, words), usize::MAX);
        let pair = all.into_iter().find(|pair| (pair.kept, pair.merged) == (a, b)).unwrap();
        assert_eq!(pair.distinguished_by, None);
        pair.score
    };
    // Hoeffding: sqrt(ln(40) / 2) · 2 / sqrt(100) = 0.2716.
    assert!((score(55) - 0.05 / 0.271_62).abs() < 1e-4);
    assert!((score(5) - 0.55 / 0.271_62).abs() < 1e-4);
}

#[test]
fn two_stacks_are_told_apart_by_what_remains_to_be_done() {
    let words = two_stacks();
    let all = candidates(&specification(Pdfa::from_words(&words), words), usize::MAX);
    assert!(all.iter().all(|pair| pair.distinguished_by.is_some()));
    assert!(all.iter().all(|pair| pair.kept < pair.merged));
}

#[test]
fn odd_tests_find_something_or_nothing() {
    let words = two_stacks();
    let specification = specification(Pdfa::from_words(&words), words);
    for alpha in [0.0, -1.0, f64::NAN, f64::INFINITY, 2.0, 1e-300] {
        assert_eq!(merge_candidates(&specification, MergeTest { alpha, limit: 4 }).len(), 4);
    }
    assert_eq!(candidates(&specification, 0), []);
}

#[test]
fn twelve_sub_goals_in_any_order_are_compared_as_far_as_the_limits_go() {
    let mut pdfa = any_order(12);
    for (index, state) in pdfa.states.values_mut().enumerate() {
        for (symbol, way) in &mut state.transitions {
            way.count = 1 + (index as u64 * 7 + u64::from(symbol.0) * 13) % 11;
        }
    }
    let orders = (0..12).map(|first| (0..12).map(|place| Symbol((first + place * 5) % 12)).collect());
    let specification = specification(pdfa, orders.collect());
    assert_eq!(candidates(&specification, 20).len(), 20);
}
