//! Demonstrations that come and go one after the other: what is inferred is what is inferred from scratch, and of what is
//! known nothing is looked at again as long as the scales are the same.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::sync::LazyLock;

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import};
use goalgraph::infer::{DemonstrationKey, InferRequest, Method, Study, SubsetStudy, infer};
use goalgraph::points::Track;
use goalgraph::subset::propose_subsets;
use goalgraph_tasks::{Task, held_out_task, rebuilt_stack, tower};
use proptest::prelude::*;

fn demonstrations(task: &Task) -> Vec<Demonstration> {
    import("task.csv", task.csv_all().as_bytes(), Header::Detect).unwrap()
}

/// Many takes of a tower, and a few of tasks with less order in them.
static TASKS: LazyLock<Vec<Vec<Demonstration>>> = LazyLock::new(|| {
    let tasks = [tower(7, 30), rebuilt_stack(2, 5, 14), held_out_task(3), held_out_task(8)];
    tasks.iter().map(demonstrations).collect()
});

/// Asserts that a study that goes through these lists of demonstrations infers each time what is inferred from scratch.
fn assert_follows<'a>(all: &[Demonstration], lists: impl Iterator<Item = &'a Vec<usize>>, method: Method) {
    let request = InferRequest { method, ..InferRequest::default() };
    let mut study = Study::default();
    for list in lists {
        let chosen: Vec<Demonstration> = list.iter().map(|&index| all[index].clone()).collect();
        let expected = infer(&chosen, &request, &mut |_| {}).unwrap();
        let inferred = study.infer(&chosen, &request, &mut |_| {}).unwrap();
        assert_eq!(inferred.specification.to_json(), expected.specification.to_json());
        assert_eq!(inferred, expected);
    }
}

/// Lists of demonstrations, each with one or a few more or less than the one before.
fn lists(count: usize) -> impl Strategy<Value = Vec<Vec<usize>>> {
    let start = proptest::sample::subsequence((0..count).collect::<Vec<_>>(), count / 2..=count);
    let toggles = prop::collection::vec(prop::collection::vec(0..count, 1..3), 1..6);
    (start.prop_shuffle(), toggles).prop_map(|(start, toggles)| {
        let mut lists = vec![start];
        for toggled in toggles {
            let mut list = lists[lists.len() - 1].clone();
            for index in toggled {
                match list.iter().position(|&other| other == index) {
                    Some(at) if list.len() > 1 => drop(list.remove(at)),
                    Some(_) => {}
                    None => list.insert(index % (list.len() + 1), index),
                }
            }
            lists.push(list);
        }
        lists
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn demonstrations_that_come_and_go_give_what_they_give_from_scratch(
        (task, lists) in (0..4_usize).prop_flat_map(|task| (Just(task), lists(TASKS[task].len()))),
        method in prop_oneof![3 => Just(Method::AtRest), 1 => Just(Method::Published)],
    ) {
        assert_follows(&TASKS[task], lists.iter(), method);
    }
}

#[test]
fn demonstrations_that_come_one_by_one_give_what_they_give_from_scratch() {
    for all in TASKS.iter() {
        let lists: Vec<Vec<usize>> = (all.len() / 2..=all.len()).map(|count| (0..count).collect()).collect();
        assert_follows(all, lists.iter(), Method::AtRest);
    }
}

#[test]
fn one_more_demonstration_is_looked_at_alone_while_the_scales_stay() {
    let all = &TASKS[0];
    let subset = &propose_subsets(all[0].features())[0];
    let mut study = SubsetStudy::default();
    let mut look = |indices: std::ops::Range<usize>| {
        let keys: Vec<DemonstrationKey> =
            indices.clone().map(|index| DemonstrationKey(index as u64)).collect();
        let track = |at: usize| Track::of_features(&all[indices.start + at], &subset.features);
        let looked_at = study.look(&subset.name, &subset.features, Method::AtRest, &keys, track);
        let seen = study.seen();
        (looked_at, (seen.unclean, seen.clean, seen.stays.map(|stays| stays.min_dwell)))
    };
    let (mut alone, mut last) = (0, look(0..20));
    assert_eq!(last.0, 20);
    let ranges = (21..=30).map(|end| 0..end).chain((1..5).map(|start| start..30));
    for range in ranges {
        let (more, count) = (usize::from(range.start == 0), range.len());
        let next = look(range);
        if next.1 == last.1 {
            assert_eq!(next.0, more);
            alone += 1;
        } else {
            assert!((more..=count).contains(&next.0));
        }
        last = next;
    }
    assert!(alone > 10, "the scales stay in {alone} of 14 changes only");
}
