//! The history of a specification: undo, redo, jumps, marks, and its log.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

#[path = "edit/generate.rs"]
#[allow(dead_code, reason = "the tests of edits need the rest")]
mod generate;
#[path = "history/log.rs"]
mod log;

use std::sync::Arc;

use generate::{any_edit, cases, extreme_specification, with_new_ids};
use goalgraph::edit::Edit;
use goalgraph::history::{History, Mark, Transaction};
use goalgraph::pdfa::{StateId, Symbol, Word};
use goalgraph::specification::Specification;
use proptest::prelude::*;

fn base() -> Specification {
    generate::learned(&[vec![Symbol(0), Symbol(1)], vec![Symbol(1), Symbol(0)]])
}

fn transaction(label: &str, edits: &[Edit]) -> Transaction {
    Transaction { label: label.to_owned(), edits: edits.to_vec() }
}

fn rename(name: &str) -> Edit {
    Edit::RenameTask { name: name.to_owned() }
}

/// A history with one transaction for each name.
fn renamed(names: &[&str]) -> History {
    let mut history = History::new(base());
    for name in names {
        history.commit(transaction(name, &[rename(name)])).unwrap();
    }
    history
}

#[test]
fn what_was_done_is_undone_and_done_again_step_by_step() {
    let mut history = renamed(&["one", "two"]);
    assert_eq!((history.position(), history.labels()), (2, vec!["one".to_owned(), "two".to_owned()]));
    assert!(history.undo());
    assert_eq!((history.position(), history.specification().name.as_str()), (1, "one"));
    assert!(history.undo());
    assert_eq!(history.specification(), &base());
    assert!(!history.undo());
    assert!(history.redo() && history.redo() && !history.redo());
    assert_eq!(history.specification().name, "two");
    history.jump(0);
    assert_eq!(history.specification(), &base());
    history.jump(77);
    assert_eq!((history.position(), history.specification().name.as_str()), (2, "two"));
    assert_eq!(history.labels().len(), 2, "what is undone is still listed");
}

#[test]
fn a_transaction_happens_as_a_whole_or_not_at_all() {
    let mut history = renamed(&["one", "two"]);
    history.undo();
    let before = history.shared();
    let bad = [rename("three"), Edit::PruneState { state: StateId(0), ways: goalgraph::edit::Pruned::Cut }];
    let error = history.commit(transaction("bad", &bad)).unwrap_err();
    assert_eq!(error.to_string(), "the initial state q0 cannot be pruned");
    assert!(Arc::ptr_eq(&before, &history.shared()));
    assert!(history.redo(), "what was undone is still there");
}

#[test]
fn a_new_transaction_forgets_what_was_undone_and_the_marks_on_it() {
    let mut history = renamed(&["one", "two", "three"]);
    history.mark(Mark::Approved);
    history.jump(1);
    history.mark(Mark::Saved);
    assert_eq!((history.marked(Mark::Saved), history.marked(Mark::Approved)), (Some(1), Some(3)));
    history.commit(transaction("other", &[rename("other")])).unwrap();
    assert_eq!(history.labels(), ["one", "other"]);
    assert_eq!((history.marked(Mark::Saved), history.marked(Mark::Approved)), (Some(1), None));
    assert!(!history.redo());
}

#[test]
fn an_id_is_never_given_again_not_even_of_a_state_that_is_forgotten() {
    let mut history = History::new(base());
    assert_eq!(history.next_state(), StateId(4));
    history.commit(transaction("add", &[Edit::AddState { id: StateId(4) }])).unwrap();
    assert_eq!(history.next_state(), StateId(5));
    history.undo();
    assert_eq!(history.next_state(), StateId(5));
    history.commit(transaction("rename", &[rename("one")])).unwrap();
    assert_eq!(history.next_state(), StateId(5));
    assert_eq!(History::from_log(history.log()).unwrap().next_state(), StateId(5));
    let gone =
        [Edit::AddState { id: StateId(9) }, Edit::MergeStates { kept: StateId(0), merged: StateId(9) }];
    history.commit(transaction("add and merge", &gone)).unwrap();
    assert_eq!(history.next_state(), StateId(10));
    let before = history.log();
    let reused = history.commit(transaction("again", &[Edit::AddState { id: StateId(9) }]));
    assert_eq!(
        reused.unwrap_err().to_string(),
        "q9: a new state needs an id above q9, because ids are never reused"
    );
    assert_eq!(history.log(), before);
}

#[test]
fn what_was_learned_last_is_the_last_replacement_before_the_present() {
    let mut history = renamed(&["one"]);
    assert_eq!(*history.learned(), base());
    let other = generate::learned(&[Word::new()]);
    let replace = Edit::Replace { specification: other.to_json() };
    history.commit(transaction("learn again", &[replace, rename("again")])).unwrap();
    history.commit(transaction("two", &[rename("two")])).unwrap();
    assert_eq!(*history.learned(), other);
    assert_eq!(history.specification().name, "two");
    history.jump(1);
    assert_eq!(*history.learned(), base());
    history.jump(2);
    assert_eq!(*history.learned(), other);
}

#[test]
fn who_keeps_a_specification_keeps_it_as_it_was() {
    let mut history = renamed(&["one"]);
    let kept = history.shared();
    history.undo();
    assert_eq!((kept.name.as_str(), history.specification().name.as_str()), ("one", "Task"));
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn any_jumps_between_any_transactions_give_the_same_bytes(
        start in extreme_specification(),
        gestures in prop::collection::vec(prop::collection::vec(any_edit(), 1..3), 1..12),
        jumps in prop::collection::vec(0..13_usize, 0..12),
    ) {
        let mut history = History::new(start);
        let mut texts = vec![history.specification().to_json()];
        for edits in gestures {
            let before = history.shared();
            let next = history.next_state();
            let edits = edits.into_iter().map(|edit| with_new_ids(edit, next)).collect();
            if history.commit(Transaction { label: format!("gesture {}", texts.len()), edits }).is_ok() {
                generate::assert_sound(history.specification());
                texts.push(history.specification().to_json());
            } else {
                prop_assert!(Arc::ptr_eq(&before, &history.shared()));
            }
            prop_assert_eq!(history.position(), texts.len() - 1);
        }
        for position in jumps.into_iter().chain([0, usize::MAX]) {
            history.jump(position);
            prop_assert_eq!(history.position(), position.min(texts.len() - 1));
            prop_assert_eq!(&history.specification().to_json(), &texts[history.position()]);
            let mut read = History::from_log(history.log()).unwrap();
            prop_assert_eq!(&read.specification().to_json(), &texts[history.position()]);
            prop_assert_eq!(read.log().to_json(), history.log().to_json());
            while read.undo() {}
            prop_assert_eq!(&read.specification().to_json(), &texts[0]);
        }
    }
}
