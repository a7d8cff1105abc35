//! Whatever is recorded, the engine answers, and its answer is a valid one.

use std::sync::Arc;

use goalgraph::demonstration::{Demonstration, Feature};
use goalgraph::infer::{InferRequest, Inference, Method, RadiusRule, infer};
use proptest::prelude::*;

const FEATURES: [&str; 5] = ["red.x", "red.y", "red.z", "blue.x", "blue.y"];

/// Values of which few are alike, many are alike, some are undefined and some are as large as a demonstration takes.
fn value() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => Just(0.25),
        4 => -1.0..1.0,
        2 => Just(f64::NAN),
        1 => prop_oneof![Just(1e100), Just(-1e100), Just(1e60), Just(f64::MIN_POSITIVE), Just(-0.0)],
    ]
}

/// A frame, and for how long nothing changes.
fn stretch() -> impl Strategy<Value = (Vec<f64>, usize)> {
    (prop::collection::vec(value(), FEATURES.len()), prop_oneof![Just(1_usize), 1..14_usize])
}

fn recording() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(stretch(), 1..8).prop_map(|stretches| {
        let frames = stretches.into_iter().flat_map(|(frame, count)| std::iter::repeat_n(frame, count));
        frames.take(40).flatten().collect()
    })
}

fn demonstrations(recordings: Vec<Vec<f64>>) -> Vec<Demonstration> {
    let features: Arc<[Feature]> = FEATURES.map(Feature::new).into();
    let named = recordings.into_iter().enumerate();
    named
        .map(|(index, values)| {
            Demonstration::new(format!("take {index}"), "", features.clone(), values).unwrap()
        })
        .collect()
}

fn request(method: Method, radius: RadiusRule) -> InferRequest {
    InferRequest { method, radius, ..InferRequest::default() }
}

fn check(recordings: Vec<Vec<f64>>, request: &InferRequest) -> Inference {
    let demonstrations = demonstrations(recordings);
    let inference = infer(&demonstrations, request, &mut |_| {}).unwrap();
    let again = infer(&demonstrations, request, &mut |_| {}).unwrap();
    assert_eq!(format!("{:?}", inference.specification), format!("{:?}", again.specification));
    assert_eq!(inference.specification.demonstrations.len(), demonstrations.len());
    for eliminated in &inference.eliminated {
        assert!(!eliminated.reason.is_empty() && eliminated.cluster.frames > 0);
    }
    inference
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 192, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_recording_has_an_answer(recordings in prop::collection::vec(recording(), 1..6)) {
        check(recordings.clone(), &request(Method::AtRest, RadiusRule::Robust));
        check(recordings.clone(), &request(Method::AtRest, RadiusRule::Largest));
        check(recordings.clone(), &request(Method::Published, RadiusRule::Robust));
        check(recordings, &request(Method::Published, RadiusRule::Largest));
    }
}

#[test]
fn single_frames_have_no_sub_goal() {
    for method in [Method::AtRest, Method::Published] {
        let inference = check(vec![vec![0.25; 5], vec![0.5; 5]], &request(method, RadiusRule::default()));
        assert_eq!(inference.specification.sub_goals, []);
        assert_eq!(inference.specification.pdfa.states.len(), 1);
    }
}

#[test]
fn a_subset_that_is_never_observed_is_named() {
    let unseen = [0.25, 0.5, 0.75, f64::NAN, f64::NAN].repeat(20);
    let inference = check(vec![unseen.clone(), unseen], &InferRequest::default());
    assert_eq!(inference.specification.sub_goals, []);
    let note = "blue is never observed in 2 of 2 demonstrations";
    assert!(inference.notes.iter().any(|it| it == note), "{:?}", inference.notes);
}
