use std::collections::BTreeSet;

use super::held_out_task;
use crate::task::{Recording, Rest, Task, Unit};

fn tasks() -> impl Iterator<Item = Task> {
    (0..120).map(held_out_task)
}

/// The word's own thing in the frames of `rest`, seen or not.
fn column<'a>(task: &Task, demonstration: &'a Recording, rest: &Rest, axis: usize) -> Vec<&'a f64> {
    let column = task.columns(&task.places[rest.place].subset).start + axis;
    demonstration.frames[rest.frames.clone()].iter().map(|frame| &frame[column]).collect()
}

/// The middle of what is seen; NaN when nothing is.
fn median(values: &[&f64]) -> f64 {
    let mut seen: Vec<f64> = values.iter().map(|value| **value).filter(|value| !value.is_nan()).collect();
    seen.sort_by(f64::total_cmp);
    seen.get(seen.len() / 2).copied().unwrap_or(f64::NAN)
}

fn metres(task: &Task, value: f64) -> f64 {
    value / task.unit.per_base()
}

#[test]
fn the_same_seed_gives_the_same_task() {
    for seed in [0, 7, u64::MAX] {
        assert_eq!(format!("{:?}", held_out_task(seed)), format!("{:?}", held_out_task(seed)));
    }
    assert_ne!(held_out_task(1).description, held_out_task(2).description);
}

#[test]
fn every_kind_unit_and_rate_occurs() {
    let descriptions: Vec<String> = tasks().map(|task| task.description).collect();
    for word in
        ["OwnPlaces", "Stacks", "Parking", "Carried", "Drone", "Arm,", "ArmOfThree", " 5 Hz", " 60 Hz"]
    {
        assert!(descriptions.iter().any(|description| description.contains(word)), "{word}");
    }
    for unit in [Unit::Metre, Unit::Millimetre, Unit::Radian] {
        assert!(tasks().any(|task| task.unit == unit));
    }
}

#[test]
fn frames_have_the_features_of_the_subsets() {
    for task in tasks() {
        let features: Vec<String> = task.subsets.iter().flat_map(|subset| subset.features.clone()).collect();
        assert_eq!(features, task.features);
        let frames = task.demonstrations.iter().flat_map(|demonstration| &demonstration.frames);
        assert!(frames.into_iter().all(|frame| frame.len() == features.len()));
    }
}

#[test]
fn every_place_is_visited_in_two_demonstrations() {
    for task in tasks() {
        let names: BTreeSet<&str> = task.places.iter().map(|place| place.name.as_str()).collect();
        assert_eq!(names.len(), task.places.len());
        for place in 0..task.places.len() {
            let visits =
                task.demonstrations.iter().filter(|demonstration| demonstration.word.contains(&place));
            assert!(visits.count() >= 2, "{}", task.description);
        }
    }
}

#[test]
fn a_word_visits_a_place_once_and_has_its_rests_in_order() {
    for task in tasks() {
        for demonstration in &task.demonstrations {
            let distinct: BTreeSet<usize> = demonstration.word.iter().copied().collect();
            assert_eq!(distinct.len(), demonstration.word.len());
            let rests = &demonstration.rests;
            assert!(rests.iter().map(|rest| rest.place).eq(demonstration.word.iter().copied()));
            assert!(rests.windows(2).all(|pair| pair[0].frames.start < pair[1].frames.start));
            assert!(rests.iter().all(|rest| rest.frames.end <= demonstration.frames.len()));
            let shortest = (0.8 * task.rate_hz) as usize;
            assert!(rests.iter().all(|rest| rest.frames.len() >= shortest), "{}", task.description);
        }
    }
}

#[test]
fn every_rest_is_seen_and_comes_into_sight_in_order() {
    for task in tasks() {
        for demonstration in &task.demonstrations {
            let firsts = demonstration.rests.iter().map(|rest| {
                let values = column(&task, demonstration, rest, 0);
                let seen = values.iter().filter(|value| !value.is_nan()).count();
                assert!(seen >= 6.min(values.len()) && seen * 5 >= values.len() * 2, "{}", task.description);
                values.iter().position(|value| !value.is_nan()).map(|offset| offset + rest.frames.start)
            });
            assert!(firsts.is_sorted_by(|a, b| a < b), "{}", task.description);
        }
    }
}

#[test]
fn rests_are_near_their_places() {
    for task in tasks() {
        for demonstration in &task.demonstrations {
            for rest in &demonstration.rests {
                for (axis, center) in task.places[rest.place].center.iter().enumerate() {
                    let median = median(&column(&task, demonstration, rest, axis));
                    let off = metres(&task, (median - center).abs());
                    assert!(off < 0.025, "{off} at {} in {}", rest.place, task.description);
                }
            }
        }
    }
}

#[test]
fn places_of_one_thing_are_apart_and_away_from_its_start() {
    for task in tasks() {
        let travels = task.unit == Unit::Radian || task.description.contains("Drone");
        let (apart, away) = if travels { (0.3, 0.35) } else { (0.03, 0.04) };
        assert!(task.separation().is_none_or(|least| metres(&task, least) >= apart - 1e-9));
        for place in &task.places {
            for demonstration in &task.demonstrations {
                let idle = &demonstration.frames[..(task.rate_hz / 2.0) as usize];
                let start = task
                    .columns(&place.subset)
                    .map(|column| median(&idle.iter().map(|frame| &frame[column]).collect::<Vec<_>>()));
                let squares = start.zip(&place.center).map(|(a, b)| (a - b) * (a - b));
                let gap = metres(&task, squares.sum::<f64>().sqrt());
                assert!(gap.is_nan() || gap >= away, "{gap} in {}", task.description);
            }
        }
    }
}

#[test]
fn nothing_arrives_before_it_was_carried() {
    for task in tasks() {
        for demonstration in &task.demonstrations {
            let first = &demonstration.rests[0];
            assert!(first.frames.start as f64 / task.rate_hz > 0.5 + 0.8);
        }
    }
}
