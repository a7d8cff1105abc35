//! What holds for any edits of any specification.

use std::collections::BTreeSet;

use goalgraph::edit::{Edit, Patch};
use goalgraph::pdfa::StateId;
use goalgraph::specification::Specification;
use proptest::prelude::*;

use crate::generate::{above, any_edit, assert_sound, cases, extreme_specification, with_new_ids};

/// How much evidence there is.
fn evidence(specification: &Specification) -> u128 {
    let states = specification.pdfa.states.values();
    let of = |state: &goalgraph::pdfa::State| {
        u128::from(state.end_count)
            + state.transitions.values().map(|way| u128::from(way.count)).sum::<u128>()
    };
    states.map(of).sum()
}

fn ids(specification: &Specification) -> BTreeSet<StateId> {
    specification.pdfa.states.keys().copied().collect()
}

/// Whether the edit promises to leave all evidence where it can be found.
fn keeps_evidence(edit: &Edit) -> bool {
    !matches!(
        edit,
        Edit::PruneState { .. }
            | Edit::PruneTransition { .. }
            | Edit::MoveTransition { .. }
            | Edit::MergeSubGoals { .. }
            | Edit::RemoveSubGoal { .. }
            | Edit::ForbidWord { .. }
            | Edit::Replace { .. }
    )
}

proptest! {
    #![proptest_config(cases(1024))]

    #[test]
    fn any_edits_keep_a_specification_sound_and_can_be_undone(
        start in extreme_specification(),
        edits in prop::collection::vec(any_edit(), 1..12),
    ) {
        let mut specification = start.clone();
        let mut inverses = Vec::new();
        for edit in edits {
            let before = specification.clone();
            let edit = with_new_ids(edit, above(&specification));
            edit.label(&specification);
            let Ok(change) = edit.apply(&mut specification) else {
                prop_assert_eq!(&specification, &before, "{:?}", edit);
                continue;
            };
            assert_sound(&specification);
            let small = evidence(&before) < u128::from(u64::MAX);
            if keeps_evidence(&edit) && small {
                prop_assert_eq!(evidence(&specification), evidence(&before), "{:?}", edit);
            } else if !matches!(edit, Edit::Replace { .. } | Edit::MergeSubGoals { .. } | Edit::RemoveSubGoal { .. }) {
                prop_assert!(evidence(&specification) <= evidence(&before), "{:?}", edit);
            }
            let (old, new) = (ids(&before), ids(&specification));
            let gone: BTreeSet<StateId> = change.folded.keys().chain(&change.removed).copied().collect();
            prop_assert_eq!(gone.len(), change.folded.len() + change.removed.len());
            prop_assert!(change.folded.values().all(|stays| new.contains(stays)));
            prop_assert_eq!(&old - &new, gone, "{:?}", edit);
            prop_assert_eq!(&new - &old, change.added, "{:?}", edit);
            let mut undone = specification.clone();
            let inverse = change.inverse.clone();
            let forth = inverse.apply(&mut undone);
            prop_assert_eq!(&undone, &before);
            prop_assert_eq!(undone.to_json(), before.to_json());
            prop_assert_eq!(forth.apply(&mut undone), change.inverse.clone());
            prop_assert_eq!(&undone, &specification);
            inverses.push(change.inverse);
        }
        while let Some(inverse) = inverses.pop() {
            let _forth = inverse.apply(&mut specification);
        }
        prop_assert_eq!(specification.to_json(), start.to_json());
    }

    #[test]
    fn a_patch_is_as_small_as_the_difference(one in extreme_specification(), other in extreme_specification()) {
        prop_assert!(Patch::between(&one, &one.clone()).is_empty());
        let mut changed = one.clone();
        let back = Patch::between(&one, &other).apply(&mut changed);
        prop_assert_eq!(&changed, &other);
        prop_assert_eq!(back, Patch::between(&other, &one));
    }

    #[test]
    fn an_edit_is_the_same_after_a_way_through_json(edit in any_edit()) {
        let text = serde_json::to_string(&edit).unwrap();
        if text.contains("null") && !matches!(edit, Edit::RecolorSubGoal { .. }) {
            // A probability that is no number is refused anyway.
            prop_assert!(serde_json::from_str::<Edit>(&text).is_err());
        } else {
            prop_assert_eq!(serde_json::from_str::<Edit>(&text).unwrap(), edit);
        }
    }
}

#[test]
fn edits_are_written_in_the_words_of_their_documentation() {
    let text =
        |edit: &str| serde_json::from_str::<Edit>(edit).map(|edit| serde_json::to_string(&edit).unwrap());
    for edit in [
        r#"{"merge_states":{"kept":"q2","merged":"q3"}}"#,
        r#"{"prune_state":{"state":"q2","ways":"heal"}}"#,
        r#"{"reweight":{"state":"q0","outcome":{"transition":"g1"},"probability":0.4,"locked":[{"transition":"g0"},"end"]}}"#,
        r#"{"set_semantics":{"semantics":"maximum_likelihood"}}"#,
        r#"{"recolor_sub_goal":{"symbol":"g1","color":null}}"#,
        r#"{"forbid_word":{"word":["g0","g1"],"first_new":"q9"}}"#,
    ] {
        assert_eq!(text(edit).unwrap(), edit);
    }
    assert!(text(r#"{"add_state":{"id":"q2","name":"x"}}"#).is_err(), "unknown fields are refused");
    assert!(text(r#"{"explode":{}}"#).is_err());
}
