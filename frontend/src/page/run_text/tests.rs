use goalgraph::infer::infer_words;
use goalgraph::pdfa::{Semantics, StateId};
use goalgraph::protocol::monitor::RunOrigin;
use goalgraph::run::Run;

use super::*;

fn specification() -> Specification {
    let word = |word: &str| word.split(' ').map(str::to_owned).collect::<Vec<_>>();
    infer_words("", Semantics::default(), &[word("red yellow"), word("yellow red")])
}

const RED: Symbol = Symbol(0);
const YELLOW: Symbol = Symbol(1);

#[test]
fn events_are_told_with_the_names_of_sub_goals() {
    let specification = specification();
    let check = |event: RunEvent, expected: &str| {
        assert_eq!(happened(Some(&specification), &event), expected);
    };
    let word = vec![RED, YELLOW];
    check(
        RunEvent::Planned { state: StateId(0), word, probability: 0.5 },
        "Planned from q0: red, yellow; probability 0.50",
    );
    check(
        RunEvent::Replanned { state: StateId(1), word: vec![], probability: 1.0 },
        "Re-planned from q1: nothing; probability 1",
    );
    check(
        RunEvent::Unavailable { sub_goal: RED, reason: Some("out of reach".to_owned()) },
        "red is unavailable: out of reach",
    );
    check(RunEvent::Available { sub_goal: RED }, "red is available again");
    check(RunEvent::Completed { sub_goal: YELLOW }, "Completed yellow");
    check(RunEvent::Failed { reason: "gripper".to_owned() }, "Failed: gripper");
}

#[test]
fn until_the_specification_is_known_ids_stand_for_names() {
    assert_eq!(happened(None, &RunEvent::Started { sub_goal: YELLOW }), "Started g1");
}

#[test]
fn a_new_plan_says_what_is_missing_and_what_comes_now() {
    let specification = specification();
    let told = |unavailable: &[Symbol], now: &[Symbol]| replanned(Some(&specification), unavailable, now);
    assert_eq!(told(&[RED], &[YELLOW]), "Re-planned: red unavailable; now yellow");
    assert_eq!(told(&[], &[RED, YELLOW]), "Re-planned: everything is available; now red, yellow");
}

#[test]
fn a_departure_names_the_sub_goal_and_the_state() {
    let specification = specification();
    let departure = Departure::NoWay { number: 4, state: StateId(3), sub_goal: RED };
    assert_eq!(departed(Some(&specification), &departure), "Completed red in q3, for which there is no way");
    let early = Departure::EndedEarly { number: 4, state: StateId(1) };
    assert_eq!(departed(None, &early), "Finished in q1, where the task does not end");
}

#[test]
fn surprise_is_in_bits() {
    assert_eq!(surprise(-2.0 * std::f64::consts::LN_2), "2 bits");
    assert_eq!(surprise(0.0), "0 bits");
}

#[test]
fn long_ids_are_cut_between_characters() {
    assert_eq!(short_id("0192f3a4-77aa"), "0192f3a4");
    assert_eq!(short_id("läuft-ür-immer"), "läuft-ür");
    assert_eq!(short_id("r1"), "r1");
}

fn executor(connected: bool, answer: Option<Answer>) -> ExecutorView {
    let holds = answer.map(|answer| Held {
        specification: "s".to_owned(),
        name: "Two stacks".to_owned(),
        revision: 7,
        sha256: String::new(),
        answer,
    });
    ExecutorView { executor: "arm".to_owned(), software: None, connected, holds, run: None }
}

fn run(phase: Phase) -> RunView {
    let specification = specification();
    let origin = RunOrigin {
        run: "r1".to_owned(),
        executor: "arm".to_owned(),
        specification: "s".to_owned(),
        name: "Two stacks".to_owned(),
        revision: 7,
        sha256: String::new(),
        began_at: String::new(),
    };
    RunView { phase, ..RunView::new(origin, &Run::new(&specification.pdfa), String::new()) }
}

#[test]
fn a_command_that_makes_no_sense_is_refused_with_the_reason() {
    let accepted = || executor(true, Some(Answer::Accepted));
    let check = |executor: ExecutorView, phase: Option<Phase>, command, expected: Option<&str>| {
        let run = phase.map(run);
        assert_eq!(refusal(&executor, run.as_ref(), command).as_deref(), expected);
    };
    check(accepted(), None, Command::Start, None);
    check(accepted(), Some(Phase::Finished), Command::Start, None);
    check(accepted(), Some(Phase::Running), Command::Start, Some("arm is in a run already"));
    check(executor(false, None), None, Command::Stop, Some("arm is not connected"));
    check(executor(true, None), None, Command::Start, Some("arm holds no specification: approve a revision"));
    let rejected = Answer::Rejected { reason: "units".to_owned() };
    check(executor(true, Some(rejected)), None, Command::Start, Some("arm has rejected its specification"));
    check(accepted(), None, Command::Pause, Some("arm is in no run"));
    check(accepted(), Some(Phase::Paused), Command::Pause, Some("The run is paused already"));
    check(accepted(), Some(Phase::Waiting), Command::Resume, Some("The run is not paused"));
    check(accepted(), Some(Phase::Waiting), Command::Pause, None);
    check(accepted(), Some(Phase::Paused), Command::Stop, None);
}
