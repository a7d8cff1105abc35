//! Giving outcomes probabilities.

use std::collections::BTreeSet;

use goalgraph::edit::{Edit, Outcome};
use goalgraph::pdfa::{Probabilities, Semantics, StateId};
use goalgraph::specification::Specification;
use proptest::prelude::*;

use crate::generate::{assert_sound, cases, extreme_specification};
use crate::{A, B, C, D, edited, learned, q, refused};

fn of(probabilities: &Probabilities, state: StateId, outcome: Outcome) -> f64 {
    match outcome {
        Outcome::End => probabilities.end(state),
        Outcome::Transition(symbol) => probabilities.transition(state, symbol),
    }
}

fn probability(specification: &Specification, state: StateId, outcome: Outcome) -> f64 {
    of(&specification.pdfa.probabilities(specification.semantics), state, outcome)
}

fn way(symbol: goalgraph::pdfa::Symbol) -> Outcome {
    Outcome::Transition(symbol)
}

fn reweight(outcome: Outcome, probability: f64, locked: &[Outcome]) -> Edit {
    Edit::Reweight { state: q(0), outcome, probability, locked: locked.iter().copied().collect() }
}

/// q0: a 4 of 8, b 2 of 8, c 1 of 8, the end 1 of 8.
fn four() -> Specification {
    learned(&["a", "a", "a", "a", "b", "b", "c", ""])
}

#[track_caller]
fn gives(before: &Specification, edit: &Edit, expected: [f64; 4]) -> Specification {
    let (after, _) = edited(before, edit);
    let found = [way(A), way(B), way(C), Outcome::End].map(|outcome| probability(&after, q(0), outcome));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
    }
    after
}

#[test]
fn the_others_share_the_rest_in_proportion() {
    let after = gives(&four(), &reweight(way(A), 0.3, &[]), [0.3, 0.35, 0.175, 0.175]);
    assert_eq!(after.pdfa.transition(q(0), A).unwrap().count, 4, "counts are evidence");
    assert_eq!(after.pdfa.states[&q(0)].end_count, 1);
}

#[test]
fn what_is_locked_stays() {
    gives(&four(), &reweight(way(A), 0.3, &[way(B)]), [0.3, 0.25, 0.225, 0.225]);
    gives(&four(), &reweight(Outcome::End, 0.0, &[way(B), way(C)]), [0.625, 0.25, 0.125, 0.0]);
    gives(
        &four(),
        &reweight(way(A), 0.5, &[way(A), way(D), way(B), way(C), Outcome::End]),
        [0.5, 0.25, 0.125, 0.125],
    );
}

#[test]
fn zero_and_one_are_probabilities() {
    let sure = gives(&four(), &reweight(way(A), 1.0, &[]), [1.0, 0.0, 0.0, 0.0]);
    gives(&sure, &reweight(way(A), 0.5, &[]), [0.5, 0.25, 0.125, 0.125]);
    let never = gives(&four(), &reweight(way(A), 0.0, &[]), [0.0, 0.5, 0.25, 0.25]);
    gives(&never, &reweight(way(A), 0.5, &[]), [0.5, 0.25, 0.125, 0.125]);
}

#[test]
fn others_without_weight_and_count_share_equally() {
    let mut before = learned(&["a"]);
    for (symbol, id) in [(B, 2), (C, 3)] {
        before = edited(&before, &Edit::AddState { id: q(id) }).0;
        before = edited(&before, &Edit::AddTransition { source: q(0), symbol, target: q(id) }).0;
        before = edited(&before, &reweight(way(symbol), 0.0, &[])).0;
    }
    gives(&before, &reweight(way(A), 0.5, &[]), [0.5, 0.25, 0.25, 0.0]);
}

#[test]
fn a_state_whose_weights_are_all_zero_is_brought_back_to_life() {
    let mut before = four();
    for way in before.pdfa.states.get_mut(&q(0)).unwrap().transitions.values_mut() {
        way.weight = 0.0;
    }
    before.pdfa.states.get_mut(&q(0)).unwrap().end_weight = 0.0;
    gives(&before, &reweight(way(A), 0.5, &[]), [0.5, 0.25, 0.125, 0.125]);
}

#[test]
fn under_the_published_semantics_only_transitions_are_shared_out() {
    let (before, _) = edited(&four(), &Edit::SetSemantics { semantics: Semantics::Published });
    let (after, _) = edited(&before, &reweight(way(A), 0.3, &[]));
    let found = [A, B, C].map(|symbol| probability(&after, q(0), way(symbol)));
    assert!((found[0] - 0.3).abs() < 1e-12 && (found[1] - 1.4 / 3.0).abs() < 1e-12, "{found:?}");
    assert_eq!(after.pdfa.states[&q(0)].end_weight, 1.0);
    let sentence =
        "q0: the published semantics derive the probability of ending from what flows in; it cannot be set";
    refused(&before, &reweight(Outcome::End, 0.3, &[]), sentence);
}

#[test]
fn what_is_no_probability_or_has_no_room_is_refused() {
    let before = four();
    for (probability, written) in [(f64::NAN, "NaN"), (-0.1, "-0.1"), (1.5, "1.5"), (f64::INFINITY, "inf")] {
        let sentence = format!("the probability must be a number from 0 to 1, not {written}");
        refused(&before, &reweight(way(A), probability, &[]), &sentence);
    }
    refused(&before, &reweight(way(A), 0.8, &[way(B)]), "q0: 0.8 and the locked 0.25 are more than 1");
    refused(
        &before,
        &reweight(way(A), 0.25, &[way(B), way(C), Outcome::End]),
        "q0: 0.25 and the locked 0.5 are less than 1, and nothing is left that could take the rest",
    );
    refused(&before, &reweight(way(D), 0.5, &[]), "q0: there is no transition by g3");
    refused(
        &learned(&["a"]),
        &reweight(Outcome::End, 0.5, &[]),
        "q0: no word may end here, so ending has no probability",
    );
    let missing = Edit::Reweight { state: q(9), outcome: way(A), probability: 0.5, locked: BTreeSet::new() };
    refused(&before, &missing, "q9: there is no such state");
    let alone = "q0: 0.5 and the locked 0 are less than 1, and nothing is left that could take the rest";
    refused(&learned(&["a"]), &reweight(way(A), 0.5, &[]), alone);
}

#[test]
fn weights_go_back_to_their_counts() {
    let before = four();
    let (after, _) = edited(&before, &reweight(way(A), 0.3, &[]));
    assert_eq!(edited(&after, &Edit::ResetWeights { state: q(0) }).0, before);
    let (added, _) = edited(&before, &Edit::AddState { id: q(9) });
    let sentence = "q9: no demonstration was here, so there are no counts to go back to";
    refused(&added, &Edit::ResetWeights { state: q(9) }, sentence);
}

proptest! {
    #![proptest_config(cases(2048))]

    #[test]
    fn the_probability_is_what_was_asked_for_and_the_others_keep_their_proportions(
        specification in extreme_specification(),
        published in any::<bool>(),
        id in any::<prop::sample::Index>(),
        outcome in prop_oneof![(0..4_u32).prop_map(|id| way(goalgraph::pdfa::Symbol(id))), Just(Outcome::End)],
        asked in prop_oneof![0.0..=1.0_f64, Just(0.0), Just(1.0)],
        locked in prop::collection::btree_set(
            prop_oneof![(0..4_u32).prop_map(|id| way(goalgraph::pdfa::Symbol(id))), Just(Outcome::End)], 0..3),
    ) {
        let semantics = if published { Semantics::Published } else { Semantics::MaximumLikelihood };
        let before = Specification { semantics, ..specification };
        let mut after = before.clone();
        let id = *id.get(&before.pdfa.states.keys().copied().collect::<Vec<_>>());
        let edit = Edit::Reweight { state: id, outcome, probability: asked, locked: locked.clone() };
        prop_assume!(edit.apply(&mut after).is_ok());
        assert_sound(&after);
        let (old, new) = (before.pdfa.probabilities(semantics), after.pdfa.probabilities(semantics));
        prop_assert!((of(&new, id, outcome) - asked).abs() < 1e-12);
        let state = &before.pdfa.states[&id];
        let mut others: Vec<Outcome> = state.transitions.keys().map(|&symbol| way(symbol)).collect();
        others.extend((state.accepting && !published).then_some(Outcome::End));
        others.retain(|other| *other != outcome);
        let (kept, free): (Vec<_>, Vec<_>) = others.into_iter().partition(|other| locked.contains(other));
        for other in kept {
            prop_assert!((of(&new, id, other) - of(&old, id, other)).abs() < 1e-12, "{other:?}");
        }
        for &one in &free {
            for &other in &free {
                let crossed = of(&old, id, one) * of(&new, id, other) - of(&old, id, other) * of(&new, id, one);
                prop_assert!(crossed.abs() < 1e-12, "{one:?} {other:?}");
            }
        }
        for (other, state) in before.pdfa.states.iter().filter(|(other, _)| **other != id) {
            prop_assert_eq!(&after.pdfa.states[other], state);
        }
    }
}
