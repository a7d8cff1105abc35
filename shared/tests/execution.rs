//! Following a specification: what a robot does next and reports, however availability changes.

#![allow(clippy::unwrap_used)]

mod automata;

use std::collections::BTreeSet;
use std::sync::Arc;

use automata::{any_automaton, live, probabilities, specification, two_stacks};
use goalgraph::execution::{Execution, Numbered, Observation};
use goalgraph::pdfa::{Pdfa, Semantics, Symbol};
use goalgraph::run::{Phase, Run, RunEvent};
use proptest::prelude::*;

const A: Symbol = Symbol(0);
const B: Symbol = Symbol(1);
const C: Symbol = Symbol(2);
const D: Symbol = Symbol(3);

/// Begins a run of these words while `unavailable` cannot be completed.
fn begin(words: &[Vec<Symbol>], unavailable: &[Symbol]) -> (Execution, Vec<Numbered>) {
    let specification = specification(Pdfa::from_words(words), words.to_vec());
    Execution::begin(Arc::new(specification), &unavailable.iter().copied().collect())
}

/// Events in a few letters each.
fn shown(events: &[Numbered]) -> String {
    let joined = |word: &[Symbol]| word.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
    let show = |(number, event): &Numbered| {
        let text = match event {
            RunEvent::Planned { state, word, .. } => format!("planned {state}: {}", joined(word)),
            RunEvent::Started { sub_goal } => format!("started {sub_goal}"),
            RunEvent::Completed { sub_goal } => format!("completed {sub_goal}"),
            RunEvent::Unavailable { sub_goal, .. } => format!("unavailable {sub_goal}"),
            RunEvent::Available { sub_goal } => format!("available {sub_goal}"),
            RunEvent::Replanned { state, word, .. } => format!("replanned {state}: {}", joined(word)),
            RunEvent::Waiting { state } => format!("waiting {state}"),
            RunEvent::Paused => "paused".to_owned(),
            RunEvent::Resumed => "resumed".to_owned(),
            RunEvent::Finished => "finished".to_owned(),
            RunEvent::Failed { reason } => format!("failed, {reason}"),
            RunEvent::Stopped => "stopped".to_owned(),
        };
        format!("{number} {text}")
    };
    events.iter().map(show).collect::<Vec<_>>().join("\n")
}

/// Completes what is to be done until there is nothing.
fn work(execution: &mut Execution) -> Vec<Numbered> {
    let mut events = Vec::new();
    while let Some(sub_goal) = execution.next() {
        events.extend(execution.observe(Observation::Completed(sub_goal)));
    }
    events
}

/// Begins a run, observes all of this, and works until there is nothing to do.
fn check(words: &[Vec<Symbol>], unavailable: &[Symbol], observations: &[Observation], expected: &[&str]) {
    let (mut execution, mut events) = begin(words, unavailable);
    for observation in observations {
        events.extend(execution.observe(observation.clone()));
    }
    events.extend(work(&mut execution));
    assert_eq!(shown(&events).lines().collect::<Vec<_>>(), expected);
}

#[test]
fn a_run_without_trouble_follows_its_first_plan() {
    check(
        &[vec![A, B], vec![A, B], vec![B, A]],
        &[],
        &[],
        &[
            "1 planned q0: g0 g1",
            "2 started g0",
            "3 completed g0",
            "4 started g1",
            "5 completed g1",
            "6 finished",
        ],
    );
}

#[test]
fn what_became_unavailable_is_planned_around_from_where_the_run_is() {
    check(
        &two_stacks(),
        &[],
        &[Observation::Completed(A), Observation::Unavailable(B, None)],
        &[
            "1 planned q0: g0 g1 g2 g3",
            "2 started g0",
            "3 completed g0",
            "4 started g1",
            "5 unavailable g1",
            "6 replanned q1: g2 g3",
            "7 started g2",
            "8 completed g2",
            "9 started g3",
            "10 completed g3",
            "11 waiting q6",
        ],
    );
}

#[test]
fn it_waits_for_what_it_needs_and_goes_on_when_it_is_back() {
    check(
        &[vec![A, B]],
        &[A],
        &[Observation::Available(A)],
        &[
            "1 unavailable g0",
            "2 waiting q0",
            "3 available g0",
            "4 planned q0: g0 g1",
            "5 started g0",
            "6 completed g0",
            "7 started g1",
            "8 completed g1",
            "9 finished",
        ],
    );
}

#[test]
fn a_better_way_is_taken_at_the_next_state_and_work_under_way_is_not_dropped_for_it() {
    let words = [vec![A, B, C], vec![A, B, C], vec![A, C, B], vec![B, A, C]];
    check(
        &words,
        &[B],
        &[Observation::Completed(A), Observation::Available(B)],
        &[
            "1 unavailable g1",
            "2 planned q0: g0 g2",
            "3 started g0",
            "4 completed g0",
            "5 started g2",
            "6 available g1",
            "7 replanned q1: g1 g2",
            "8 started g1",
            "9 completed g1",
            "10 started g2",
            "11 completed g2",
            "12 finished",
        ],
    );
    check(
        &[vec![A, B], vec![A, B], vec![C, B], vec![C, D], vec![C, D]],
        &[A, D],
        &[Observation::Available(A), Observation::Available(D)],
        &[
            "1 unavailable g0",
            "2 unavailable g3",
            "3 planned q0: g2 g1",
            "4 started g2",
            "5 available g0",
            "6 available g3",
            "7 completed g2",
            "8 replanned q3: g3",
            "9 started g3",
            "10 completed g3",
            "11 finished",
        ],
    );
}

#[test]
fn what_was_completed_by_accident_moves_the_run_on() {
    check(
        &two_stacks(),
        &[],
        &[Observation::Completed(C)],
        &[
            "1 planned q0: g0 g1 g2 g3",
            "2 started g0",
            "3 completed g2",
            "4 replanned q7: g0 g1 g3",
            "5 completed g0",
            "6 started g1",
            "7 completed g1",
            "8 started g3",
            "9 completed g3",
            "10 finished",
        ],
    );
}

#[test]
fn a_robot_that_leaves_the_automaton_fails_with_the_reason() {
    let events = ["1 planned q0: g0 g1", "2 started g0", "3 completed g1"];
    let reason = "4 failed, g1 was completed in q0, where the automaton has no way for it";
    check(&[vec![A, B]], &[], &[Observation::Completed(B)], &[&events[..], &[reason]].concat());
}

#[test]
fn a_pause_begins_before_the_next_sub_goal() {
    let pause = [Observation::Pause, Observation::Pause, Observation::Completed(A), Observation::Resume];
    check(
        &[vec![A, B]],
        &[],
        &pause,
        &[
            "1 planned q0: g0 g1",
            "2 started g0",
            "3 completed g0",
            "4 paused",
            "5 resumed",
            "6 started g1",
            "7 completed g1",
            "8 finished",
        ],
    );
}

#[test]
fn after_a_pause_in_which_much_happened_it_plans_anew() {
    let happened = [
        Observation::Pause,
        Observation::Unavailable(A, Some("dropped".to_owned())),
        Observation::Completed(B),
        Observation::Resume,
        Observation::Resume,
    ];
    check(
        &[vec![A, B], vec![A, B], vec![B, A]],
        &[],
        &happened,
        &[
            "1 planned q0: g0 g1",
            "2 started g0",
            "3 unavailable g0",
            "4 paused",
            "5 completed g1",
            "6 resumed",
            "7 waiting q3",
        ],
    );
}

#[test]
fn what_becomes_available_in_a_pause_at_the_end_keeps_nobody_waiting() {
    let happened =
        [Observation::Pause, Observation::Completed(A), Observation::Available(B), Observation::Resume];
    let expected = [
        "1 unavailable g1",
        "2 planned q0: g0",
        "3 started g0",
        "4 completed g0",
        "5 paused",
        "6 available g1",
    ];
    check(&[vec![A]], &[B], &happened, &[&expected[..], &["7 resumed", "8 finished"]].concat());
}

#[test]
fn nothing_follows_the_end() {
    let (mut execution, _) = begin(&[vec![A]], &[]);
    assert_eq!(shown(&execution.observe(Observation::Stop)), "3 stopped");
    let later = [Observation::Completed(A), Observation::Failed("late".to_owned()), Observation::Pause];
    for observation in later {
        assert_eq!(execution.observe(observation), []);
    }
    assert_eq!(execution.next(), None);
}

#[test]
fn a_task_that_may_end_where_it_begins_is_finished_at_once() {
    check(&[vec![]], &[], &[], &["1 finished"]);
}

/// Something that happens to a run, or a step of the robot's own work.
fn any_observation() -> impl Strategy<Value = Option<Observation>> {
    let symbol = || (0..3_u32).prop_map(Symbol);
    prop_oneof![
        4 => Just(None),
        2 => symbol().prop_map(|symbol| Some(Observation::Unavailable(symbol, None))),
        2 => symbol().prop_map(|symbol| Some(Observation::Available(symbol))),
        1 => Just(Some(Observation::Pause)),
        1 => Just(Some(Observation::Resume)),
    ]
}

fn any_unavailable() -> impl Strategy<Value = BTreeSet<Symbol>> {
    prop::collection::btree_set((0..3_u32).prop_map(Symbol), 0..3)
}

/// The run that everybody sees who gets these events.
fn fold(pdfa: &Pdfa, events: &[Numbered]) -> Run {
    let probabilities = probabilities(pdfa);
    let mut run = Run::new(pdfa);
    for (number, event) in events {
        run.apply(pdfa, &probabilities, *number, event).unwrap();
    }
    run
}

proptest! {
    #[test]
    fn whatever_becomes_unavailable_a_run_stays_in_the_automaton_and_ends_or_waits(
        pdfa in any_automaton(),
        unavailable in any_unavailable(),
        observations in prop::collection::vec(any_observation(), 0..20),
    ) {
        let task = Arc::new(specification(pdfa.clone(), Vec::new()));
        let (mut execution, mut events) = Execution::begin(task, &unavailable);
        for observation in observations {
            let step = execution.next().map(Observation::Completed);
            if let Some(observation) = observation.or(step) {
                events.extend(execution.observe(observation));
            }
        }
        events.extend(execution.observe(Observation::Resume));
        events.extend(work(&mut execution));
        let run = fold(&pdfa, &events);
        prop_assert_eq!(&run, execution.run());
        prop_assert_eq!(&run.departure, &None);
        let state = run.state.unwrap();
        match run.phase {
            Phase::Finished => prop_assert!(pdfa.probabilities(Semantics::MaximumLikelihood).end(state) > 0.0),
            phase => prop_assert_eq!(phase, Phase::Waiting),
        }
        // Nothing that was done on the way has closed the way to an end.
        for symbol in run.unavailable {
            events.extend(execution.observe(Observation::Available(symbol)));
        }
        events.extend(work(&mut execution));
        let can_end = live(&pdfa, &probabilities(&pdfa)).contains(&pdfa.initial);
        prop_assert_eq!(fold(&pdfa, &events).phase == Phase::Finished, can_end);
    }

    #[test]
    fn whatever_is_completed_by_accident_the_events_stay_a_run(
        pdfa in any_automaton(),
        accidents in prop::collection::vec(prop_oneof![
            any_observation(),
            (0..3_u32).prop_map(|symbol| Some(Observation::Completed(Symbol(symbol)))),
        ], 0..20),
    ) {
        let task = Arc::new(specification(pdfa.clone(), Vec::new()));
        let (mut execution, mut events) = Execution::begin(task, &BTreeSet::new());
        for accident in accidents {
            events.extend(execution.observe(accident.unwrap_or(Observation::Resume)));
        }
        events.extend(work(&mut execution));
        let run = fold(&pdfa, &events);
        prop_assert_eq!(&run, execution.run());
        prop_assert_eq!(run.departure.is_some(), run.phase == Phase::Failed);
    }
}
