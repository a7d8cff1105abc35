//! What follows from the ground state, computed once per change.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use goalgraph::infer::InferRequest;
use goalgraph::pdfa::{Probabilities, Symbol, Word};
use goalgraph::plan::{NoPlan, Plan, PlanRequest, Strategy, plan};
use goalgraph::specification::Specification;
use goalgraph::subset::{SubsetRequest, propose_subsets};
use leptos::prelude::*;

use super::colors::{self, Color};
use super::model::{Basis, Model, Tab};
use super::verdict::{Verdict, verdicts};
use crate::protocol::{FileContent, FileId, Placement};

/// All memos.
pub(crate) struct Derived {
    /// The verdict on every file, in the order in which they came.
    pub(crate) verdicts: Memo<Vec<(FileId, Verdict)>>,
    /// Whether a file is being read.
    pub(crate) reading: Memo<bool>,
    /// The accepted files, in byte order of their names.
    pub(crate) accepted: Memo<Vec<(FileId, Arc<FileContent>)>>,
    /// The feature subsets, chosen or proposed.
    pub(crate) subsets: Memo<Vec<SubsetRequest>>,
    /// What an inference would start from; none without accepted files.
    pub(crate) basis: Memo<Option<Basis>>,
    /// Whether what is shown was learned from something else than what is there now.
    pub(crate) outdated: Memo<bool>,
    /// What was learned, under the present name and reading of weights.
    pub(crate) specification: Memo<Option<Arc<Specification>>>,
    /// What of it is drawn: everything but the name.
    pub(crate) drawn: Memo<Option<Specification>>,
    /// Its probabilities.
    pub(crate) probabilities: Memo<Option<Arc<Probabilities>>>,
    /// The color of every sub-goal.
    pub(crate) colors: Memo<Arc<BTreeMap<Symbol, Color>>>,
    /// Where the automaton is drawn: in the direction that fills the frame better.
    pub(crate) placement: Memo<Option<Arc<Placement>>>,
    /// The order that a robot prefers when everything is available.
    pub(crate) preferred: Memo<Option<Plan>>,
    /// The plan that the drawing emphasizes: the present one while the Run tab is on display, else the preferred one.
    pub(crate) followed: Memo<Option<Plan>>,
    /// The plan with what is available.
    pub(crate) plan: Memo<Option<Result<Plan, NoPlan>>>,
    /// The distinct words, most frequent first, each with the demonstrations that show it.
    pub(crate) variants: Memo<Vec<Variant>>,
}

/// A distinct word.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variant {
    /// The word.
    pub(crate) word: Word,
    /// The names of its demonstrations.
    pub(crate) demonstrations: Vec<String>,
}

impl Derived {
    /// The memos over `model`.
    pub(crate) fn of(model: &'static Model) -> Self {
        let verdicts = Memo::new(move |_| model.files.with(|files| verdicts(files)));
        let accepted = Memo::new(move |_| accepted(model, &verdicts.get()));
        let subsets = Memo::new(move |_| subsets(model, &accepted.get()));
        let basis = Memo::new(move |_| basis(model, &accepted.get()));
        let specification = Memo::new(move |_| specification(model));
        let probabilities = Memo::new(move |_| {
            let specification = specification.get()?;
            Some(Arc::new(specification.pdfa.probabilities(specification.semantics)))
        });
        let planned = move |unavailable: BTreeSet<Symbol>, strategy: Strategy| {
            let (specification, probabilities) = (specification.get()?, probabilities.get()?);
            let request = PlanRequest { from: specification.pdfa.initial, unavailable, strategy };
            Some(plan(&specification.pdfa, &probabilities, &request))
        };
        let preferred = Memo::new(move |_| planned(BTreeSet::new(), Strategy::Greedy)?.ok());
        let present = Memo::new(move |_| planned(model.unavailable.get(), model.strategy.get()));
        Self {
            verdicts,
            reading: Memo::new(move |_| {
                verdicts.with(|verdicts| verdicts.iter().any(|(_, verdict)| *verdict == Verdict::Reading))
            }),
            accepted,
            subsets,
            basis,
            outdated: Memo::new(move |_| outdated(model, basis.get().as_ref())),
            specification,
            drawn: Memo::new(move |_| {
                let specification = specification.get()?;
                Some(Specification { name: String::new(), ..(*specification).clone() })
            }),
            probabilities,
            colors: Memo::new(move |_| {
                Arc::new(
                    specification
                        .get()
                        .map(|specification| colors::colors(&specification))
                        .unwrap_or_default(),
                )
            }),
            placement: Memo::new(move |_| model.placements.with(|them| best_fit(them, model.frame.get()))),
            preferred,
            followed: Memo::new(move |_| match model.tab.get() {
                Tab::Run => present.get().and_then(possible),
                _ => preferred.get(),
            }),
            plan: present,
            variants: Memo::new(move |_| {
                specification.get().map(|specification| variants(&specification)).unwrap_or_default()
            }),
        }
    }
}

fn accepted(model: &Model, verdicts: &[(FileId, Verdict)]) -> Vec<(FileId, Arc<FileContent>)> {
    let mut accepted: Vec<_> = model.files.with(|files| {
        let named = files.iter().zip(verdicts).map(|(file, (id, verdict))| (file.name.clone(), *id, verdict));
        named
            .filter_map(|(name, id, verdict)| match verdict {
                Verdict::Accepted(content) => Some((name, id, Arc::clone(content))),
                _ => None,
            })
            .collect()
    });
    accepted.sort_by(|a: &(String, FileId, _), b| (&a.0, a.1).cmp(&(&b.0, b.1)));
    accepted.into_iter().map(|(_, id, content)| (id, content)).collect()
}

fn subsets(model: &Model, accepted: &[(FileId, Arc<FileContent>)]) -> Vec<SubsetRequest> {
    let proposed =
        || accepted.first().map(|(_, content)| propose_subsets(&content.features)).unwrap_or_default();
    model.settings.with(|settings| settings.subsets.clone()).unwrap_or_else(proposed)
}

/// The name and the reading of weights are not part of it: they need no new inference.
fn basis(model: &Model, accepted: &[(FileId, Arc<FileContent>)]) -> Option<Basis> {
    let settings = model.settings.get();
    let files: Vec<FileId> = accepted.iter().map(|(id, _)| *id).collect();
    let subsets = settings.subsets.unwrap_or_default();
    let request =
        InferRequest { subsets, method: settings.method, radius: settings.radius, ..InferRequest::default() };
    (!files.is_empty()).then_some(Basis { files, request })
}

fn outdated(model: &Model, basis: Option<&Basis>) -> bool {
    model.learned.with(|learned| learned.as_ref().is_some_and(|learned| Some(&learned.basis) != basis))
}

fn specification(model: &Model) -> Option<Arc<Specification>> {
    let learned = model.learned.with(|learned| Some(Arc::clone(&learned.as_ref()?.outcome)))?;
    let mut specification = Specification::from_json(&learned.specification).ok()?;
    specification.name = model.task_name.get();
    specification.semantics = model.semantics.get();
    Some(Arc::new(specification))
}

/// The plan, or what can be done meanwhile.
fn possible(plan: Result<Plan, NoPlan>) -> Option<Plan> {
    match plan {
        Ok(plan) | Err(NoPlan::OutOfReach { meanwhile: plan, .. }) => Some(plan),
        Err(NoPlan::UnknownState(_)) => None,
    }
}

/// The placement that is largest when all of it is shown in a frame of this width and height.
fn best_fit(placements: &[Arc<Placement>], (width, height): (f64, f64)) -> Option<Arc<Placement>> {
    let scale =
        |placement: &Placement| (width / placement.width.max(1.0)).min(height / placement.height.max(1.0));
    let larger = |best: Arc<Placement>, other: &Arc<Placement>| {
        if scale(other) > scale(&best) { Arc::clone(other) } else { best }
    };
    let (first, others) = placements.split_first()?;
    Some(others.iter().fold(Arc::clone(first), larger))
}

fn variants(specification: &Specification) -> Vec<Variant> {
    let mut by_word: BTreeMap<&Word, Vec<String>> = BTreeMap::new();
    for demonstration in &specification.demonstrations {
        by_word.entry(&demonstration.word).or_default().push(demonstration.name.clone());
    }
    let variant = |(word, demonstrations): (&Word, _)| Variant { word: word.clone(), demonstrations };
    let mut variants: Vec<Variant> = by_word.into_iter().map(variant).collect();
    variants.sort_by_key(|variant| std::cmp::Reverse(variant.demonstrations.len()));
    variants
}
