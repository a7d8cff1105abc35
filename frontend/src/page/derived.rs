//! What follows from the ground state, computed once per change, and only when somebody looks at it.

mod hits;
mod keeping;
mod marks;
mod picture;
mod residue;
mod tuning;
mod variants;
mod watched;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use goalgraph::distance::{Distance, distance};
use goalgraph::edit::EditError;
use goalgraph::history::History;
use goalgraph::infer::InferRequest;
use goalgraph::language::WordDistribution;
use goalgraph::layout::LayoutRequest;
use goalgraph::layout::drawing::layout_request;
use goalgraph::merge_candidates::{MergeCandidate, MergeTest, merge_candidates};
use goalgraph::pdfa::{Probabilities, Semantics, StateId, Symbol};
use goalgraph::plan::{NoPlan, Plan, PlanRequest, Strategy, plan};
use goalgraph::preview::{Preview, preview};
use goalgraph::specification::{Problem, Specification};
use goalgraph::subset::{SubsetRequest, propose_subsets};
use leptos::prelude::*;

use super::colors::{self, Color};
use super::model::{Basis, Model, Selection, Tab};
use super::verdict::{Verdict, verdicts};
use crate::protocol::{FileContent, FileId};

pub(crate) use keeping::{Drawing, Keeping, Sign, sha256, state_words};
pub(crate) use marks::Marks;
pub(crate) use picture::Picture;
pub(crate) use residue::Residue;
pub(crate) use tuning::Tuning;
pub(crate) use variants::{Fit, Variant, ways};
pub(crate) use watched::{StateMark, TransitionMark, Watched, Way};

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
    /// What follows from trying another epsilon.
    pub(crate) tuning: Tuning,
    /// The specification as it is now, with all edits.
    pub(crate) specification: Memo<Option<Arc<Specification>>>,
    /// What the task is called.
    pub(crate) task_name: Memo<String>,
    /// How weights are read.
    pub(crate) semantics: Memo<Semantics>,
    /// Its probabilities.
    pub(crate) probabilities: Memo<Option<Arc<Probabilities>>>,
    /// The color of every sub-goal.
    pub(crate) colors: Memo<Arc<BTreeMap<Symbol, Color>>>,
    /// Where it is drawn.
    pub(crate) picture: Memo<Option<Arc<Picture>>>,
    /// What was learned or opened last, before any edit.
    pub(crate) learned: Memo<Option<Arc<Specification>>>,
    /// Whether the worker has not placed it yet.
    pub(crate) untidy: Memo<bool>,
    /// What the edit that is thought of would do, or why it cannot be done.
    pub(crate) preview: Memo<Option<Result<Arc<Preview>, EditError>>>,
    /// What it would change in the drawing.
    pub(crate) marks: Memo<Arc<Marks>>,
    /// What is hidden from view.
    pub(crate) residue: Memo<Arc<Residue>>,
    /// What the search finds.
    pub(crate) hits: Memo<Vec<Selection>>,
    /// The order that a robot prefers when everything is available.
    pub(crate) preferred: Memo<Option<Plan>>,
    /// The plan that the drawing emphasizes: the present one while the Run tab is on display, else the preferred one.
    pub(crate) followed: Memo<Option<Plan>>,
    /// The plan with what is available, from where a walk is.
    pub(crate) plan: Memo<Option<Result<Plan, NoPlan>>>,
    /// Where the walk through the automaton is.
    pub(crate) present: Memo<Option<StateId>>,
    /// The distinct words, most frequent first, each with the demonstrations that show it.
    pub(crate) variants: Memo<Vec<Variant>>,
    /// How the demonstrations fare together.
    pub(crate) fit: Memo<Fit>,
    /// How far the words are from those that were learned.
    pub(crate) distance: Memo<Option<Distance>>,
    /// What is wrong.
    pub(crate) problems: Memo<Vec<Problem>>,
    /// Transitions on the ways of the words that are lit up.
    pub(crate) lit: Memo<BTreeSet<(StateId, Symbol)>>,
    /// States that may be one, best first.
    pub(crate) candidates: Memo<Vec<MergeCandidate>>,
    /// How the work stands with the server.
    pub(crate) keeping: Keeping,
    /// What follows from what was heard of executors and runs.
    pub(crate) watched: Watched,
}

impl Derived {
    /// The memos over `model`.
    pub(crate) fn of(model: &'static Model) -> Self {
        let verdicts = Memo::new(move |_| model.files.with(|files| verdicts(files)));
        let accepted = Memo::new(move |_| accepted(model, &verdicts.get()));
        let subsets = Memo::new(move |_| subsets(model, &accepted.get()));
        let basis = Memo::new(move |_| basis(model, &accepted.get()));
        let specification =
            Memo::new(move |_| model.history.with(|history| history.as_ref().map(History::shared)));
        let learned =
            Memo::new(move |_| model.history.with(|history| history.as_ref().map(History::learned)));
        let probabilities = Memo::new(move |_| {
            let specification = specification.get()?;
            Some(Arc::new(specification.pdfa.probabilities(specification.semantics)))
        });
        let watched = Watched::of(model, specification);
        let monitoring = watched.monitoring;
        let present =
            Memo::new(move |_| if monitoring.get() { None } else { present(model, &*specification.get()?) });
        let planned = move |from: Option<StateId>, unavailable: BTreeSet<Symbol>, strategy: Strategy| {
            let (specification, probabilities) = (specification.get()?, probabilities.get()?);
            let request =
                PlanRequest { from: from.unwrap_or(specification.pdfa.initial), unavailable, strategy };
            Some(plan(&specification.pdfa, &probabilities, &request))
        };
        let preferred = Memo::new(move |_| planned(None, BTreeSet::new(), Strategy::Greedy)?.ok());
        let plan_now =
            Memo::new(move |_| planned(present.get(), model.unavailable.get(), model.strategy.get()));
        let layout_request = Memo::new(move |_| Some(layout_request(&*specification.get()?)));
        let outdated_places = Memo::new(move |_| {
            learned.get().is_some_and(|now| {
                model.tidied.with(|it| it.of.as_ref().is_none_or(|of| !Arc::ptr_eq(of, &now)))
            })
        });
        let picture = pictures(model, layout_request, outdated_places);
        let preview = Memo::new(move |_| previewed(model, &*specification.get()?));
        let variants = Memo::new(move |_| {
            let both = specification.get().zip(probabilities.get());
            both.map(|(specification, chances)| variants::variants(&specification, &chances))
                .unwrap_or_default()
        });
        Self {
            verdicts,
            reading: Memo::new(move |_| {
                verdicts.with(|verdicts| verdicts.iter().any(|(_, verdict)| *verdict == Verdict::Reading))
            }),
            accepted,
            subsets,
            basis,
            outdated: Memo::new(move |_| outdated(model, basis.get().as_ref())),
            tuning: Tuning::of(model, specification, subsets, basis),
            specification,
            task_name: Memo::new(move |_| {
                specification.get().map_or_else(|| model.task_name.get(), |it| it.name.clone())
            }),
            semantics: Memo::new(move |_| {
                specification.get().map_or_else(|| model.semantics.get(), |it| it.semantics)
            }),
            probabilities,
            colors: Memo::new(move |_| {
                Arc::new(specification.get().map(|it| colors::colors(&it)).unwrap_or_default())
            }),
            picture,
            learned,
            untidy: outdated_places,
            preview,
            marks: Memo::new(move |_| {
                Arc::new(marks(specification, probabilities, preview).unwrap_or_default())
            }),
            residue: Memo::new(move |_| {
                let both = specification.get().zip(probabilities.get());
                let below = model.hidden_below.get();
                Arc::new(both.map(|(it, chances)| Residue::of(&it, &chances, below)).unwrap_or_default())
            }),
            hits: Memo::new(move |_| {
                let text = model.search.with(|search| search.text.clone());
                specification.get().zip(text).map(|(it, text)| hits::hits(&it, &text)).unwrap_or_default()
            }),
            preferred,
            followed: Memo::new(move |_| match model.tab.get() {
                // The plan of the robot is marked in a way of its own.
                Tab::Run if monitoring.get() => None,
                Tab::Run => plan_now.get().and_then(possible),
                _ => preferred.get(),
            }),
            plan: plan_now,
            present,
            variants,
            fit: Memo::new(move |_| variants.with(|variants| variants::fit(variants))),
            distance: Memo::new(move |_| {
                let (learned, now) = (learned.get()?, specification.get()?);
                Some(distance(&WordDistribution::of(&learned.pdfa), &WordDistribution::of(&now.pdfa)))
            }),
            problems: Memo::new(move |_| specification.get().map(|it| it.check()).unwrap_or_default()),
            lit: Memo::new(move |_| {
                let Some(specification) = specification.get() else { return BTreeSet::new() };
                model.lit.with(|lit| lit.iter().flat_map(|word| ways(&specification.pdfa, word)).collect())
            }),
            candidates: Memo::new(move |_| candidates(model, specification.get())),
            keeping: Keeping::of(model, specification),
            watched,
        }
    }
}

type PictureMemo = Memo<Option<Arc<Picture>>>;

/// The picture with what is being dragged.
fn pictures(
    model: &'static Model,
    request: Memo<Option<LayoutRequest>>,
    outdated: Memo<bool>,
) -> PictureMemo {
    let settled: PictureMemo = Memo::new(move |previous: Option<&Option<Arc<Picture>>>| {
        let (layout, tidied) = (request.get()?, model.tidied.get());
        let (held, frame) = (model.held.get(), model.frame.get());
        let request = picture::PictureRequest {
            layout: &layout,
            tidied: &tidied,
            outdated: outdated.get(),
            held: &held,
            frame,
        };
        let previous = previous.and_then(Option::as_ref);
        let next = Picture::next(previous.map(|it| &**it), &request)?;
        // What is the same stays the same object, so that nothing is drawn again.
        Some(previous.filter(|it| ***it == next).cloned().unwrap_or_else(|| Arc::new(next)))
    });
    Memo::new(move |_| {
        let settled = settled.get()?;
        let moving = model.moving.get();
        if moving.is_empty() {
            return Some(settled);
        }
        let mut held = model.held.get();
        held.extend(moving);
        Some(Arc::new(settled.with_moving(&request.get()?, &held)))
    })
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
    basis.is_some()
        && model.learned.with(|learned| learned.as_ref().is_some_and(|learned| Some(&learned.basis) != basis))
}

fn previewed(model: &Model, before: &Specification) -> Option<Result<Arc<Preview>, EditError>> {
    let edits = model.draft.with(|draft| Some(draft.as_ref()?.edits.clone()))?;
    Some(preview(before, &edits).map(Arc::new))
}

fn marks(
    specification: Memo<Option<Arc<Specification>>>,
    probabilities: Memo<Option<Arc<Probabilities>>>,
    preview: Memo<Option<Result<Arc<Preview>, EditError>>>,
) -> Option<Marks> {
    let preview = preview.get()?.ok()?;
    Some(Marks::of(&*specification.get()?, &*probabilities.get()?, &preview))
}

/// Where the walk is: as far as its steps still lead after an edit.
fn present(model: &Model, specification: &Specification) -> Option<StateId> {
    let pdfa = &specification.pdfa;
    let reached = |word: &[Symbol]| {
        let last = ways(pdfa, word).last().copied();
        last.and_then(|(state, symbol)| pdfa.transition(state, symbol)).map_or(pdfa.initial, |way| way.target)
    };
    model.simulation.with(|walk| walk.on.then(|| reached(&walk.word)))
}

/// The plan, or what can be done meanwhile.
fn possible(plan: Result<Plan, NoPlan>) -> Option<Plan> {
    match plan {
        Ok(plan) | Err(NoPlan::OutOfReach { meanwhile: plan, .. }) => Some(plan),
        Err(NoPlan::UnknownState(_)) => None,
    }
}

/// Confidence of the merge test, as in ALERGIA.
const MERGE_ALPHA: f64 = 0.05;
/// How many merges are proposed at most.
const MERGES: usize = 50;

fn candidates(model: &Model, specification: Option<Arc<Specification>>) -> Vec<MergeCandidate> {
    let Some(specification) = specification else { return Vec::new() };
    let vetoed = model.vetoed.get();
    let test = MergeTest { alpha: MERGE_ALPHA, limit: MERGES + vetoed.len() };
    let found = merge_candidates(&specification, test).into_iter();
    found.filter(|it| !vetoed.contains(&(it.kept, it.merged))).take(MERGES).collect()
}
