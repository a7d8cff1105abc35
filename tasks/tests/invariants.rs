//! What holds of every task, named or random.

use goalgraph_tasks::{
    Recording, Rest, Task, Unit, arm, drone, four_blocks, four_places, random_task, rebuilt_stack, tower,
    two_stacks,
};

const RANDOM_TASKS: u64 = 150;

fn check_all(check: impl Fn(&Task)) {
    for named in [tower, two_stacks, four_blocks, four_places, drone, arm] {
        check(&named(5, 12));
    }
    check(&rebuilt_stack(4, 5, 3));
    for seed in 0..RANDOM_TASKS {
        check(&random_task(seed));
    }
}

/// Seen values of the subset that rests, with their frames.
fn seen<'a>(
    task: &'a Task,
    demonstration: &'a Recording,
    subset: &str,
) -> impl Iterator<Item = (usize, &'a [f64])> {
    let columns = task.columns(subset);
    let frames = demonstration.frames.iter().enumerate();
    frames
        .map(move |(index, frame)| (index, &frame[columns.clone()]))
        .filter(|(_, point)| point.iter().all(|value| !value.is_nan()))
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The frames of a rest until the next thing is placed.
fn until_next(demonstration: &Recording, index: usize) -> std::ops::Range<usize> {
    let rest: &Rest = &demonstration.rests[index];
    let next = demonstration.rests.get(index + 1).map(|rest| rest.frames.start);
    rest.frames.start..next.map_or(rest.frames.end, |next| next.min(rest.frames.end))
}

/// A table in metres: a centimetre is 0.01, but for agents ten times that.
fn scaled(task: &Task, metres: f64) -> f64 {
    let is_agent = task.subsets.iter().any(|subset| ["drone", "arm"].contains(&subset.name.as_str()));
    metres * task.unit.per_base() * if is_agent { 5.0 } else { 1.0 }
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    for seed in 0..20 {
        assert_eq!(random_task(seed).csv_all(), random_task(seed).csv_all());
    }
    assert_ne!(random_task(1).csv_all(), random_task(2).csv_all());
    assert_eq!(tower(3, 9).csv_all(), tower(3, 9).csv_all());
}

#[test]
fn the_bytes_are_those_of_every_other_machine() {
    let hash = |task: Task| {
        let fnv_1a = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        task.csv_all().bytes().fold(0xcbf2_9ce4_8422_2325, fnv_1a)
    };
    assert_eq!(hash(two_stacks(1, 18)), 0x0de4_6356_8d69_febb);
    assert_eq!(hash(arm(1, 10)), 0x8a87_3072_699f_2134);
    let random = (0..20).map(random_task).map(hash).fold(0, u64::wrapping_add);
    assert_eq!(random, 0x2f69_a414_607e_2a9b);
}

#[test]
fn frames_have_one_value_a_feature_and_subsets_hold_every_feature_once() {
    check_all(|task| {
        let features: Vec<&String> = task.subsets.iter().flat_map(|subset| &subset.features).collect();
        assert_eq!(features, task.features.iter().collect::<Vec<_>>());
        let frames = task.demonstrations.iter().flat_map(|demonstration| &demonstration.frames);
        assert!(frames.into_iter().all(|frame| frame.len() == task.features.len()));
    });
}

#[test]
fn a_word_names_each_of_its_places_once_and_has_a_rest_for_each() {
    check_all(|task| {
        for demonstration in &task.demonstrations {
            let word = &demonstration.word;
            assert!(!word.is_empty(), "{}", task.description);
            let rests: Vec<usize> = demonstration.rests.iter().map(|rest| rest.place).collect();
            assert_eq!(&rests, word, "{}", task.description);
            assert!(demonstration.rests.is_sorted_by_key(|rest| rest.frames.start));
            let mut symbols = word.clone();
            symbols.sort_unstable();
            symbols.dedup();
            assert_eq!(symbols.len(), word.len(), "{}", task.description);
            assert!(symbols.iter().all(|&symbol| symbol < task.places.len()));
        }
    });
}

#[test]
fn each_place_is_visited_by_two_demonstrations() {
    check_all(|task| {
        for place in 0..task.places.len() {
            let visits = task.demonstrations.iter();
            let visits = visits.filter(|demonstration| demonstration.word.contains(&place));
            assert!(visits.count() >= 2, "{} of {}", task.places[place].name, task.description);
        }
    });
}

#[test]
fn a_rest_is_long_enough_and_seen_before_the_next_thing_is_placed() {
    check_all(|task| {
        for demonstration in &task.demonstrations {
            for (index, rest) in demonstration.rests.iter().enumerate() {
                assert!(rest.frames.len() >= 4, "{}", task.description);
                let seconds = rest.frames.len() as f64 / task.rate_hz;
                assert!(seconds >= 0.6, "{seconds} s, {}", task.description);
                let subset = &task.places[rest.place].subset;
                let frames = until_next(demonstration, index);
                let count =
                    seen(task, demonstration, subset).filter(|(frame, _)| frames.contains(frame)).count();
                assert!(count >= 4, "{count} frames, {}", task.description);
            }
        }
    });
}

#[test]
fn a_resting_thing_is_seen_at_its_place_but_for_wild_detections() {
    check_all(|task| {
        let near = scaled(task, 0.015);
        for demonstration in &task.demonstrations {
            for (index, rest) in demonstration.rests.iter().enumerate() {
                let place = &task.places[rest.place];
                let frames = until_next(demonstration, index);
                let distances = seen(task, demonstration, &place.subset)
                    .filter(|(frame, _)| frames.contains(frame))
                    .map(|(_, point)| distance(point, &place.center));
                let is_near: Vec<bool> = distances.map(|distance| distance < near).collect();
                let count = is_near.iter().filter(|&&is_near| is_near).count();
                assert!(count >= 4, "{} in {}", place.name, task.description);
                assert!(count * 2 > is_near.len(), "{} in {}", place.name, task.description);
            }
        }
    });
}

#[test]
fn nothing_starts_near_a_place_of_its_own() {
    check_all(|task| {
        for demonstration in &task.demonstrations {
            for place in &task.places {
                let first = seen(task, demonstration, &place.subset).next();
                let (_, point) = first.unwrap_or_else(|| panic!("{}", task.description));
                let off = distance(point, &place.center);
                assert!(off > scaled(task, 0.05), "{off} from {}, {}", place.name, task.description);
            }
        }
    });
}

#[test]
fn places_of_one_subset_can_be_told_apart() {
    check_all(|task| {
        if let Some(separation) = task.separation() {
            assert!(separation >= scaled(task, 0.025) - 1e-9, "{separation} in {}", task.description);
        }
    });
}

#[test]
fn random_tasks_differ_in_everything() {
    let tasks: Vec<Task> = (0..RANDOM_TASKS).map(random_task).collect();
    for unit in [Unit::Metre, Unit::Millimetre, Unit::Radian] {
        assert!(tasks.iter().any(|task| task.unit == unit), "{unit:?}");
    }
    for kind in ["Apart", "Levels", "Relay", "Visits", "Drone", "Arm"] {
        assert!(tasks.iter().any(|task| task.description.contains(kind)), "{kind}");
    }
    let has_gaps = |task: &&Task| task.csv_all().contains(",,");
    assert!(tasks.iter().take(30).filter(has_gaps).count() > 5);
    assert!(tasks.iter().any(|task| task.distinct_words().len() == 1));
    assert!(tasks.iter().any(|task| task.distinct_words().len() > 4));
}
