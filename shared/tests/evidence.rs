//! Credible intervals against closed forms and integrals, passages against words followed by hand.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod automata;

use automata::{any_automaton, specification, two_stacks};
use goalgraph::evidence::{Interval, Passage, credible_interval, passages_of_state, passages_of_transition};
use goalgraph::pdfa::{Pdfa, StateId, Symbol, Word};
use proptest::prelude::*;

#[track_caller]
fn check(count: u64, total: u64, outcomes: usize, low: f64, high: f64) {
    let found = credible_interval(count, total, outcomes);
    assert!((found.low - low).abs() < 1e-10 && (found.high - high).abs() < 1e-10, "{found:?}");
}

#[test]
fn intervals_are_the_quantiles_that_closed_forms_give() {
    // Nothing seen, one outcome: Beta(1/2, 1/2), the arcsine distribution: sin²(πp/2).
    let arcsine = |p: f64| (std::f64::consts::FRAC_PI_2 * p).sin().powi(2);
    check(0, 0, 1, arcsine(0.025), arcsine(0.975));
    // Beta(a, 1): p^(1/a).
    check(3, 3, 2, 0.025_f64.powf(1.0 / 3.5), 0.975_f64.powf(1.0 / 3.5));
    check(40, 40, 2, 0.025_f64.powf(1.0 / 40.5), 0.975_f64.powf(1.0 / 40.5));
    // No outcomes are taken as one, a count above the total as the total.
    check(0, 0, 0, arcsine(0.025), arcsine(0.975));
    check(9, 3, 2, 0.025_f64.powf(1.0 / 3.5), 0.975_f64.powf(1.0 / 3.5));
}

#[test]
fn intervals_are_the_quantiles_computed_with_thirty_digits() {
    check(0, 10, 3, 4.363_579_814_218_965e-5, 0.199_994_569_026_208_07);
    check(6, 9, 2, 0.324_158_010_886_992_5, 0.871_192_563_635_35);
    check(333, 1000, 3, 0.303_995_034_726_379_73, 0.362_305_703_239_278_4);
}

#[test]
fn with_many_words_the_interval_is_the_normal_one_of_at_most_a_million() {
    for total in [10_000_u64, 1_000_000, 100_000_000, 1 << 60] {
        let Interval { low, high } = credible_interval(total / 4, total, 3);
        let width = 2.0 * 1.959_964 * (0.25 * 0.75 / (total as f64).min(1e6)).sqrt();
        assert!(((high - low) / width - 1.0).abs() < 1e-3, "{total}: {low} {high}");
        assert!((f64::midpoint(low, high) - 0.25).abs() < 0.02 * width);
    }
    let Interval { low, high } = credible_interval(u64::MAX, u64::MAX, usize::MAX);
    assert!(0.0 <= low && low <= high && high <= 1.0);
}

/// Probability that Beta(`a`, `b`) is at most `x`, by Simpson's rule over the sine of the root, where it is smooth.
fn beta_by_integration(a: f64, b: f64, x: f64) -> f64 {
    let density = |angle: f64| angle.sin().powf(2.0 * a - 1.0) * angle.cos().powf(2.0 * b - 1.0);
    let integral = |to: f64| {
        let steps = 4000;
        let step = to / f64::from(steps);
        let weight =
            |index: i32| if index == 0 || index == steps { 1.0 } else { f64::from(2 + 2 * (index % 2)) };
        (0..=steps).map(|index| weight(index) * density(f64::from(index) * step)).sum::<f64>() * step / 3.0
    };
    integral(x.sqrt().asin()) / integral(std::f64::consts::FRAC_PI_2)
}

proptest! {
    #[test]
    fn each_tail_holds_a_fortieth(count in 0..60_u64, more in 0..60_u64, outcomes in 1..6_usize) {
        let Interval { low, high } = credible_interval(count, count + more, outcomes);
        let (a, b) = (count as f64 + 0.5, more as f64 + outcomes as f64 / 2.0);
        prop_assert!((beta_by_integration(a, b, low) - 0.025).abs() < 1e-6);
        prop_assert!((beta_by_integration(a, b, high) - 0.975).abs() < 1e-6);
    }

    #[test]
    fn an_interval_is_one_for_any_counts(count in any::<u64>(), total in any::<u64>(), outcomes in any::<usize>()) {
        let Interval { low, high } = credible_interval(count, total, outcomes);
        prop_assert!(0.0 <= low && low <= high && high <= 1.0);
    }

    #[test]
    fn every_demonstration_that_fits_passes_one_state_more_than_transitions(
        pdfa in any_automaton(),
        words in prop::collection::vec(prop::collection::vec((0..3_u32).prop_map(Symbol), 0..6), 0..5),
    ) {
        let specification = specification(pdfa, words);
        let states = specification.pdfa.states.keys();
        let mut passages: Vec<Passage> = states.flat_map(|&id| passages_of_state(&specification, id)).collect();
        let ways = specification.pdfa.transitions();
        let mut taken: Vec<Passage> =
            ways.flat_map(|(source, symbol, _)| passages_of_transition(&specification, source, symbol)).collect();
        passages.sort();
        taken.sort();
        let (mut expected, mut expected_taken) = (Vec::new(), Vec::new());
        for (demonstration, shown) in specification.demonstrations.iter().enumerate() {
            let mut state = specification.pdfa.initial;
            expected.push(Passage { demonstration, position: 0 });
            for (position, &symbol) in shown.word.iter().enumerate() {
                let Some(way) = specification.pdfa.transition(state, symbol) else { break };
                expected_taken.push(Passage { demonstration, position });
                expected.push(Passage { demonstration, position: position + 1 });
                state = way.target;
            }
        }
        prop_assert_eq!(passages, expected);
        prop_assert_eq!(taken, expected_taken);
    }
}

#[test]
fn as_many_demonstrations_pass_a_transition_as_its_count_says() {
    let specification = specification(Pdfa::from_words(&two_stacks()), two_stacks());
    for (source, symbol, way) in specification.pdfa.transitions() {
        assert_eq!(passages_of_transition(&specification, source, symbol).len() as u64, way.count);
    }
    let first = passages_of_state(&specification, StateId(0));
    assert_eq!(first.len(), 18);
    assert!(first.iter().all(|passage| passage.position == 0));
}

#[test]
fn a_demonstration_counts_up_to_where_it_deviates() {
    let word = |text: &[u32]| text.iter().copied().map(Symbol).collect::<Word>();
    let pdfa = Pdfa::from_words(&[word(&[0, 1])]);
    let specification = specification(pdfa, vec![word(&[0, 1]), word(&[0, 2, 1]), word(&[1])]);
    let passed = |state| passages_of_state(&specification, StateId(state));
    let at = |demonstration, position| Passage { demonstration, position };
    assert_eq!(passed(0), [at(0, 0), at(1, 0), at(2, 0)]);
    assert_eq!(passed(1), [at(0, 1), at(1, 1)]);
    assert_eq!(passed(2), [at(0, 2)]);
    assert_eq!(passed(9), []);
    assert_eq!(passages_of_transition(&specification, StateId(1), Symbol(1)), [at(0, 1)]);
}
