//! What a preview says, against the edits done one by one.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may fail by panicking; the same numbers come out"
)]

#[path = "edit/generate.rs"]
#[allow(dead_code, reason = "the tests of edits need the rest")]
mod generate;

use generate::{above, any_edit, any_specification, cases, learned, with_new_ids};
use goalgraph::edit::{Edit, Pruned};
use goalgraph::pdfa::{StateId, Symbol};
use goalgraph::preview::preview;
use proptest::prelude::*;

const A: Symbol = Symbol(0);
const B: Symbol = Symbol(1);
const C: Symbol = Symbol(2);

#[test]
fn a_preview_says_what_is_lost_and_gained_and_changes_nothing() {
    // q0 -a-> q1 -b-> q2 -c-> q3, q0 -b-> q4
    let mut before = learned(&[vec![A, B, C], vec![B], vec![A, B]]);
    before.demonstrations[1].word = vec![B, C];
    let untouched = before.clone();
    let merge = Edit::MergeStates { kept: StateId(2), merged: StateId(4) };
    let cut = Edit::PruneTransition { source: StateId(0), symbol: A, ways: Pruned::Cut };
    let merged = preview(&before, std::slice::from_ref(&merge)).unwrap();
    assert_eq!(merged.gained_demonstrations, [1]);
    assert_eq!(
        merged.effect.gained.examples.iter().map(|(word, _)| word.clone()).collect::<Vec<_>>(),
        [vec![B, C]]
    );
    let (old, new) = merged.log_likelihood;
    assert!((old.unwrap() - (1.0_f64 / 3.0).ln() * 2.0).abs() < 1e-12);
    assert!((new.unwrap() - (2.0_f64 / 9.0).ln() - (4.0_f64 / 9.0).ln()).abs() < 1e-12);
    let both = preview(&before, &[merge, cut]).unwrap();
    assert_eq!((both.folded, both.removed), ([(StateId(4), StateId(2))].into(), [StateId(1)].into()));
    assert_eq!((both.lost_demonstrations, both.gained_demonstrations), (vec![0, 2], vec![1]));
    assert_eq!(both.log_likelihood, (None, None));
    assert!(both.distance.kl_divergence.is_infinite(), "a b is lost");
    assert_eq!(before, untouched);
}

#[test]
fn demonstrations_are_judged_by_the_words_that_are_read_from_them_afterwards() {
    let before = learned(&[vec![A, B, C], vec![B, C]]);
    let remove = Edit::RemoveSubGoal { symbol: A, first_new: StateId(9) };
    let removed = preview(&before, &[remove]).unwrap();
    assert!(removed.lost_demonstrations.is_empty() && removed.gained_demonstrations.is_empty());
    assert_eq!(removed.log_likelihood.1, Some(0.0), "b c is all there is");
    assert_eq!(removed.effect.lost.examples, [(vec![A, B, C], 0.5)]);
}

#[test]
fn a_state_that_comes_and_goes_is_not_mentioned() {
    let before = learned(&[vec![A]]);
    let edits =
        [Edit::AddState { id: StateId(5) }, Edit::MergeStates { kept: StateId(1), merged: StateId(5) }];
    let nothing = preview(&before, &edits).unwrap();
    assert!(nothing.added.is_empty() && nothing.folded.is_empty() && nothing.removed.is_empty());
    assert_eq!(nothing.distance.kl_divergence, 0.0);
    let error = preview(&before, &[edits[0].clone(), edits[0].clone()]).unwrap_err();
    assert_eq!(error.to_string(), "q5: a new state needs an id above q5, because ids are never reused");
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn a_preview_agrees_with_the_edits_done_one_by_one(
        before in any_specification(), edits in prop::collection::vec(any_edit(), 0..4),
    ) {
        let mut after = before.clone();
        let mut done = Vec::new();
        let mut part_of: std::collections::BTreeMap<StateId, Option<StateId>> =
            before.pdfa.states.keys().map(|&id| (id, Some(id))).collect();
        // An id of a state that is gone is not given again.
        let mut next = above(&before);
        for edit in edits {
            next = next.max(above(&after));
            let edit = with_new_ids(edit, next);
            if matches!(edit, Edit::Replace { .. }) {
                continue;
            }
            if let Ok(change) = edit.apply(&mut after) {
                for part in part_of.values_mut() {
                    *part = part.and_then(|id| {
                        let stays = change.folded.get(&id).copied().unwrap_or(id);
                        (!change.removed.contains(&id)).then_some(stays)
                    });
                }
                done.push(edit);
            }
        }
        let preview = preview(&before, &done).unwrap();
        prop_assert_eq!(&*preview.specification, &after);
        for (id, part) in part_of {
            prop_assert_eq!(preview.folded.get(&id).copied(), part.filter(|part| *part != id), "{}", id);
            prop_assert_eq!(preview.removed.contains(&id), part.is_none(), "{}", id);
        }
        if done.is_empty() {
            prop_assert_eq!(preview.effect.gained.number, Some(0));
            prop_assert_eq!(preview.effect.lost.number, Some(0));
        }
    }
}
