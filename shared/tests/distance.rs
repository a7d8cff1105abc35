//! Distances against sums over all words written out.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]
#![allow(clippy::float_cmp, reason = "the same arithmetic gives the same numbers")]

mod automata;

use std::collections::{BTreeMap, BTreeSet};

use automata::{
    acyclic_change, any_automaton, any_change, any_order, automaton, live, probabilities, two_stacks, words,
};
use goalgraph::distance::{Bounds, Distance, distance};
use goalgraph::language::WordDistribution;
use goalgraph::pdfa::{Pdfa, StateId, Symbol, Transition, Word};
use proptest::prelude::*;

fn between(from: &Pdfa, to: &Pdfa) -> Distance {
    distance(&WordDistribution::of(from), &WordDistribution::of(to))
}

fn near(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= 1e-9
}

/// p ln(p / q).
fn term(p: f64, q: f64) -> f64 {
    if p == 0.0 { 0.0 } else { p * (p / q).ln() }
}

/// Whether a run can get into a state from which it never ends.
fn may_never_end(pdfa: &Pdfa) -> bool {
    let probabilities = probabilities(pdfa);
    let live = live(pdfa, &probabilities);
    let mut reached = BTreeSet::from([pdfa.initial]);
    for _ in 0..pdfa.states.len() {
        for (source, symbol, way) in pdfa.transitions() {
            if probabilities.transition(source, symbol) > 0.0 && reached.contains(&source) {
                reached.insert(way.target);
            }
        }
    }
    !reached.is_subset(&live)
}

/// Probabilities in both of all words, and of not ending.
fn all_outcomes(from: &Pdfa, to: &Pdfa, length: usize) -> Vec<(f64, f64)> {
    let (from_words, to_words) = (words(from, length), words(to, length));
    let all: BTreeSet<&Word> = from_words.keys().chain(to_words.keys()).collect();
    let of = |words: &BTreeMap<Word, f64>, word: &Word| words.get(word).copied().unwrap_or(0.0);
    let mut outcomes: Vec<(f64, f64)> =
        all.into_iter().map(|word| (of(&from_words, word), of(&to_words, word))).collect();
    let endless = |pdfa: &Pdfa, words: &BTreeMap<Word, f64>| {
        if may_never_end(pdfa) { 1.0 - words.values().sum::<f64>() } else { 0.0 }
    };
    outcomes.push((endless(from, &from_words), endless(to, &to_words)));
    outcomes
}

proptest! {
    #[test]
    fn without_cycles_both_distances_are_their_sums_over_all_words((from, to) in acyclic_change()) {
        let found = between(&from, &to);
        let outcomes = all_outcomes(&from, &to, 9);
        let divergence: f64 = outcomes.iter().map(|&(p, q)| term(p, q)).sum();
        let variation = outcomes.iter().map(|(p, q)| (p - q).abs()).sum::<f64>() / 2.0;
        prop_assert!(near(found.kl_divergence, divergence), "{} instead of {divergence}", found.kl_divergence);
        let Bounds { low, high } = found.total_variation;
        prop_assert!(near(low, variation) && near(high, variation), "{low} {high} instead of {variation}");
    }

    #[test]
    fn with_cycles_the_bounds_hold_and_are_near((from, to) in any_change()) {
        let Bounds { low, high } = between(&from, &to).total_variation;
        let outcomes = all_outcomes(&from, &to, 8);
        let (words, _) = outcomes.split_at(outcomes.len() - 1);
        let (shown_from, shown_to): (f64, f64) =
            words.iter().fold((0.0, 0.0), |sum, (p, q)| (sum.0 + p, sum.1 + q));
        let variation = words.iter().map(|(p, q)| (p - q).abs()).sum::<f64>() / 2.0;
        let rest = f64::midpoint(1.0 - shown_from, 1.0 - shown_to);
        prop_assert!((0.0..=1.0).contains(&low) && low <= high && high <= 1.0);
        prop_assert!(low <= variation + rest + 1e-9 && high >= variation - 1e-9);
        prop_assert!(high - low <= 0.1, "{low} {high}");
    }

    #[test]
    fn with_cycles_the_divergence_is_approached_by_longer_words((from, to) in any_change()) {
        let found = between(&from, &to).kl_divergence;
        let expected = divergence_by_steps(&from, &to, 20_000);
        prop_assert!(found == expected || (found - expected).abs() <= 1e-6 * expected.max(1.0), "{found} {expected}");
    }

    #[test]
    fn an_automaton_is_at_no_distance_from_itself(pdfa in any_automaton()) {
        let nothing = Distance { kl_divergence: 0.0, total_variation: Bounds { low: 0.0, high: 0.0 } };
        prop_assert_eq!(between(&pdfa, &pdfa), nothing);
    }

    #[test]
    fn the_total_variation_is_the_same_both_ways_and_at_least_what_pinsker_says((from, to) in any_change()) {
        let (there, back) = (between(&from, &to), between(&to, &from));
        let (one, other) = (there.total_variation, back.total_variation);
        prop_assert!(one.low <= other.high + 1e-9 && other.low <= one.high + 1e-9);
        let variation = one.low;
        prop_assert!(there.kl_divergence >= 2.0 * variation * variation - 1e-9);
    }
}

/// The divergence, summed along all ways at once, `length` steps far: each pair of states carries the probability of the
/// ways to it in the first, and the same times the logarithm of the ratio of both.
fn divergence_by_steps(from: &Pdfa, to: &Pdfa, length: usize) -> f64 {
    let (p, q) = (probabilities(from), probabilities(to));
    let (live_from, live_to) = (live(from, &p), live(to, &q));
    let start = live_from.contains(&from.initial);
    let mut open: BTreeMap<_, (f64, f64)> = BTreeMap::new();
    if start {
        let there = Some(to.initial).filter(|state| live_to.contains(state));
        open.insert((from.initial, there), (1.0, 0.0));
    }
    let (mut divergence, mut total) = (0.0, 0.0);
    for _ in 0..length {
        let mut next: BTreeMap<_, (f64, f64)> = BTreeMap::new();
        for ((state, there), (probability, ratio)) in open {
            let end = p.end(state);
            let end_there = there.map_or(0.0, |there| q.end(there));
            if end > 0.0 && end_there == 0.0 {
                return f64::INFINITY;
            }
            if end > 0.0 {
                divergence += ratio * end + probability * term(end, end_there);
                total += probability * end;
            }
            for (&symbol, way) in &from.states[&state].transitions {
                let taken = p.transition(state, symbol);
                let taken_there = there.map_or(0.0, |there| q.transition(there, symbol));
                let target = there.and_then(|there| Some(to.transition(there, symbol)?.target));
                let target = target.filter(|state| taken_there > 0.0 && live_to.contains(state));
                if taken > 0.0 && live_from.contains(&way.target) {
                    if target.is_none() {
                        return f64::INFINITY;
                    }
                    let sum = next.entry((way.target, target)).or_default();
                    sum.0 += probability * taken;
                    sum.1 += ratio * taken + probability * term(taken, taken_there);
                }
            }
        }
        open = next;
    }
    let total_there = WordDistribution::of(to).total();
    if may_never_end(from) {
        divergence += if may_never_end(to) { term(1.0 - total, 1.0 - total_there) } else { f64::INFINITY };
    }
    divergence.max(0.0)
}

#[test]
fn two_stacks_without_red_after_green_are_two_ninths_away() {
    let before = Pdfa::from_words(&two_stacks());
    let mut after = before.clone();
    let (red, green) = (Symbol(0), Symbol(2));
    let started_green = before.transition(before.initial, green).unwrap().target;
    after.states.get_mut(&started_green).unwrap().transitions.get_mut(&red).unwrap().weight = 0.0;
    let there = between(&before, &after);
    assert_eq!(there.kl_divergence, f64::INFINITY);
    assert!(near(there.total_variation.low, 2.0 / 9.0));
    assert!(near(there.total_variation.high, 2.0 / 9.0));
    // Afterwards blue always follows green at first, which was 1/3: a third of all words.
    assert!(near(between(&after, &before).kl_divergence, 3.0_f64.ln() / 3.0));
}

#[test]
fn a_longer_cycle_is_compared_exactly() {
    let geometric = |again: f64| automaton(&[(0, 0, 0, again)], &[1.0]);
    let found = between(&geometric(1.0), &geometric(3.0));
    // P(n) = 2^-(n + 1) and Q(n) = (3/4)^n / 4: Q is larger from n = 2 on.
    assert!(near(found.kl_divergence, 2.0_f64.ln() + (2.0_f64 / 3.0).ln()));
    assert!(near(found.total_variation.low, (0.5 + 0.25) - (0.25 + 0.1875)));
    assert!(near(found.total_variation.high, found.total_variation.low));
}

#[test]
fn what_does_not_end_counts_as_one_outcome() {
    let ends = automaton(&[(0, 0, 1, 1.0)], &[0.0, 1.0, 0.0]);
    let half = automaton(&[(0, 0, 1, 1.0), (0, 1, 2, 1.0)], &[0.0, 1.0, 0.0]);
    let never = automaton(&[], &[0.0]);
    let exactly = |value| Bounds { low: value, high: value };
    assert_eq!(
        between(&ends, &half),
        Distance { kl_divergence: 2.0_f64.ln(), total_variation: exactly(0.5) }
    );
    assert_eq!(
        between(&half, &ends),
        Distance { kl_divergence: f64::INFINITY, total_variation: exactly(0.5) }
    );
    assert_eq!(
        between(&never, &half),
        Distance { kl_divergence: 2.0_f64.ln(), total_variation: exactly(0.5) }
    );
    assert_eq!(between(&never, &never), Distance { kl_divergence: 0.0, total_variation: exactly(0.0) });
}

fn set_weight(pdfa: &mut Pdfa, source: u32, symbol: u32, weight: f64) {
    pdfa.states.get_mut(&StateId(source)).unwrap().transitions.get_mut(&Symbol(symbol)).unwrap().weight =
        weight;
}

#[test]
fn twelve_sub_goals_in_any_order_are_compared_exactly_after_a_reweight() {
    let before = any_order(12);
    let mut after = before.clone();
    set_weight(&mut after, 0, 0, 11.0);
    // The first is g0 with 1/2 instead of 1/12.
    let found = between(&before, &after);
    assert!(near(found.total_variation.low, 5.0 / 12.0) && near(found.total_variation.high, 5.0 / 12.0));
    assert!(near(found.kl_divergence, term(1.0 / 12.0, 0.5) + 11.0 * term(1.0 / 12.0, 1.0 / 22.0)));
    // g0 to g5 are done in 1 of 924 ways to half of the task; then 6 of 11 instead of 1 of 6 go on with g6.
    let mut after = before.clone();
    set_weight(&mut after, 0b11_1111, 6, 6.0);
    let found = between(&before, &after);
    let expected = (6.0 / 11.0 - 1.0 / 6.0) / 924.0;
    assert!(near(found.total_variation.low, expected) && near(found.total_variation.high, expected));
}

#[test]
fn twelve_sub_goals_that_differ_everywhere_are_bounded() {
    let before = any_order(12);
    let mut after = before.clone();
    for (index, state) in after.states.values_mut().enumerate() {
        for (symbol, way) in &mut state.transitions {
            way.weight = 1.0 + f64::from((index as u32 * 7 + symbol.0 * 13) % 11) / 10.0;
        }
    }
    let found = between(&before, &after);
    let Bounds { low, high } = found.total_variation;
    assert!(0.0 < low && low < high && high < 1.0, "{low} {high}");
    assert!(found.kl_divergence >= 2.0 * low * low && found.kl_divergence.is_finite());
}

#[test]
fn an_automaton_that_breaks_its_promises_is_at_some_distance() {
    let mut pdfa = automaton(&[(0, 0, 1, 1.0), (0, 1, 1, f64::NAN)], &[0.0, f64::MAX]);
    let way = Transition { target: StateId(77), count: 0, weight: f64::MAX };
    pdfa.states.get_mut(&StateId(1)).unwrap().transitions.insert(Symbol(0), way);
    let nowhere = Pdfa { initial: StateId(9), states: BTreeMap::new() };
    let almost_never = automaton(&[(0, 0, 0, 1e300)], &[1e-300]);
    let all = [&pdfa, &nowhere, &almost_never];
    for one in all {
        for other in all {
            let Bounds { low, high } = between(one, other).total_variation;
            assert!((0.0..=1.0).contains(&low) && low <= high && high <= 1.0);
            assert!(between(one, other).kl_divergence >= 0.0);
        }
    }
}
