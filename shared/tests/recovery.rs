//! Demonstrations whose truth is known: sub-goals, every word and the automaton come out exactly, with no setting at all.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

#[path = "recovery/any_recording.rs"]
mod any_recording;
#[path = "recovery/truth.rs"]
mod truth;

use std::collections::BTreeSet;
use std::path::Path;

use goalgraph::import::{Header, import, import_words};
use goalgraph::infer::{InferRequest, Inference, infer};
use goalgraph::points::distance;
use goalgraph_tasks as tasks;
use goalgraph_tasks::Task;
use truth::{demonstrations, difference};

fn inferred(task: &Task) -> Inference {
    infer(&demonstrations(task).unwrap(), &InferRequest::default(), &mut |_| {}).unwrap()
}

/// The facts that a paper would print: sub-goals, distinct words, states.
fn facts(inference: &Inference) -> (usize, usize, usize) {
    let specification = &inference.specification;
    let words: BTreeSet<_> = specification.demonstrations.iter().map(|it| &it.word).collect();
    (specification.sub_goals.len(), words.len(), specification.pdfa.states.len())
}

fn check(task: &Task, expected: (usize, usize, usize)) {
    let inference = inferred(task);
    assert_eq!(difference(task, &inference), None, "{}", task.description);
    assert_eq!(facts(&inference), expected, "{}", task.description);
}

const SEEDS: std::ops::Range<u64> = 0..4;

#[test]
fn a_tower_has_two_words_and_its_last_block_always_comes_last() {
    for seed in SEEDS {
        check(&tasks::tower(seed, 9), (3, 2, 5));
    }
}

#[test]
fn two_stacks_have_six_orders_and_nine_states() {
    for seed in SEEDS {
        check(&tasks::two_stacks(seed, 18), (4, 6, 9));
    }
}

#[test]
fn four_blocks_have_24_orders_and_16_states() {
    for seed in SEEDS {
        check(&tasks::four_blocks(seed, 24), (4, 24, 16));
    }
}

#[test]
fn places_that_one_thing_visits_are_found() {
    for seed in SEEDS {
        for task in [tasks::four_places(seed, 12), tasks::drone(seed, 10), tasks::arm(seed, 10)] {
            assert_eq!(difference(&task, &inferred(&task)), None, "{}", task.description);
        }
    }
}

#[test]
fn rebuilt_stacks_have_three_sub_goals_a_level() {
    for seed in SEEDS {
        for stacks in 1..=4 {
            let task = tasks::rebuilt_stack(stacks, seed, 9);
            let inference = inferred(&task);
            assert_eq!(difference(&task, &inference), None, "{}", task.description);
            assert_eq!(inference.specification.sub_goals.len(), 3 * stacks);
        }
    }
}

#[test]
fn a_recorded_robot_stacks_two_blocks_and_puts_one_beside() {
    let path = |file| Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/panda-stack-and-one").join(file);
    let bytes = std::fs::read(path("demonstrations.csv")).unwrap();
    let demonstrations = import("demonstrations.csv", &bytes, Header::Detect).unwrap();
    let specification = infer(&demonstrations, &InferRequest::default(), &mut |_| {}).unwrap().specification;

    let found: Vec<_> = specification.sub_goals.iter().map(|it| it.ball.as_ref().unwrap()).collect();
    let expected =
        [("red", [0.06, -0.10, 0.025]), ("green", [0.06, -0.10, 0.075]), ("blue", [0.04, 0.13, 0.025])];
    assert_eq!(found.len(), expected.len());
    for (ball, (subset, center)) in found.iter().zip(&expected) {
        assert_eq!(ball.subset, *subset);
        assert!(distance(&ball.center, center) < 0.01, "{subset} at {:?}", ball.center);
    }
    let file = import_words(&std::fs::read(path("words.txt")).unwrap()).unwrap();
    let words: Vec<Vec<String>> =
        file.words.iter().map(|word| file.named(word).map(str::to_owned).collect()).collect();
    let name = |symbol| found[symbol as usize].subset.clone();
    let read = specification.demonstrations.iter();
    let read: Vec<Vec<String>> =
        read.map(|it| it.word.iter().map(|symbol| name(symbol.0)).collect()).collect();
    assert_eq!(read, words);
    let orders: BTreeSet<_> = read.iter().collect();
    assert_eq!(orders.len(), 3);
    assert!(orders.iter().all(|order| {
        let at = |block: &str| order.iter().position(|name| name == block);
        at("red") < at("green")
    }));
}

/// The seeds below `end` of which anything comes out wrong.
fn missed(generate: impl Fn(u64) -> Task, end: u64) -> Vec<u64> {
    let is_missed = |&seed: &u64| {
        let task = generate(seed);
        difference(&task, &inferred(&task)).is_some()
    };
    (0..end).filter(is_missed).collect()
}

// A known miss is written down, so that a change for the better shows as well as one for the worse.

#[test]
fn random_tasks_are_recovered_but_for_the_known_misses() {
    assert_eq!(missed(tasks::random_task, 300), [225]);
}

#[test]
fn tasks_of_another_hand_are_recovered_but_for_the_known_misses() {
    assert_eq!(missed(tasks::held_out_task, 300), [] as [u64; 0]);
}
