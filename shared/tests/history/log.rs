//! The log of a history: its round trip, what is refused, and a file of version 1 that must always be read.

use goalgraph::edit::{Edit, Outcome, Pruned};
use goalgraph::history::{History, HistoryLog, Mark};
use goalgraph::pdfa::{Semantics, StateId, Symbol};

use crate::{base, rename, renamed, transaction};

/// One of every edit, in ten transactions, the last two undone.
fn everything() -> History {
    let q = StateId;
    let (a, b, c) = (Symbol(0), Symbol(1), Symbol(2));
    let replacement = crate::generate::learned(&[vec![a, b, c]]).to_json();
    let name = |name: &str| name.to_owned();
    let gestures: [(&str, Vec<Edit>); 10] = [
        (
            "names",
            vec![
                rename("Twee blokken"),
                Edit::RenameState { state: q(1), name: name("half") },
                Edit::RenameSubGoal { symbol: a, name: name("rood <b>1</b>") },
                Edit::RecolorSubGoal { symbol: a, color: Some(3) },
            ],
        ),
        (
            "words",
            vec![
                Edit::AddWord { word: vec![c, a], first_new: q(4) },
                Edit::ForbidWord { word: vec![b, a], first_new: q(8) },
            ],
        ),
        (
            "reweight",
            vec![Edit::Reweight {
                state: q(0),
                outcome: Outcome::Transition(a),
                probability: 0.4,
                locked: [Outcome::Transition(Symbol(3)), Outcome::End].into(),
            }],
        ),
        (
            "states",
            vec![
                Edit::AddState { id: q(20) },
                Edit::AddTransition { source: q(0), symbol: Symbol(3), target: q(20) },
                Edit::SetAccepting { state: q(20), accepting: true },
                Edit::MoveTransition { source: q(0), symbol: Symbol(3), new_source: q(1), new_target: q(20) },
            ],
        ),
        ("merge", vec![Edit::MergeStates { kept: q(1), merged: q(4) }]),
        (
            "prune",
            vec![
                Edit::PruneTransition { source: q(1), symbol: Symbol(3), ways: Pruned::Cut },
                Edit::PruneState { state: q(1), ways: Pruned::Heal },
            ],
        ),
        (
            "reset",
            vec![
                Edit::SetSemantics { semantics: Semantics::Published },
                Edit::SetSemantics { semantics: Semantics::MaximumLikelihood },
            ],
        ),
        ("learn again", vec![Edit::Replace { specification: replacement }]),
        ("weights", vec![Edit::ResetWeights { state: q(0) }]),
        (
            "sub-goals",
            vec![
                Edit::MergeSubGoals { kept: a, merged: b, first_new: q(30) },
                Edit::RemoveSubGoal { symbol: c, first_new: q(31) },
            ],
        ),
    ];
    let mut history = History::new(base());
    for (label, edits) in gestures {
        let done = history.commit(transaction(label, &edits));
        assert_eq!(done, Ok(()), "{label}");
        if label == "merge" {
            history.mark(Mark::Saved);
        }
    }
    history.jump(8);
    history.mark(Mark::Approved);
    history
}

#[test]
fn a_log_of_version_1_is_read_for_ever() {
    let written = include_str!("../data/history-v1.json");
    let log = HistoryLog::from_json(written).unwrap();
    let history = History::from_log(log).unwrap();
    assert_eq!((history.position(), history.labels().len()), (8, 10));
    assert_eq!((history.marked(Mark::Saved), history.marked(Mark::Approved)), (Some(5), Some(8)));
    assert_eq!(history.log(), everything().log());
    assert_eq!(history.log().to_json(), written, "the same history is written as the same bytes");
    assert_eq!(history.specification(), everything().specification());
}

/// The log of two transactions with one of its texts replaced.
#[track_caller]
fn refused(from: &str, to: &str, sentence: &str) {
    let text = renamed(&["one", "two"]).log().to_json();
    assert!(text.contains(from), "{from} in {text}");
    let read = HistoryLog::from_json(&text.replacen(from, to, 1)).and_then(History::from_log);
    assert_eq!(read.unwrap_err().to_string(), sentence);
}

#[test]
fn what_cannot_have_been_done_is_refused_with_its_place() {
    refused("\"version\": 1", "\"version\": 2", "version: 2, but this program reads version 1");
    let format = "format: \"goalgraph-specification\" instead of \"goalgraph-history\"";
    refused("goalgraph-history", "goalgraph-specification", format);
    refused("\"position\": 2", "\"position\": 3", "position: 3, but there are 2 transactions");
    refused(
        "\"position\": 2",
        "\"position\": 2, \"marks\": {\"saved\": 9}",
        "marks: 9, but there are 2 transactions",
    );
    refused("\"name\": \"two\"", "\"name\": \" \"", "transactions[1], \"two\": the name is blank");
    refused(
        "\\\"initial\\\": \\\"q0\\\"",
        "\\\"initial\\\": \\\"q9\\\"",
        "base: automaton.initial: there is no state q9",
    );
    refused("\"position\": 2,", "", "line 29, column 1: missing field `position`");
    let unknown = "line 4, column 7: unknown field `bas`, expected one of `format`, `version`, `base`, `transactions`, \
        `position`, `marks`, `next_state`";
    refused("\"base\"", "\"bas\"", unknown);
}

#[test]
fn a_log_of_another_version_is_named_as_such_whatever_its_shape() {
    let newer =
        HistoryLog::from_json(r#"{"format": "goalgraph-history", "version": 7, "tree": []}"#).unwrap_err();
    assert_eq!(newer.to_string(), "version: 7, but this program reads version 1");
    let log = HistoryLog { version: 0, ..renamed(&[]).log() };
    assert_eq!(
        History::from_log(log).unwrap_err().to_string(),
        "version: 0, but this program reads version 1"
    );
    assert!(HistoryLog::from_json("").is_err() && HistoryLog::from_json("[1]").is_err());
}
