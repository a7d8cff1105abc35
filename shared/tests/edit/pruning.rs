//! Taking states and transitions out.

use std::collections::BTreeMap;

use goalgraph::edit::{Edit, Pruned};
use goalgraph::pdfa::{StateId, Symbol, Word};
use goalgraph::specification::Specification;
use proptest::prelude::*;

use crate::generate::{cases, learned as learned_words, simple_words};
use crate::{A, B, C, D, all_words, edited, language, learned, probability, q, refused};

fn state(id: u32, ways: Pruned) -> Edit {
    Edit::PruneState { state: q(id), ways }
}

fn transition(source: u32, symbol: Symbol, ways: Pruned) -> Edit {
    Edit::PruneTransition { source: q(source), symbol, ways }
}

#[test]
fn cutting_takes_along_what_can_no_longer_be_reached() {
    // q0 -a-> q1 -b-> q2 -c-> q3, q0 -b-> q4 -a-> q2
    let before = learned(&["abc", "bac", "ab"]);
    let (after, change) = edited(&before, &state(1, Pruned::Cut));
    assert_eq!(change.removed, [q(1)].into());
    assert_eq!(language(&after, 4), ["ba", "bac"]);
    let (_, change) = edited(&after, &transition(4, A, Pruned::Cut));
    assert_eq!(change.removed, [q(2), q(3)].into());
}

#[test]
fn a_state_that_is_not_connected_yet_survives_the_pruning_of_others() {
    let before = learned(&["ab"]);
    let (before, _) = edited(&before, &Edit::AddState { id: q(5) });
    let (after, change) = edited(&before, &state(1, Pruned::Cut));
    assert_eq!(change.removed, [q(1), q(2)].into());
    assert!(after.pdfa.states.contains_key(&q(5)));
}

#[test]
fn healing_a_state_keeps_the_ways_past_it() {
    // q0 -a-> q1, which goes on by b (2 of 4), by c (1 of 4) or ends (1 of 4)
    let before = learned(&["ab", "ab", "ac", "a", "d", "d", "d", "d"]);
    let (after, change) = edited(&before, &state(1, Pruned::Heal));
    assert_eq!(change.removed, [q(1)].into());
    let initial = &after.pdfa.states[&q(0)];
    let weights =
        [B, C, D].map(|symbol| (initial.transitions[&symbol].weight, initial.transitions[&symbol].count));
    assert_eq!(weights, [(2.0, 0), (1.0, 0), (4.0, 4)], "no demonstration went from q0 by b or c");
    assert_eq!((initial.accepting, initial.end_weight, initial.end_count), (true, 1.0, 0));
    assert_eq!(language(&after, 3), ["", "b", "c", "d"]);
}

#[test]
fn healing_folds_targets_where_both_ways_have_a_symbol() {
    // q0 -a-> q1 -b-> q2 -c-> q3, q0 -b-> q4 -d-> q5
    let before = learned(&["abc", "bd"]);
    let (after, change) = edited(&before, &state(1, Pruned::Heal));
    assert_eq!((change.folded, change.removed), ([(q(4), q(2))].into(), [q(1)].into()));
    let way = after.pdfa.transition(q(0), B).unwrap();
    assert_eq!((way.target, way.weight, way.count), (q(2), 2.0, 1), "the evidence is that of q0 by b");
    assert_eq!(language(&after, 3), ["bc", "bd"]);
}

#[test]
fn healing_a_transition_changes_its_source_alone() {
    let before = learned(&["abc", "bac"]);
    let (after, change) = edited(&before, &transition(0, A, Pruned::Heal));
    assert_eq!(change.removed, [q(1)].into(), "nothing leads to q1 any longer");
    assert_eq!(language(&after, 3), ["bc", "bac"]);
    let (after, change) = edited(&before, &transition(4, A, Pruned::Heal));
    assert!(change.removed.is_empty());
    assert_eq!(language(&after, 3), ["bc", "abc"]);
}

#[test]
fn a_self_loop_goes_when_it_is_pruned_or_healed_past() {
    let before = learned(&["aab"]);
    assert_eq!(before.pdfa.transition(q(1), A).unwrap().target, q(1));
    let (after, _) = edited(&before, &transition(1, A, Pruned::Heal));
    assert_eq!(language(&after, 3), ["ab"]);
    let (after, _) = edited(&before, &state(1, Pruned::Heal));
    assert_eq!(language(&after, 3), ["b"]);
    assert_eq!(
        after.pdfa.transition(q(0), B).unwrap().weight,
        1.0,
        "nothing of the weight is lost in the loop"
    );
}

#[test]
fn what_cannot_be_pruned_is_refused() {
    let before = learned(&["ab"]);
    refused(&before, &state(0, Pruned::Cut), "the initial state q0 cannot be pruned");
    refused(&before, &state(0, Pruned::Heal), "the initial state q0 cannot be pruned");
    refused(&before, &state(9, Pruned::Cut), "q9: there is no such state");
    refused(&before, &transition(9, A, Pruned::Cut), "q9: there is no such state");
    refused(&before, &transition(0, B, Pruned::Heal), "q0: there is no transition by g1");
}

/// The words with their probabilities once the symbol that leads to `pruned` is left out of them.
fn past(before: &Specification, pruned: StateId) -> BTreeMap<Word, f64> {
    let mut past = BTreeMap::new();
    for word in all_words(4) {
        let mut at = before.pdfa.initial;
        let mut shorter = Word::new();
        for &symbol in &word {
            let Some(way) = before.pdfa.transition(at, symbol) else { break };
            at = way.target;
            if at != pruned {
                shorter.push(symbol);
            }
        }
        *past.entry(shorter).or_default() += probability(before, &word);
    }
    past
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn a_healed_state_leaves_the_words_without_its_symbol(words in simple_words(), id in 1..9_u32) {
        let before = learned_words(&words);
        prop_assume!(before.pdfa.states.contains_key(&q(id)));
        let (after, change) = edited(&before, &state(id, Pruned::Heal));
        let expected = past(&before, q(id));
        for (word, expected) in &expected {
            let found = probability(&after, word);
            prop_assert!(*expected == 0.0 || found > 0.0, "{word:?}");
            // Where ways fold together, more words arise and the probability is shared.
            prop_assert!(!change.folded.is_empty() || (found - expected).abs() < 1e-9, "{word:?}: {found} {expected}");
        }
        let total: f64 = all_words(4).iter().map(|word| probability(&after, word)).sum();
        prop_assert!(!change.folded.is_empty() || (total - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_cut_state_takes_exactly_the_words_through_it(words in simple_words(), id in 1..9_u32) {
        let before = learned_words(&words);
        prop_assume!(before.pdfa.states.contains_key(&q(id)));
        let (after, _) = edited(&before, &state(id, Pruned::Cut));
        for word in all_words(4) {
            let mut at = Some(before.pdfa.initial);
            let mut through = false;
            for &symbol in &word {
                at = at.and_then(|at| before.pdfa.transition(at, symbol)).map(|way| way.target);
                through |= at == Some(q(id));
            }
            let expected = probability(&before, &word) > 0.0 && !through;
            prop_assert_eq!(probability(&after, &word) > 0.0, expected, "{:?}", word);
        }
    }
}
