//! Ends, new states and transitions, and transitions that move.

use goalgraph::edit::Edit;
use goalgraph::pdfa::{StateId, Symbol};

use crate::{A, B, C, edited, language, learned, q, refused};

fn accepting(state: u32, accepting: bool) -> Edit {
    Edit::SetAccepting { state: q(state), accepting }
}

fn add(source: u32, symbol: Symbol, target: u32) -> Edit {
    Edit::AddTransition { source: q(source), symbol, target: q(target) }
}

fn shift(source: u32, symbol: Symbol, new_source: u32, new_target: u32) -> Edit {
    Edit::MoveTransition { source: q(source), symbol, new_source: q(new_source), new_target: q(new_target) }
}

#[test]
fn an_end_gets_the_weight_of_its_count_or_of_one_demonstration() {
    let before = learned(&["ab", "ab", "ab"]);
    let (off, _) = edited(&before, &accepting(2, false));
    let end = &off.pdfa.states[&q(2)];
    assert_eq!((end.accepting, end.end_count, end.end_weight), (false, 3, 0.0));
    assert_eq!(edited(&off, &accepting(2, true)).0, before);
    let (early, _) = edited(&before, &accepting(1, true));
    let end = &early.pdfa.states[&q(1)];
    assert_eq!((end.accepting, end.end_count, end.end_weight), (true, 0, 1.0));
    assert_eq!(language(&early, 2), ["a", "ab"]);
    refused(&before, &accepting(9, true), "q9: there is no such state");
}

#[test]
fn a_new_way_weighs_one_demonstration_that_nobody_has_shown() {
    let before = learned(&["ab"]);
    let (added, change) = edited(&before, &Edit::AddState { id: q(7) });
    assert_eq!(change.added, [q(7)].into());
    let (joined, _) = edited(&added, &add(1, C, 7));
    let way = joined.pdfa.transition(q(1), C).unwrap();
    assert_eq!((way.target, way.count, way.weight), (q(7), 0, 1.0));
    assert_eq!(joined.pdfa.states[&q(7)].completed, [A, C].into(), "what is completed on the way to it");
    let (joined, _) = edited(&joined, &add(7, A, 2));
    assert_eq!(joined.pdfa.states[&q(2)].completed, [A, B].into(), "known already");
    refused(&before, &add(0, A, 2), "q0: there is already a transition by g0");
    refused(&before, &add(0, Symbol(9), 2), "g9: there is no such sub-goal");
    refused(&before, &add(8, B, 2), "q8: there is no such state");
    refused(&before, &add(0, B, 8), "q8: there is no such state");
}

#[test]
fn ids_of_states_are_never_taken_twice() {
    let before = learned(&["ab"]);
    let sentence = "q2: a new state needs an id above q2, because ids are never reused";
    refused(&before, &Edit::AddState { id: q(2) }, sentence);
    let word = Edit::AddWord { word: vec![C], first_new: q(1) };
    refused(&before, &word, "q1: a new state needs an id above q2, because ids are never reused");
    let (full, _) = edited(&before, &Edit::AddState { id: StateId(u32::MAX) });
    let sentence = "there is no id left for a new state: q4294967295 is the last";
    refused(&full, &Edit::AddState { id: StateId(u32::MAX) }, sentence);
    refused(&full, &Edit::AddWord { word: vec![C], first_new: StateId(u32::MAX) }, sentence);
    let last = Edit::AddWord { word: vec![C, A], first_new: StateId(u32::MAX) };
    refused(&before, &last, sentence);
}

#[test]
fn a_transition_that_moves_keeps_its_weight_and_where_it_starts_its_count() {
    let before = learned(&["ab", "ab", "c"]);
    let (after, _) = edited(&before, &shift(1, B, 1, 3));
    let way = after.pdfa.transition(q(1), B).unwrap();
    assert_eq!((way.target, way.count, way.weight), (q(3), 2, 2.0));
    let (after, change) = edited(&before, &shift(1, B, 3, 2));
    assert!(after.pdfa.transition(q(1), B).is_none() && change.removed.is_empty());
    let way = after.pdfa.transition(q(3), B).unwrap();
    assert_eq!((way.target, way.count, way.weight), (q(2), 0, 2.0));
    assert_eq!(edited(&before, &shift(1, B, 1, 2)).0, before);
    refused(&before, &shift(0, A, 1, 9), "q9: there is no such state");
    refused(&before, &shift(0, A, 9, 1), "q9: there is no such state");
    refused(&before, &shift(1, A, 0, 2), "q1: there is no transition by g0");
    let (full, _) = edited(&before, &add(3, B, 2));
    refused(&full, &shift(1, B, 3, 2), "q3: there is already a transition by g1");
}
