//! Prospects against all runs written out.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]
#![allow(clippy::float_cmp, reason = "the same arithmetic gives the same numbers")]

mod automata;

use std::collections::{BTreeMap, BTreeSet};

use automata::{acyclic_automaton, any_automaton, any_order, automaton, probabilities, two_stacks};
use goalgraph::outage::{Success, success};
use goalgraph::pdfa::{Pdfa, Probabilities, Semantics, StateId, Symbol};
use proptest::prelude::*;

fn prospects(pdfa: &Pdfa, unavailable: &[u32]) -> Success {
    let unavailable = unavailable.iter().copied().map(Symbol).collect();
    success(pdfa, &probabilities(pdfa), pdfa.initial, &unavailable)
}

/// The available ways out of a state: probability and target.
fn available(
    pdfa: &Pdfa,
    probabilities: &Probabilities,
    unavailable: &BTreeSet<Symbol>,
    state: StateId,
) -> Vec<(f64, StateId)> {
    let ways = pdfa.states[&state].transitions.iter().filter(|(symbol, _)| !unavailable.contains(symbol));
    let ways = ways.map(|(&symbol, way)| (probabilities.transition(state, symbol), way.target));
    ways.filter(|(probability, _)| *probability > 0.0).collect()
}

/// Probability of ending from `state` in an automaton without cycles, by trying everything.
fn by_trying(
    pdfa: &Pdfa,
    probabilities: &Probabilities,
    unavailable: &BTreeSet<Symbol>,
    state: StateId,
    in_proportion: bool,
) -> f64 {
    let ways = available(pdfa, probabilities, unavailable, state);
    let end = probabilities.end(state);
    let all = end + ways.iter().map(|(probability, _)| probability).sum::<f64>();
    let total = if in_proportion { all } else { 1.0 };
    if all == 0.0 {
        return 0.0;
    }
    let next = |&(probability, target): &(f64, StateId)| {
        probability / total * by_trying(pdfa, probabilities, unavailable, target, in_proportion)
    };
    end / total + ways.iter().map(next).sum::<f64>()
}

/// Probability of having ended, and of still being on the way, after many steps.
fn by_steps(
    pdfa: &Pdfa,
    probabilities: &Probabilities,
    unavailable: &BTreeSet<Symbol>,
    in_proportion: bool,
) -> (f64, f64) {
    let mut ended = 0.0;
    let mut open = BTreeMap::from([(pdfa.initial, 1.0)]);
    for _ in 0..20_000 {
        let mut next: BTreeMap<StateId, f64> = BTreeMap::new();
        for (state, here) in open {
            let ways = available(pdfa, probabilities, unavailable, state);
            let end = probabilities.end(state);
            let all = end + ways.iter().map(|(probability, _)| probability).sum::<f64>();
            let total = if in_proportion && all > 0.0 { all } else { 1.0 };
            ended += here * end / total;
            for (probability, target) in ways {
                *next.entry(target).or_default() += here * probability / total;
            }
        }
        open = next;
    }
    (ended, open.values().sum())
}

/// The states that can be reached but lead to no end, by trying all ways again and again.
fn stranded(pdfa: &Pdfa, probabilities: &Probabilities, unavailable: &BTreeSet<Symbol>) -> Vec<StateId> {
    let ways = |state: StateId| available(pdfa, probabilities, unavailable, state);
    let mut reached = BTreeSet::from([pdfa.initial]);
    let mut live: BTreeSet<StateId> =
        pdfa.states.keys().copied().filter(|&state| probabilities.end(state) > 0.0).collect();
    for _ in 0..pdfa.states.len() {
        for &state in pdfa.states.keys() {
            for (_, target) in ways(state) {
                if reached.contains(&state) {
                    reached.insert(target);
                }
                if live.contains(&target) {
                    live.insert(state);
                }
            }
        }
    }
    reached.difference(&live).copied().collect()
}

fn any_outage() -> impl Strategy<Value = BTreeSet<Symbol>> {
    prop::collection::btree_set((0..3_u32).prop_map(Symbol), 0..3)
}

fn any_semantics() -> impl Strategy<Value = Semantics> {
    prop_oneof![Just(Semantics::MaximumLikelihood), Just(Semantics::Published)]
}

proptest! {
    #[test]
    fn without_cycles_both_are_sums_over_all_runs(
        pdfa in acyclic_automaton(), unavailable in any_outage(), semantics in any_semantics(), from in 0..5_u32,
    ) {
        let probabilities = pdfa.probabilities(semantics);
        let from = StateId(from);
        let found = success(&pdfa, &probabilities, from, &unavailable);
        let expected = |in_proportion| by_trying(&pdfa, &probabilities, &unavailable, from, in_proportion).min(1.0);
        prop_assert!((found.words - expected(false)).abs() < 1e-12);
        prop_assert!((found.walk - expected(true)).abs() < 1e-12);
    }

    #[test]
    fn with_cycles_both_are_approached_by_longer_runs(pdfa in any_automaton(), unavailable in any_outage()) {
        let probabilities = probabilities(&pdfa);
        let found = success(&pdfa, &probabilities, pdfa.initial, &unavailable);
        for (exact, in_proportion) in [(found.words, false), (found.walk, true)] {
            let (ended, open) = by_steps(&pdfa, &probabilities, &unavailable, in_proportion);
            prop_assert!(exact >= ended - 1e-9 && exact <= ended + open + 1e-9, "{ended} {exact} {open}");
        }
        prop_assert!(found.walk >= found.words - 1e-9);
    }

    #[test]
    fn stranded_are_the_states_in_reach_without_an_end_in_reach(pdfa in any_automaton(), unavailable in any_outage()) {
        let probabilities = probabilities(&pdfa);
        let found = success(&pdfa, &probabilities, pdfa.initial, &unavailable);
        prop_assert_eq!(found.stranded, stranded(&pdfa, &probabilities, &unavailable));
    }

    #[test]
    fn the_published_reading_stays_a_probability(pdfa in any_automaton(), unavailable in any_outage()) {
        let found = success(&pdfa, &pdfa.probabilities(Semantics::Published), pdfa.initial, &unavailable);
        prop_assert!((0.0..=1.0).contains(&found.words) && (0.0..=1.0).contains(&found.walk));
    }
}

#[test]
fn two_stacks_without_blue_end_nowhere_and_strand_everywhere() {
    let pdfa = Pdfa::from_words(&two_stacks());
    let found = prospects(&pdfa, &[3]);
    assert_eq!((found.words, found.walk), (0.0, 0.0));
    assert_eq!(found.stranded.len(), 6);
    let found = prospects(&pdfa, &[]);
    assert!((found.words - 1.0).abs() < 1e-12 && (found.walk - 1.0).abs() < 1e-12);
    assert_eq!(found.stranded, []);
}

#[test]
fn a_run_that_cannot_take_its_way_takes_another_but_may_strand() {
    // g0 then the end, or g1 then g2; without g2 the second way is a trap.
    let pdfa = automaton(&[(0, 0, 1, 1.0), (0, 1, 2, 3.0), (2, 2, 1, 1.0)], &[0.0, 1.0, 0.0]);
    let expected = Success { words: 0.25, walk: 0.25, stranded: vec![StateId(2)] };
    assert_eq!(prospects(&pdfa, &[2]), expected);
    assert_eq!(prospects(&pdfa, &[1]), Success { words: 0.25, walk: 1.0, stranded: vec![] });
    assert_eq!(success(&pdfa, &probabilities(&pdfa), StateId(9), &[].into()), Success::default());
}

#[test]
fn twelve_sub_goals_in_any_order_are_all_stranded_without_one() {
    let found = prospects(&any_order(12), &[11]);
    assert_eq!((found.words, found.walk), (0.0, 0.0));
    assert_eq!(found.stranded.len(), 2048);
    assert!((prospects(&any_order(12), &[]).words - 1.0).abs() < 1e-12);
}
