//! Another epsilon is tried: the worker searches one subset with it, one request at a time, and the newest value wins.

use std::sync::Arc;

use goalgraph::subset::{Setting, SubsetRequest};
use leptos::prelude::*;

use super::{Action, App};
use crate::page::model::{Attempt, Curve, Found, Notice, UnderWay};
use crate::protocol::{Clusters, KDistanceCurve, SubsetOf, ToWorker};

/// What is done to the parameters of the subset on display.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Tune {
    /// Try this epsilon.
    To(f64),
    /// Let go of it: from now on it counts.
    Release,
    /// Put it back.
    Abort,
    /// Choose epsilon, min. points or both, here or by the engine.
    Choose {
        /// The epsilon; none for the one that is chosen now.
        epsilon: Option<Setting<f64>>,
        /// The min. points; none for those that are chosen now.
        min_points: Option<Setting<usize>>,
    },
}

impl App {
    pub(super) fn tune(self, tune: Tune) {
        match tune {
            Tune::To(epsilon) => {
                let Some(subset) = self.derived.tuning.subset.get_untracked() else { return };
                let attempt = Attempt { subset: subset.name, epsilon, released: false };
                self.model.tuning.attempt.set(Some(attempt));
                self.search_attempt();
            }
            Tune::Release => self.release(),
            Tune::Abort => self.forget_attempt(),
            Tune::Choose { epsilon, min_points } => self.choose_parameters(epsilon, min_points),
        }
    }

    /// Asks for the curve of the subset on display whenever it becomes another one.
    pub(super) fn follow_curve(self) {
        Effect::new(move |_| {
            let Some(of) = self.derived.tuning.wanted.get() else { return };
            let curve = self.model.tuning.curve;
            if curve.with(|curve| curve.of.as_ref() == Some(&of)) {
                return;
            }
            let Some(subset) = self.derived.tuning.of.get_untracked() else { return };
            let number = curve.with_untracked(|curve| curve.number + 1);
            let neighbor = of.neighbor;
            curve.update(|curve| *curve = Curve { number, of: Some(of), answer: curve.answer.take() });
            self.post(&ToWorker::KDistances { of: subset, neighbor, number }, None);
        });
    }

    /// Takes the curve that was asked for last; an earlier one is of something else.
    pub(super) fn curve_measured(self, number: u32, result: Result<KDistanceCurve, String>) {
        let curve = self.model.tuning.curve;
        if curve.with_untracked(|curve| curve.number == number) {
            let result = result.map(Arc::new);
            curve.update(|curve| curve.answer = curve.of.clone().map(|of| (of, result)));
        }
    }

    /// Has the epsilon searched that is tried, unless it was or another one still is.
    fn search_attempt(self) {
        let tuning = &self.model.tuning;
        let (Some(attempt), Some(of)) =
            (tuning.attempt.get_untracked(), self.derived.tuning.of.get_untracked())
        else {
            return;
        };
        let is_found = tuning.found.with_untracked(|found| {
            found
                .as_ref()
                .is_some_and(|it| it.subset == attempt.subset && is_same(it.epsilon, attempt.epsilon))
        });
        if is_found || attempt.released || tuning.under_way.with_untracked(Option::is_some) {
            return;
        }
        let number = tuning.searches.get_untracked() + 1;
        let Attempt { subset, epsilon, .. } = attempt;
        let with_epsilon = SubsetRequest { epsilon: Setting::Fixed(epsilon), ..of.subset.clone() };
        tuning.searches.set(number);
        tuning.under_way.set(Some(UnderWay { number, subset, epsilon }));
        self.post(&ToWorker::Preview { of: SubsetOf { subset: with_epsilon, ..of }, number }, None);
    }

    /// Takes what the search under way found, and has the newest epsilon searched if it is another one.
    pub(super) fn searched(self, number: u32, result: Result<Clusters, String>) {
        let tuning = &self.model.tuning;
        let Some(UnderWay { subset, epsilon, .. }) =
            tuning.under_way.get_untracked().filter(|it| it.number == number)
        else {
            return;
        };
        tuning.under_way.set(None);
        match result {
            Ok(clusters) => {
                let is_tried = |it: &Option<Attempt>| it.as_ref().is_some_and(|it| it.subset == subset);
                if tuning.attempt.with_untracked(is_tried) {
                    tuning.found.set(Some(Found { subset, epsilon, clusters: Arc::new(clusters) }));
                }
                self.search_attempt();
            }
            Err(reason) => {
                self.forget_attempt();
                self.say(Notice::alarm(format!("Nothing can be searched: {reason}.")));
            }
        }
    }

    /// The epsilon that is tried counts from now on.
    fn release(self) {
        let Some(attempt) = self.model.tuning.attempt.get_untracked().filter(|it| !it.released) else {
            return;
        };
        let tuning = &self.derived.tuning;
        let is_its_own = |name: &str| name == attempt.subset;
        let can_be_chosen = tuning.of.get_untracked().is_some_and(|of| is_its_own(&of.subset.name));
        let is_learned = tuning
            .subset
            .get_untracked()
            .is_some_and(|it| is_its_own(&it.name) && is_same(it.epsilon, attempt.epsilon));
        // While something is inferred, what was learned may not be what was chosen last.
        let is_chosen = is_learned && self.model.inferring.with_untracked(Option::is_none);
        if is_chosen || !can_be_chosen {
            return self.forget_attempt();
        }
        let epsilon = Some(Setting::Fixed(attempt.epsilon));
        self.model.tuning.attempt.set(Some(Attempt { released: true, ..attempt }));
        self.choose_parameters(epsilon, None);
    }

    fn choose_parameters(self, epsilon: Option<Setting<f64>>, min_points: Option<Setting<usize>>) {
        let Some(of) = self.derived.tuning.of.get_untracked() else { return };
        let mut subsets = self.derived.subsets.get_untracked();
        for subset in subsets.iter_mut().filter(|subset| subset.name == of.subset.name) {
            subset.epsilon = epsilon.unwrap_or(subset.epsilon);
            subset.min_points = min_points.unwrap_or(subset.min_points);
        }
        self.act(Action::ChooseSubsets(Some(subsets)));
        self.infer_next();
    }

    /// What is shown again is what was learned.
    pub(super) fn forget_attempt(self) {
        self.model.tuning.attempt.set(None);
        self.model.tuning.found.set(None);
    }

    /// Whether the epsilon that is shown waits for an inference with it.
    pub(super) fn is_attempt_released(self) -> bool {
        self.model.tuning.attempt.with_untracked(|it| it.as_ref().is_some_and(|it| it.released))
    }

    /// A fresh worker answers nothing that was asked of the one before.
    pub(super) fn ask_again(self) {
        let tuning = &self.model.tuning;
        tuning.under_way.set(None);
        tuning.curve.update(|curve| {
            let measured = curve.answer.as_ref().filter(|(_, result)| result.is_ok());
            curve.of = measured.map(|(of, _)| of.clone());
        });
        self.search_attempt();
    }

    /// Nothing that was asked for is answered, for this reason.
    pub(super) fn tune_no_more(self, reason: &str) {
        let tuning = &self.model.tuning;
        tuning.under_way.set(None);
        self.forget_attempt();
        let unanswered = tuning.curve.with_untracked(|curve| {
            let answered = curve.answer.as_ref().map(|(of, _)| of);
            (curve.of.as_ref() != answered).then_some(curve.number)
        });
        if let Some(number) = unanswered {
            self.curve_measured(number, Err(format!("the worker did not start: {reason}")));
        }
    }
}

/// Whether two epsilons are the same number: those that are compared come from the same place.
fn is_same(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
}
