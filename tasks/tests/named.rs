//! What the named tasks promise.

use std::collections::{BTreeMap, BTreeSet};

use goalgraph_tasks::{Task, arm, drone, four_blocks, four_places, rebuilt_stack, tower, two_stacks};

/// States of the automaton over sets of completed places.
fn states(task: &Task) -> usize {
    let mut sets: BTreeSet<BTreeSet<usize>> = BTreeSet::new();
    for demonstration in &task.demonstrations {
        for end in 0..=demonstration.word.len() {
            sets.insert(demonstration.word[..end].iter().copied().collect());
        }
    }
    sets.len()
}

/// How many demonstrations show each word, words as place names.
fn counts(task: &Task) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for demonstration in &task.demonstrations {
        let names = demonstration.word.iter().map(|&place| task.places[place].name.as_str());
        let word = names.collect::<Vec<_>>().join(", ");
        *counts.entry(word).or_default() += 1;
    }
    counts
}

#[test]
fn the_tower_has_two_words_red_first_in_six_of_nine() {
    let task = tower(1, 9);
    let expected = [
        ("red left, yellow right, green top".to_owned(), 6),
        ("yellow right, red left, green top".to_owned(), 3),
    ];
    assert_eq!(counts(&task), BTreeMap::from(expected));
    assert_eq!((task.places.len(), states(&task)), (3, 5));
}

#[test]
fn two_stacks_have_six_words_and_yellow_is_second_in_the_preferred_one() {
    for demonstrations in [12, 18, 30] {
        let task = two_stacks(1, demonstrations);
        let counts = counts(&task);
        assert_eq!(counts.len(), 6);
        let preferred = counts.iter().max_by_key(|(_, count)| **count).map(|(word, _)| word.as_str());
        assert_eq!(preferred, Some("red bottom, yellow top, green bottom, blue top"));
        assert_eq!(states(&task), 9);
    }
}

#[test]
fn four_blocks_have_24_words_and_16_states() {
    for demonstrations in [24, 60] {
        let task = four_blocks(1, demonstrations);
        assert_eq!((task.distinct_words().len(), states(&task)), (24, 16));
    }
}

#[test]
fn one_cube_visits_four_places_in_five_orders() {
    let task = four_places(1, 18);
    assert_eq!((task.subsets.len(), task.places.len(), task.distinct_words().len()), (1, 4, 5));
}

#[test]
fn a_rebuilt_stack_has_three_places_a_time_and_its_last_block_is_lifted_first() {
    for builds in 1..=4 {
        let task = rebuilt_stack(builds, 1, 4);
        assert_eq!((task.places.len(), task.distinct_words().len()), (3 * builds, 1));
        for build in 1..builds {
            let (top, next_bottom) = (&task.places[3 * build - 1], &task.places[3 * build]);
            assert_eq!(top.subset, next_bottom.subset);
        }
    }
}

#[test]
fn a_drone_visits_three_places_in_four_orders() {
    let task = drone(1, 12);
    assert_eq!(task.features, ["drone.x", "drone.y", "drone.z"]);
    assert_eq!((task.places.len(), task.distinct_words().len()), (3, 4));
}

#[test]
fn an_arm_goes_both_ways_to_the_same_final_pose() {
    let task = arm(1, 10);
    assert_eq!(task.features, ["arm.q1", "arm.q2"]);
    assert_eq!(task.distinct_words().len(), 2);
    let last = |word: &&[usize]| word.last().copied();
    let ends: BTreeSet<_> = task.distinct_words().iter().map(last).collect();
    assert_eq!(ends.len(), 1);
}

#[test]
fn both_csv_forms_hold_the_same_cells() {
    let task = two_stacks(2, 6);
    let mut lines = Vec::new();
    for index in 0..task.demonstrations.len() {
        let csv = task.csv(index);
        lines.extend(csv.lines().skip(1).map(|line| format!("{index},{line}")));
    }
    let all = task.csv_all();
    assert_eq!(all.lines().skip(1).collect::<Vec<_>>(), lines);
    assert!(all.starts_with("demo,red.x,"));
}
