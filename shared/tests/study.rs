//! Inferring again after a change gives what inferring from scratch gives, and does again only what changed.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::sync::LazyLock;

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import};
use goalgraph::infer::{InferError, InferRequest, Inference, Method, RadiusRule, Study, infer};
use goalgraph::pdfa::Semantics;
use goalgraph::subset::{Setting, SubsetRequest, propose_subsets};
use proptest::prelude::*;

/// Demonstrations of three tasks' worth of takes: the blocks of a tower, with noise and wild detections.
static DEMONSTRATIONS: LazyLock<Vec<Demonstration>> = LazyLock::new(|| {
    let task = goalgraph_tasks::tower(7, 6);
    let read = |index| import("tower.csv", task.csv(index).as_bytes(), Header::Detect).unwrap();
    (0..6).flat_map(read).collect()
});

fn subsets() -> Vec<SubsetRequest> {
    propose_subsets(DEMONSTRATIONS[0].features())
}

/// What an expert does between two inferences.
#[derive(Clone, Debug)]
enum Change {
    /// Takes these demonstrations, in this order.
    Demonstrations(Vec<usize>),
    /// Takes these subsets, in this order.
    Subsets(Vec<usize>),
    /// Sets the parameters of a subset.
    Parameters(usize, Setting<f64>, Setting<usize>),
    /// Restores what was eliminated in a subset, or does not any longer.
    Restored(usize, bool),
    /// Calls a subset something else.
    Name(usize, String),
    Method(Method),
    Radius(RadiusRule),
    Semantics(Semantics),
}

/// What is inferred from, and how.
#[derive(Clone)]
struct Question {
    demonstrations: Vec<usize>,
    chosen: Vec<usize>,
    /// All subsets, chosen or not.
    subsets: Vec<SubsetRequest>,
    request: InferRequest,
}

impl Question {
    fn new() -> Self {
        let subsets = subsets();
        let chosen = (0..subsets.len()).collect();
        Self { demonstrations: vec![0, 1, 2], chosen, subsets, request: InferRequest::default() }
    }

    fn change(&mut self, change: Change, last: Option<&Inference>) {
        let count = self.subsets.len();
        match change {
            Change::Demonstrations(demonstrations) => self.demonstrations = demonstrations,
            Change::Subsets(chosen) => self.chosen = chosen.into_iter().filter(|&it| it < count).collect(),
            Change::Parameters(subset, epsilon, min_points) => {
                let subset = &mut self.subsets[subset % count];
                (subset.epsilon, subset.min_points) = (epsilon, min_points);
            }
            Change::Restored(subset, is_restored) => {
                let subset = &mut self.subsets[subset % count];
                let eliminated = last.into_iter().flat_map(|last| &last.eliminated);
                let balls = eliminated.map(|it| &it.cluster.ball).filter(|ball| ball.subset == subset.name);
                subset.restored = balls.map(|ball| ball.center.clone()).filter(|_| is_restored).collect();
            }
            Change::Name(subset, name) => self.subsets[subset % count].name = name,
            Change::Method(method) => self.request.method = method,
            Change::Radius(radius) => self.request.radius = radius,
            Change::Semantics(semantics) => self.request.semantics = semantics,
        }
    }

    fn demonstrations(&self) -> Vec<Demonstration> {
        self.demonstrations.iter().map(|&index| DEMONSTRATIONS[index].clone()).collect()
    }

    fn request(&self) -> InferRequest {
        let subsets = self.chosen.iter().map(|&index| self.subsets[index].clone()).collect();
        InferRequest { subsets, ..self.request.clone() }
    }

    fn ask(&self, study: &mut Study) -> Result<Inference, InferError> {
        study.infer(&self.demonstrations(), &self.request(), &mut |_| {})
    }

    fn anew(&self) -> Result<Inference, InferError> {
        infer(&self.demonstrations(), &self.request(), &mut |_| {})
    }
}

fn any_change() -> impl Strategy<Value = Change> {
    let epsilon = prop_oneof![Just(Setting::Auto), (0.001..0.05_f64).prop_map(Setting::Fixed)];
    let min_points = prop_oneof![Just(Setting::Auto), (1..12_usize).prop_map(Setting::Fixed)];
    let method = prop_oneof![3 => Just(Method::AtRest), 1 => Just(Method::Published)];
    let radius = prop_oneof![Just(RadiusRule::Robust), Just(RadiusRule::Largest)];
    let semantics = prop_oneof![Just(Semantics::MaximumLikelihood), Just(Semantics::Published)];
    prop_oneof![
        4 => proptest::collection::vec(0..6_usize, 0..5).prop_map(Change::Demonstrations),
        3 => proptest::sample::subsequence(vec![0, 1, 2], 0..=3).prop_shuffle().prop_map(Change::Subsets),
        4 => (0..3_usize, epsilon, min_points).prop_map(|(it, e, m)| Change::Parameters(it, e, m)),
        2 => (0..3_usize, any::<bool>()).prop_map(|(it, is_restored)| Change::Restored(it, is_restored)),
        1 => (0..3_usize, "[ab]").prop_map(|(it, name)| Change::Name(it, name)),
        1 => method.prop_map(Change::Method),
        1 => radius.prop_map(Change::Radius),
        1 => semantics.prop_map(Change::Semantics),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn after_any_changes_a_study_infers_what_is_inferred_from_scratch(
        changes in proptest::collection::vec(any_change(), 1..10),
    ) {
        let (mut study, mut question) = (Study::default(), Question::new());
        let mut last = question.ask(&mut study).ok();
        for change in changes {
            question.change(change, last.as_ref());
            let expected = question.anew();
            prop_assert_eq!(&question.ask(&mut study), &expected);
            last = expected.ok();
        }
    }
}

/// What is looked at and clustered when `study` is asked, and not when it knew already.
fn work(question: &Question, study: &mut Study) -> Vec<String> {
    let mut stages = Vec::new();
    let demonstrations = question.demonstrations();
    study.infer(&demonstrations, &question.request(), &mut |at| stages.push(at.stage.clone())).unwrap();
    stages.retain(|stage| stage.starts_with("Looking at") || stage.starts_with("Clustering"));
    stages
}

/// A question and a study that has answered it.
fn asked() -> (Question, Study) {
    let (question, mut study) = (Question::new(), Study::default());
    question.ask(&mut study).unwrap();
    (question, study)
}

#[test]
fn nothing_is_done_again_when_nothing_or_the_reading_of_weights_changes() {
    let (mut question, mut study) = asked();
    assert_eq!(work(&question, &mut study), [""; 0]);
    question.request.semantics = Semantics::Published;
    question.request.name = "Tower".to_owned();
    assert_eq!(work(&question, &mut study), [""; 0]);
}

#[test]
fn a_moved_epsilon_clusters_its_subset_only() {
    let (mut question, mut study) = asked();
    question.subsets[1].epsilon = Setting::Fixed(0.02);
    assert_eq!(work(&question, &mut study), [format!("Clustering {}", question.subsets[1].name)]);
}

#[test]
fn a_removed_subset_is_not_known_any_longer_when_it_comes_back() {
    let (mut question, mut study) = asked();
    question.chosen = vec![0, 2];
    let work_of_removal = work(&question, &mut study);
    assert!(!work_of_removal.iter().any(|stage| stage.starts_with("Looking at")), "{work_of_removal:?}");
    question.chosen = vec![0, 1, 2];
    let name = &question.subsets[1].name;
    assert_eq!(work(&question, &mut study)[0], format!("Looking at {name}"));
}

#[test]
fn other_subsets_are_clustered_again_only_if_their_stays_are_of_another_kind() {
    // As published nothing is said of a thing by how others move.
    let (mut question, mut study) = asked();
    question.request.method = Method::Published;
    question.ask(&mut study).unwrap();
    question.chosen = vec![2, 0];
    assert_eq!(work(&question, &mut study), [""; 0]);
    question.chosen = vec![0, 1, 2];
    let name = &question.subsets[1].name;
    assert_eq!(work(&question, &mut study), [format!("Looking at {name}"), format!("Clustering {name}")]);
}

#[test]
fn a_refused_request_leaves_what_is_known() {
    let (question, mut study) = asked();
    let mut refused = question.clone();
    refused.subsets[0].epsilon = Setting::Fixed(-1.0);
    assert!(refused.ask(&mut study).is_err());
    assert_eq!(work(&question, &mut study), [""; 0]);
}

#[test]
fn trying_parameters_gives_what_inferring_with_them_gives_and_changes_nothing() {
    let (mut question, mut study) = asked();
    question.subsets[0].epsilon = Setting::Fixed(0.01);
    let tried = study.sub_goals(&question.subsets[0], RadiusRule::Robust).unwrap();
    let inference = question.anew().unwrap();
    assert_eq!(tried.parameters, inference.specification.subsets[0]);
    let of_subset =
        |subset: &str| inference.eliminated.iter().filter(|it| it.cluster.ball.subset == subset).count();
    assert_eq!(tried.eliminated.len(), of_subset(&question.subsets[0].name));
    let unknown = SubsetRequest { name: "unknown".to_owned(), ..SubsetRequest::default() };
    assert_eq!(study.sub_goals(&unknown, RadiusRule::Robust), None);
    question.subsets[0].epsilon = Setting::Auto;
    assert_eq!(work(&question, &mut study), [""; 0]);
}
