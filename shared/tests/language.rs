//! What a change does to the accepted words, against all words written out.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]
#![allow(clippy::float_cmp, reason = "the same arithmetic gives the same numbers")]

mod automata;

use std::collections::BTreeMap;

use automata::{
    acyclic_change, any_automaton, any_change, any_order, automaton, live, only_in, probabilities,
    two_stacks, words,
};
use goalgraph::language::{LanguageEffect, WordDistribution, WordSet, language_effect};
use goalgraph::pdfa::{Pdfa, StateId, Symbol, Transition, Word};
use proptest::prelude::*;

fn effect(before: &Pdfa, after: &Pdfa, examples: usize) -> LanguageEffect {
    language_effect(&WordDistribution::of(before), &WordDistribution::of(after), examples)
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12
}

/// `found` is exactly these words, of which it names the first.
fn check_words(found: &WordSet, expected: &[(Word, f64)], examples: usize) {
    let mass: f64 = expected.iter().map(|(_, probability)| probability).sum();
    assert!(near(found.mass, mass), "{} instead of {mass}", found.mass);
    assert_eq!(found.number, Some(expected.len() as u64));
    assert_eq!(found.examples, expected[..expected.len().min(examples)]);
}

/// How many words of each length `one` accepts and `other` does not, and the probability that they have in `one`;
/// beyond the lengths the probability that is still on a way to an end of `one`.
fn lengths_of_words_only_in(one: &Pdfa, other: &Pdfa, longest: usize) -> (Vec<u128>, f64, f64) {
    let (in_one, in_other) = (probabilities(one), probabilities(other));
    let live = live(one, &in_one);
    let mut open = BTreeMap::from([((one.initial, Some(other.initial)), (1_u128, 1.0))]);
    let (mut numbers, mut mass) = (Vec::new(), 0.0);
    for _ in 0..=longest {
        let mut number = 0_u128;
        let mut next: BTreeMap<_, (u128, f64)> = BTreeMap::new();
        for ((state, there), (ways, probability)) in open {
            let refused = there.is_none_or(|there| in_other.end(there) == 0.0);
            if in_one.end(state) > 0.0 && refused {
                number = number.saturating_add(ways);
                mass += probability * in_one.end(state);
            }
            for (&symbol, way) in &one.states[&state].transitions {
                let taken = in_one.transition(state, symbol);
                let there = there.filter(|&there| in_other.transition(there, symbol) > 0.0);
                let there = there.map(|there| other.transition(there, symbol).unwrap().target);
                if taken > 0.0 && live.contains(&way.target) {
                    let to = next.entry((way.target, there)).or_default();
                    *to = (to.0.saturating_add(ways), to.1 + probability * taken);
                }
            }
        }
        numbers.push(number);
        open = next;
    }
    (numbers, mass, open.values().map(|(_, probability)| probability).sum())
}

/// Pairs of states there can be at most: a longer word repeats one.
const PAIRS: usize = 5 * 6;

fn check_against_lengths(found: &WordSet, one: &Pdfa, other: &Pdfa) {
    let (numbers, mass, open) = lengths_of_words_only_in(one, other, 3000);
    assert!(found.mass >= mass - 1e-9 && found.mass <= mass + open + 1e-9, "{mass} {} {open}", found.mass);
    let infinite = numbers[PAIRS..2 * PAIRS].iter().any(|&number| number > 0);
    let finite = u64::try_from(numbers[..PAIRS].iter().sum::<u128>()).unwrap_or(u64::MAX);
    assert_eq!(found.number, (!infinite).then_some(finite));
}

proptest! {
    #[test]
    fn without_cycles_the_words_are_those_that_only_one_enumeration_holds((before, after) in acyclic_change()) {
        let found = effect(&before, &after, 7);
        let (in_before, in_after) = (words(&before, 9), words(&after, 9));
        check_words(&found.gained, &only_in(&in_after, &in_before), 7);
        check_words(&found.lost, &only_in(&in_before, &in_after), 7);
    }

    #[test]
    fn with_cycles_mass_and_number_are_the_sums_over_all_lengths((before, after) in any_change()) {
        let found = effect(&before, &after, 0);
        check_against_lengths(&found.gained, &after, &before);
        check_against_lengths(&found.lost, &before, &after);
        prop_assert_eq!(found.gained.examples, []);
    }

    #[test]
    fn with_cycles_the_examples_are_the_shortest_words_in_order((before, after) in any_change()) {
        let found = effect(&before, &after, 12).gained;
        let short = only_in(&words(&after, 6), &words(&before, 6));
        let known = short.len().min(12);
        prop_assert_eq!(&found.examples[..known], &short[..known]);
        let longer = &found.examples[known..];
        prop_assert!(longer.iter().all(|(word, _)| word.len() > 6));
        prop_assert!(found.examples.is_sorted_by_key(|(word, _)| (word.len(), word.clone())));
        prop_assert_eq!(found.examples.len() as u64, found.number.unwrap_or(12).min(12));
        for (word, probability) in &found.examples {
            prop_assert_eq!(*probability, WordDistribution::of(&after).probability(word));
            prop_assert_eq!(WordDistribution::of(&before).probability(word), 0.0);
        }
    }

    #[test]
    fn what_one_direction_gains_the_other_loses((before, after) in any_change()) {
        let (there, back) = (effect(&before, &after, 5), effect(&after, &before, 5));
        prop_assert_eq!(there.gained, back.lost);
        prop_assert_eq!(there.lost, back.gained);
    }

    #[test]
    fn an_automaton_gains_and_loses_nothing_against_itself(pdfa in any_automaton()) {
        prop_assert_eq!(effect(&pdfa, &pdfa, 5), LanguageEffect::default());
    }

    #[test]
    fn the_total_is_the_mass_of_all_words(pdfa in any_automaton()) {
        let nothing = automaton(&[], &[0.0]);
        let total = WordDistribution::of(&pdfa).total();
        prop_assert!(near(total, effect(&nothing, &pdfa, 0).gained.mass));
    }
}

#[test]
fn two_stacks_without_red_after_green_lose_the_two_orders_that_need_it() {
    let before = Pdfa::from_words(&two_stacks());
    let mut after = before.clone();
    let (red, yellow, green, blue) = (Symbol(0), Symbol(1), Symbol(2), Symbol(3));
    let started_green = before.transition(before.initial, green).unwrap().target;
    after.states.get_mut(&started_green).unwrap().transitions.get_mut(&red).unwrap().weight = 0.0;
    let found = effect(&before, &after, 5);
    assert_eq!(found.gained, WordSet::default());
    assert_eq!(found.lost.number, Some(2));
    assert!(near(found.lost.mass, 2.0 / 9.0));
    let [(first, p), (second, q)] = &found.lost.examples[..] else { panic!("two words") };
    assert_eq!((first, second), (&vec![green, red, yellow, blue], &vec![green, red, blue, yellow]));
    assert!(near(*p, 10.0 / 81.0) && near(*q, 8.0 / 81.0));
}

#[test]
fn a_cycle_makes_the_words_infinitely_many() {
    let before = automaton(&[(0, 0, 1, 1.0)], &[0.0, 1.0]);
    let after = automaton(&[(0, 0, 1, 1.0), (1, 1, 1, 1.0)], &[0.0, 1.0]);
    let found = effect(&before, &after, 3);
    assert_eq!(found.gained.number, None);
    assert_eq!(found.gained.mass, 0.5);
    let word = |text: &[u32]| text.iter().copied().map(Symbol).collect::<Word>();
    assert_eq!(
        found.gained.examples,
        [(word(&[0, 1]), 0.25), (word(&[0, 1, 1]), 0.125), (word(&[0, 1, 1, 1]), 0.0625)]
    );
}

#[test]
fn a_dead_end_takes_from_the_total() {
    let pdfa = automaton(&[(0, 0, 1, 1.0), (0, 1, 2, 3.0)], &[0.0, 1.0, 0.0]);
    assert_eq!(WordDistribution::of(&pdfa).total(), 0.25);
    assert_eq!(WordDistribution::of(&automaton(&[], &[0.0])).total(), 0.0);
}

#[test]
fn twelve_sub_goals_in_any_order_are_counted_without_being_written_out() {
    let all = any_order(12);
    let mut fewer = all.clone();
    fewer.states.get_mut(&StateId(0)).unwrap().transitions.get_mut(&Symbol(0)).unwrap().weight = 0.0;
    let found = effect(&all, &fewer, 3);
    assert_eq!(found.gained, WordSet::default());
    assert_eq!(found.lost.number, Some(39_916_800));
    assert!(near(found.lost.mass, 1.0 / 12.0));
    let order: Word = (0..12).map(Symbol).collect();
    assert_eq!(found.lost.examples[0].0, order);
    assert_eq!(found.lost.examples[1].0, [&order[..10], &[Symbol(11), Symbol(10)]].concat());
    let nothing = automaton(&[], &[0.0]);
    assert_eq!(effect(&nothing, &all, 0).gained.number, Some(479_001_600));
}

#[test]
fn more_words_than_a_number_can_say_are_the_largest_number() {
    let ways: Vec<automata::Way> =
        (0..70).flat_map(|state| [0, 1].map(|symbol| (state, symbol, state + 1, 1.0))).collect();
    let ends: Vec<f64> = (0..71).map(|state| f64::from(u8::from(state == 70))).collect();
    let found = effect(&automaton(&[], &[0.0]), &automaton(&ways, &ends), 1);
    assert_eq!(found.gained.number, Some(u64::MAX));
    assert!(near(found.gained.mass, 1.0));
}

#[test]
fn a_large_cycle_is_summed_up_by_sweeps() {
    let number = 400_u32;
    let ways: Vec<automata::Way> = (0..number).map(|state| (state, 0, (state + 1) % number, 1.0)).collect();
    let mut ends = vec![0.0; number as usize];
    ends[399] = 1.0;
    let found = effect(&automaton(&[], &[0.0]), &automaton(&ways, &ends), 2);
    assert!(near(found.gained.mass, 1.0));
    assert_eq!(found.gained.number, None);
    assert_eq!(found.gained.examples.iter().map(|(word, _)| word.len()).collect::<Vec<_>>(), [399, 799]);
}

#[test]
fn an_automaton_that_breaks_its_promises_accepts_what_is_left_of_it() {
    let mut pdfa = automaton(&[(0, 0, 1, 1.0), (0, 1, 1, f64::NAN)], &[0.0, f64::MAX]);
    pdfa.states
        .get_mut(&StateId(1))
        .unwrap()
        .transitions
        .insert(Symbol(0), Transition { target: StateId(77), count: 0, weight: f64::MAX });
    let nowhere = Pdfa { initial: StateId(9), states: BTreeMap::new() };
    for one in [&pdfa, &nowhere] {
        for other in [&pdfa, &nowhere] {
            let found = effect(one, other, 3);
            assert!((0.0..=1.0).contains(&found.gained.mass));
        }
    }
    assert_eq!(WordDistribution::of(&nowhere).total(), 0.0);
}
