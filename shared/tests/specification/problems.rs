//! What is found wrong with a specification that was read.

use std::collections::BTreeMap;

use goalgraph::pdfa::{Pdfa, State, StateId, Symbol, Transition};
use goalgraph::specification::{Problem, Severity, Specification, SubGoal};

use crate::example;

/// The problems as `error q3: message`.
fn problems(specification: &Specification) -> Vec<String> {
    let line = |problem: Problem| {
        let severity = if problem.severity == Severity::Error { "error" } else { "warning" };
        format!("{severity} {}: {}", problem.place(), problem.message)
    };
    specification.check().into_iter().map(line).collect()
}

/// The problems of the example after a change.
#[track_caller]
fn found(change: impl FnOnce(&mut Specification), expected: &[&str]) {
    let mut specification = example();
    change(&mut specification);
    assert_eq!(problems(&specification), expected);
}

fn state(specification: &mut Specification, id: u32) -> &mut State {
    specification.pdfa.states.get_mut(&StateId(id)).unwrap()
}

fn way(target: u32, weight: f64) -> Transition {
    Transition { target: StateId(target), count: 0, weight }
}

#[test]
fn each_problem_is_said_once_with_its_place() {
    found(
        |all| state(all, 2).accepting = false,
        &[
            "error q1: q1 is a dead end: no accepting state can be reached from it",
            "error q2: q2 is a dead end: no accepting state can be reached from it",
        ],
    );
    found(
        |all| state(all, 0).transitions.retain(|&symbol, _| symbol != Symbol(0)),
        &[
            "error q1: q1 cannot be reached from the initial state q0",
            "error q2: q2 cannot be reached from the initial state q0",
            "warning g0: red 1 is used by no transition",
        ],
    );
    found(
        |all| state(all, 0).transitions.get_mut(&Symbol(1)).unwrap().weight = 0.0,
        &["warning q0 g1 q3: yellow 1 from q0 has probability 0 and is never taken"],
    );
    found(
        |all| state(all, 3).transitions = [(Symbol(0), way(0, 1.0))].into(),
        &["warning q0: a cycle through q0, q3: the automaton accepts words of any length"],
    );
    found(
        |all| state(all, 3).transitions = [(Symbol(1), way(3, 1.0))].into(),
        &["warning q3: a cycle through q3: the automaton accepts words of any length"],
    );
    found(
        |all| {
            let twin = SubGoal { id: Symbol(2), name: "red 2".to_owned(), ..all.sub_goals[0].clone() };
            all.sub_goals.push(twin);
        },
        &["warning g2: red 2 is used by no transition", "warning g2: the balls of red 1 and red 2 overlap"],
    );
}

#[test]
fn weights_that_leave_no_way_to_an_end_are_an_error() {
    found(
        |all| state(all, 3).end_weight = 0.0,
        &["error q3: q3 is accepting, but of weight 0: no word ends there or further on"],
    );
    found(
        |all| state(all, 1).transitions.get_mut(&Symbol(1)).unwrap().weight = 0.0,
        &[
            "error q1: q1 is a dead end: no accepting state can be reached from it",
            "warning q1 g1 q2: yellow 1 from q1 has probability 0 and is never taken",
        ],
    );
    found(
        |all| state(all, 1).accepting = true,
        &["warning q1: q1 is accepting, but with probability 0: no word ends there"],
    );
}

#[test]
fn a_specification_of_nothing_is_valid_but_leads_nowhere() {
    let mut empty = example();
    empty.pdfa = Pdfa::from_words(&[]);
    empty.sub_goals.clear();
    empty.demonstrations.clear();
    assert_eq!(Specification::from_json(&empty.to_json()).unwrap(), empty);
    let expected = [
        "error q0: no words: nothing is accepted, for no way leads from q0 to an end",
        "error q0: q0 is a dead end: no accepting state can be reached from it",
    ];
    assert_eq!(problems(&empty), expected);
}

/// One word of `length` symbols, one state after the other.
fn chain(length: u32) -> Specification {
    let sub_goal = |id: u32| SubGoal {
        id: Symbol(id),
        name: String::new(),
        ball: None,
        frames: 0,
        demonstrations: 0,
        color: None,
    };
    let state = |id: u32| {
        let last = id == length;
        let transitions =
            if last { BTreeMap::new() } else { BTreeMap::from([(Symbol(id % 7), way(id + 1, 1.0))]) };
        let end_weight = f64::from(u8::from(last));
        (StateId(id), State { accepting: last, end_weight, transitions, ..State::default() })
    };
    Specification {
        sub_goals: (0..7).map(sub_goal).collect(),
        pdfa: Pdfa { initial: StateId(0), states: (0..=length).map(state).collect() },
        demonstrations: Vec::new(),
        features: Vec::new(),
        subsets: Vec::new(),
        ..example()
    }
}

#[test]
fn a_hundred_thousand_states_are_read_and_checked() {
    let long = chain(100_000);
    let read = Specification::from_json(&long.to_json()).unwrap();
    assert!(read == long);
    assert_eq!(read.check(), []);
}
