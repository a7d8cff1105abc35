//! What differs between two specifications, against edits that are known and against both written out.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may fail by panicking; the same numbers come out"
)]

#[path = "edit/generate.rs"]
#[allow(dead_code, reason = "the tests of edits need the rest")]
mod generate;

use std::collections::{BTreeMap, BTreeSet};

use generate::{above, any_edit, any_specification, cases, learned, simple_words, with_new_ids};
use goalgraph::difference::{Difference, Part, difference};
use goalgraph::edit::{Edit, Outcome, Pruned};
use goalgraph::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition};
use goalgraph::specification::Specification;
use proptest::prelude::*;

const A: Symbol = Symbol(0);
const B: Symbol = Symbol(1);
const C: Symbol = Symbol(2);

/// q0 -a-> q1 -b-> q2 -c-> q3, q0 -b-> q4 -a-> q2
fn task() -> Specification {
    learned(&[vec![A, B, C], vec![A, B, C], vec![B, A, C]])
}

fn edited(edits: &[Edit]) -> Specification {
    let mut specification = task();
    for edit in edits {
        edit.apply(&mut specification).unwrap();
    }
    specification
}

fn found(edits: &[Edit]) -> Difference {
    difference(&task(), &edited(edits))
}

/// The parts of a difference by kind: `+q5`, `-q2`, `~q1`, and the same with symbols of transitions.
fn signs(found: &Difference) -> Vec<String> {
    let sign = |before: bool, after: bool| match (before, after) {
        (false, _) => '+',
        (_, false) => '-',
        _ => '~',
    };
    let state = |(id, it): (&StateId, &goalgraph::difference::Change<_>)| {
        format!("{}{id}", sign(it.before.is_some(), it.after.is_some()))
    };
    let way = |((source, symbol), it): (&(StateId, Symbol), &goalgraph::difference::Change<_>)| {
        format!("{}{source} {symbol}", sign(it.before.is_some(), it.after.is_some()))
    };
    found.states.iter().map(state).chain(found.transitions.iter().map(way)).collect()
}

#[test]
fn a_new_name_of_a_state_is_all_that_differs() {
    let found = found(&[Edit::RenameState { state: StateId(1), name: "half".to_owned() }]);
    assert_eq!(signs(&found), ["~q1"]);
    let change = &found.states[&StateId(1)];
    assert_eq!(change.before.as_ref().unwrap().name, None);
    assert_eq!(change.after.as_ref().unwrap().name.as_deref(), Some("half"));
    assert_eq!(found.distance.total_variation.high, 0.0);
}

#[test]
fn a_reweighted_choice_is_said_with_the_probabilities_before_and_after() {
    let outcome = Outcome::Transition(A);
    let locked = BTreeSet::new();
    let found = found(&[Edit::Reweight { state: StateId(0), outcome, probability: 0.25, locked }]);
    assert_eq!(signs(&found), ["~q0 g0", "~q0 g1"]);
    let change = &found.transitions[&(StateId(0), A)];
    assert!((change.before.as_ref().unwrap().probability - 2.0 / 3.0).abs() < 1e-12);
    assert!((change.after.as_ref().unwrap().probability - 0.25).abs() < 1e-12);
    assert!((found.distance.total_variation.high - (2.0 / 3.0 - 0.25)).abs() < 1e-9);
}

#[test]
fn what_is_pruned_is_in_the_union_without_weight() {
    let found = found(&[Edit::PruneTransition { source: StateId(0), symbol: B, ways: Pruned::Cut }]);
    assert_eq!(signs(&found), ["-q4", "~q0 g0", "-q0 g1", "-q4 g0"]);
    let way = found.union.pdfa.transition(StateId(0), B).unwrap();
    assert_eq!((way.target, way.weight, way.count), (StateId(4), 0.0, 0));
    assert!((found.chances[&(StateId(0), B)] - 1.0 / 3.0).abs() < 1e-12);
    assert_eq!(found.effect.lost.examples, [(vec![B, A, C], 1.0 / 3.0)]);
    assert_eq!(found.effect.gained.number, Some(0));
}

#[test]
fn a_transition_that_leads_elsewhere_is_there_as_it_was_and_as_it_is() {
    let (source, new_target) = (StateId(4), StateId(3));
    let found = found(&[Edit::MoveTransition { source, symbol: A, new_source: source, new_target }]);
    let ghost = *found.transitions.keys().map(|(_, symbol)| symbol).next_back().unwrap();
    assert!(ghost > Symbol(3), "{ghost} is a symbol of its own");
    assert_eq!(signs(&found), ["+q4 g0".to_owned(), format!("-q4 {ghost}")]);
    assert_eq!(found.union.pdfa.transition(source, ghost).unwrap().target, StateId(2));
    assert_eq!(found.union.pdfa.transition(source, A).unwrap().target, StateId(3));
    assert_eq!(found.union.name_of(ghost), "place 0");
}

#[test]
fn a_removed_state_whose_id_is_taken_is_shown_under_another() {
    let before = learned(&[vec![A], vec![B, C]]);
    let mut after = learned(&[vec![A], vec![A, C]]);
    after.sub_goals = before.sub_goals.clone();
    // Before: q1 {a}, q2 {b}, q3 {b c}. After: q1 {a}, q2 {a c}.
    let found = difference(&before, &after);
    let removed = found.states.iter().filter(|(_, it)| it.after.is_none());
    let removed: Vec<_> = removed.map(|(id, it)| (*id, it.before.as_ref().unwrap().id)).collect();
    assert_eq!(removed, [(StateId(3), StateId(3))], "q2 is matched by its id for want of anything better");
    assert_eq!(found.union.pdfa.states.len(), 4);
}

#[test]
fn sub_goals_are_told_by_name_when_their_ids_moved() {
    let before = task();
    let mut after = learned(&[vec![B, A, C], vec![B, A, C], vec![A, B, C]]);
    // The same task with the ids of the first two sub-goals exchanged.
    let (first, second) = (before.sub_goals[0].clone(), before.sub_goals[1].clone());
    after.sub_goals[0] = goalgraph::specification::SubGoal { id: A, ..second };
    after.sub_goals[1] = goalgraph::specification::SubGoal { id: B, ..first };
    let found = difference(&before, &after);
    assert_eq!(found.sub_goals, BTreeMap::new());
    assert_eq!(signs(&found), Vec::<String>::new());
    assert_eq!(found.demonstrations, [], "words say the same of the same sub-goals");
    assert!(found.is_empty());
}

#[test]
fn a_renamed_sub_goal_and_a_moved_ball_are_differences() {
    let named = found(&[Edit::RenameSubGoal { symbol: B, name: "on the tray".to_owned() }]);
    assert_eq!(named.sub_goals.keys().collect::<Vec<_>>(), [&B]);
    assert!(named.transitions.is_empty(), "the sub-goal is the same one");
    let mut after = task();
    after.sub_goals[2].ball.as_mut().unwrap().center[0] += 0.5;
    let moved = difference(&task(), &after);
    assert_eq!(moved.sub_goals.keys().collect::<Vec<_>>(), [&C]);
    assert_ne!(moved.sub_goals[&C].before, moved.sub_goals[&C].after);
}

#[test]
fn a_sub_goal_that_is_gone_keeps_its_transitions_in_the_union() {
    let found = found(&[Edit::RemoveSubGoal { symbol: C, first_new: StateId(9) }]);
    assert_eq!(found.sub_goals.keys().collect::<Vec<_>>(), [&C]);
    assert!(found.sub_goals[&C].after.is_none());
    assert!(found.transitions[&(StateId(2), C)].after.is_none());
    assert_eq!(found.union.name_of(C), "place 2");
}

#[test]
fn other_parts_are_differences_as_well() {
    let mut after = task();
    after.name = "Another".to_owned();
    after.semantics = Semantics::Published;
    after.subsets[0].epsilon = 0.5;
    after.features.pop();
    after.demonstrations.remove(1);
    let found = difference(&task(), &after);
    assert_eq!(found.name.unwrap().after.as_deref(), Some("Another"));
    assert!(found.semantics.is_some());
    assert_eq!(found.parts, BTreeSet::from([Part::Features, Part::Subsets]));
    assert_eq!(found.demonstrations.len(), 1);
    assert_eq!(found.demonstrations[0].before.as_ref().unwrap().name, "demo 1");
}

/// `specification` with other ids of its states.
fn renumbered(specification: &Specification, ids: &[u32]) -> Specification {
    let named = |id: StateId| StateId(ids[id.0 as usize % ids.len()] + 100 * (id.0 / ids.len() as u32));
    let state = |(&id, state): (&StateId, &State)| {
        let way = |(&symbol, way): (&Symbol, &Transition)| {
            (symbol, Transition { target: named(way.target), ..way.clone() })
        };
        (named(id), State { transitions: state.transitions.iter().map(way).collect(), ..state.clone() })
    };
    let pdfa = Pdfa {
        initial: named(specification.pdfa.initial),
        states: specification.pdfa.states.iter().map(state).collect(),
    };
    Specification { pdfa, ..specification.clone() }
}

/// What holds for every difference: the union without what was added and removed is what both have, and every part that
/// is not named is the same on both sides.
#[track_caller]
fn assert_sound(before: &Specification, after: &Specification, found: &Difference) {
    let union = &found.union.pdfa;
    let added = |it: &bool| *it;
    let new_states = found.states.values().filter(|it| it.before.is_none()).count();
    let old_states: BTreeSet<StateId> =
        found.states.iter().filter(|(_, it)| it.after.is_none()).map(|(id, _)| *id).collect();
    assert_eq!(union.states.len() - new_states, before.pdfa.states.len());
    assert_eq!(union.states.len() - old_states.len(), after.pdfa.states.len());
    let new_ways = found.transitions.values().map(|it| it.before.is_none()).filter(added).count();
    let old_ways = found.transitions.values().map(|it| it.after.is_none()).filter(added).count();
    assert_eq!(union.transitions().count() - new_ways, before.pdfa.transitions().count());
    assert_eq!(union.transitions().count() - old_ways, after.pdfa.transitions().count());
    for (source, symbol, way) in after.pdfa.transitions() {
        assert_eq!(union.transition(source, symbol), Some(way), "what is after is there as it is");
    }
    assert_eq!(union.transitions().count(), found.chances.len());
    let chances = after.pdfa.probabilities(after.semantics);
    for (source, symbol, way) in union.transitions() {
        let change = found.transitions.get(&(source, symbol));
        let then = change.and_then(|it| it.before.as_ref());
        match change.map_or(after.pdfa.transition(source, symbol), |_| None) {
            Some(same) => assert_eq!(
                (same.target, found.chances[&(source, symbol)]),
                (way.target, chances.transition(source, symbol))
            ),
            None => assert!(then.is_none_or(|then| then.target == way.target)),
        }
    }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn nothing_differs_from_itself(specification in any_specification()) {
        let found = difference(&specification, &specification);
        prop_assert!(found.is_empty(), "{found:?}");
        prop_assert_eq!(&found.union, &specification);
        prop_assert_eq!(found.effect.gained.number, Some(0));
        prop_assert_eq!(found.effect.lost.number, Some(0));
    }

    #[test]
    fn ids_of_states_are_no_difference(
        words in simple_words(),
        ids in Just((0..20_u32).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        let before = learned(&words);
        let after = renumbered(&before, &ids);
        let found = difference(&before, &after);
        prop_assert!(found.is_empty(), "{:?}", signs(&found));
        prop_assert_eq!(found.union.pdfa, after.pdfa);
    }

    #[test]
    fn every_part_is_in_the_union_once(before in any_specification(), after in any_specification()) {
        assert_sound(&before, &after, &difference(&before, &after));
    }

    #[test]
    fn an_edit_is_shown_and_nothing_else(words in simple_words(), edit in any_edit()) {
        let before = learned(&words);
        let mut after = before.clone();
        let edit = with_new_ids(edit, above(&before));
        let whole = matches!(edit, Edit::Replace { .. } | Edit::MergeSubGoals { .. } | Edit::RemoveSubGoal { .. });
        let change = edit.apply(&mut after);
        prop_assume!(!whole && change.is_ok());
        // Where states become one, the one that is left may be taken for either.
        let folded = !change.unwrap().folded.is_empty();
        let found = difference(&before, &after);
        assert_sound(&before, &after, &found);
        // An edit keeps the ids of what it leaves: so what differs can be told by them.
        let keys = |pdfa: &Pdfa| pdfa.states.keys().copied().collect::<BTreeSet<_>>();
        let (old, new) = (keys(&before.pdfa), keys(&after.pdfa));
        let gone: BTreeSet<_> = old.difference(&new).copied().collect();
        let come: BTreeSet<_> = new.difference(&old).copied().collect();
        let only = |before: bool| {
            let is_it = move |it: &goalgraph::difference::Change<_>| it.before.is_some() == before && it.after.is_some() != before;
            found.states.iter().filter(|(_, it)| is_it(it)).map(|(id, _)| *id).collect::<BTreeSet<_>>()
        };
        if before.pdfa.initial == after.pdfa.initial && !folded {
            prop_assert_eq!((only(true), only(false)), (gone, come), "{:?}", edit);
        }
        if before == after {
            prop_assert!(found.is_empty());
        } else if old == new {
            prop_assert!(!found.is_empty(), "{edit:?}");
        }
    }
}
