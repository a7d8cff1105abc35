//! Adding and forbidding words, against enumerated languages.

use goalgraph::edit::Edit;
use goalgraph::pdfa::{Symbol, Word};
use goalgraph::specification::Specification;
use proptest::prelude::*;

use crate::generate::{above, any_specification, assert_sound, cases, simple_words};
use crate::{A, B, C, D, all_words, edited, language, learned, probability, q, refused, word};

fn add(word: Word, specification: &Specification) -> Edit {
    Edit::AddWord { word, first_new: above(specification) }
}

fn forbid(word: Word, specification: &Specification) -> Edit {
    Edit::ForbidWord { word, first_new: above(specification) }
}

#[track_caller]
fn added(before: &Specification, letters: &str) -> Specification {
    edited(before, &add(word(letters), before)).0
}

#[track_caller]
fn forbidden(before: &Specification, letters: &str) -> Specification {
    edited(before, &forbid(word(letters), before)).0
}

#[test]
fn an_added_word_weighs_one_demonstration_and_counts_none() {
    let before = learned(&["ab", "ab"]);
    let after = added(&before, "ad");
    assert_eq!(language(&after, 3), ["ab", "ad"]);
    assert!((probability(&after, &word("ad")) - 1.0 / 3.0).abs() < 1e-12);
    let ways = |specification: &Specification| {
        specification.pdfa.transitions().map(|(_, _, way)| way.count).sum::<u64>()
    };
    assert_eq!(ways(&after), ways(&before));
    assert_eq!(after.pdfa.states[&q(3)].completed, [A, D].into());
}

#[test]
fn an_added_word_joins_the_state_where_the_same_is_completed() {
    let before = learned(&["abc"]);
    let after = added(&before, "ba");
    assert_eq!(after.pdfa.transition(q(4), A).unwrap().target, q(2));
    assert_eq!(language(&after, 3), ["ab", "ba", "abc", "bac"], "what follows there may follow now, too");
}

#[test]
fn an_added_word_revives_what_had_no_weight() {
    let mut before = learned(&["ab"]);
    before.pdfa.states.get_mut(&q(1)).unwrap().transitions.get_mut(&B).unwrap().weight = 0.0;
    assert_eq!(language(&before, 3), [""; 0]);
    let after = added(&before, "ab");
    assert_eq!(after.pdfa.transition(q(1), B).unwrap().weight, 1.0);
    assert_eq!(language(&after, 3), ["ab"]);
}

#[test]
fn words_that_are_there_or_not_are_refused() {
    let before = learned(&["ab"]);
    refused(&before, &add(word("ab"), &before), "the word is accepted already");
    refused(&before, &forbid(word("ba"), &before), "the word is not accepted, so it cannot be forbidden");
    refused(&before, &forbid(word("a"), &before), "the word is not accepted, so it cannot be forbidden");
    refused(&before, &add(vec![Symbol(9)], &before), "g9: there is no such sub-goal");
    refused(&before, &forbid(vec![Symbol(9)], &before), "g9: there is no such sub-goal");
}

#[test]
fn a_forbidden_word_of_its_own_way_takes_its_states_along() {
    let before = learned(&["abc", "d"]);
    let (after, change) = edited(&before, &forbid(word("abc"), &before));
    assert_eq!(change.removed, [q(1), q(2), q(3)].into());
    assert!(change.added.is_empty(), "nothing is split that needs not be");
    assert_eq!(language(&after, 4), ["d"]);
}

#[test]
fn states_that_other_words_share_are_split() {
    // q0 -a-> q1 -b-> q2, q0 -b-> q3 -a-> q2 -c-> q4
    let before = learned(&["ab", "ab", "ba", "abc"]);
    let (after, change) = edited(&before, &forbid(word("ab"), &before));
    assert_eq!(language(&after, 3), ["ba", "abc", "bac"]);
    assert_eq!((change.added, change.removed), ([q(5)].into(), [].into()));
    let (double, rest) = (&after.pdfa.states[&q(5)], &after.pdfa.states[&q(2)]);
    assert_eq!((double.end_count, double.accepting, double.transitions[&C].count), (2, false, 1));
    assert_eq!((rest.end_count, rest.accepting, rest.transitions[&C].count), (1, true, 0));
    assert_eq!(after.pdfa.transition(q(1), B).unwrap().target, q(5));
}

#[test]
fn the_empty_word_can_be_added_and_forbidden() {
    let before = learned(&["a"]);
    let after = added(&before, "");
    assert_eq!(language(&after, 2), ["", "a"]);
    assert_eq!(language(&forbidden(&after, ""), 2), ["a"]);
    let only = learned(&[""]);
    assert_eq!(language(&forbidden(&only, ""), 2), [""; 0]);
}

#[test]
fn one_turn_of_a_cycle_can_be_forbidden() {
    let before = learned(&["ab"]);
    let (before, _) = edited(&before, &Edit::MergeStates { kept: q(0), merged: q(2) });
    assert_eq!(language(&before, 6), ["", "ab", "abab", "ababab"]);
    assert_eq!(language(&forbidden(&before, "abab"), 6), ["", "ab", "ababab"]);
    assert_eq!(language(&forbidden(&before, ""), 6), ["ab", "abab", "ababab"]);
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn a_forbidden_word_is_all_that_leaves_the_language(
        specification in any_specification(), choice in any::<prop::sample::Index>(),
    ) {
        let accepted: Vec<Word> =
            all_words(4).into_iter().filter(|word| probability(&specification, word) > 0.0).collect();
        prop_assume!(!accepted.is_empty());
        let gone = choice.get(&accepted);
        let (after, change) = edited(&specification, &forbid(gone.clone(), &specification));
        prop_assert!(change.added.len() <= gone.len() + 1);
        let rest = 1.0 - probability(&specification, gone);
        for word in all_words(5) {
            let (before, after) = (probability(&specification, &word), probability(&after, &word));
            if &word == gone {
                prop_assert_eq!(after, 0.0);
            } else {
                prop_assert_eq!(after > 0.0, before > 0.0, "{:?}", word);
                prop_assert!((after * rest - before).abs() < 1e-9, "{word:?}: the others keep their proportions");
            }
        }
    }

    #[test]
    fn the_evidence_of_split_states_is_shared_out(words in simple_words(), choice in any::<prop::sample::Index>()) {
        let before = crate::generate::learned(&words);
        let gone = choice.get(&words);
        let (after, _) = edited(&before, &forbid(gone.clone(), &before));
        // Every other demonstration finds its evidence on its way.
        let mut walked = after.clone();
        for word in words.iter().filter(|word| *word != gone) {
            let mut at = walked.pdfa.initial;
            for symbol in word {
                let way = walked.pdfa.states.get_mut(&at).unwrap().transitions.get_mut(symbol).unwrap();
                prop_assert!(way.count > 0);
                way.count -= 1;
                at = way.target;
            }
            let end = walked.pdfa.states.get_mut(&at).unwrap();
            prop_assert!(end.end_count > 0);
            end.end_count -= 1;
        }
        for (_, _, way) in walked.pdfa.transitions() {
            prop_assert!(way.count <= words.iter().filter(|word| *word == gone).count() as u64);
        }
    }

    #[test]
    fn an_added_word_is_accepted_and_nothing_is_lost(specification in any_specification(), new in 0..341_usize) {
        let new = all_words(4)[new].clone();
        prop_assume!(probability(&specification, &new) == 0.0);
        let mut after = specification.clone();
        prop_assert!(add(new.clone(), &specification).apply(&mut after).is_ok());
        assert_sound(&after);
        prop_assert!(probability(&after, &new) > 0.0);
        for word in all_words(4) {
            prop_assert!(probability(&specification, &word) == 0.0 || probability(&after, &word) > 0.0);
        }
    }

    #[test]
    fn a_word_that_shares_no_state_is_all_that_is_gained(words in simple_words(), new in 0..341_usize) {
        let before = crate::generate::learned(&words);
        let new = all_words(4)[new].clone();
        let mut after = before.clone();
        if add(new.clone(), &before).apply(&mut after).is_err() {
            return Ok(());
        }
        let mut at = after.pdfa.initial;
        for &symbol in &new {
            at = after.pdfa.transition(at, symbol).unwrap().target;
            prop_assume!(after.pdfa.transitions().filter(|(_, _, way)| way.target == at).count() == 1);
        }
        for word in all_words(4) {
            let expected = word == new || probability(&before, &word) > 0.0;
            prop_assert_eq!(probability(&after, &word) > 0.0, expected, "{:?}", word);
        }
    }
}
