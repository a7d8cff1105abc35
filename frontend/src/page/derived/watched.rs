//! What follows from what was heard of executors and runs.

mod fold;
mod marks;

use std::sync::Arc;

use goalgraph::pdfa::Probabilities;
use goalgraph::protocol::monitor::RunView;
use goalgraph::specification::Specification;
use leptos::prelude::*;

use super::keeping::sha256;
use crate::page::model::{EventKind, Model, RunMode, SeenExecutor, Tab};
use crate::page::run_text;

pub(crate) use fold::Replanned;
pub(crate) use marks::{RunMarks, StateMark, TransitionMark, Way};

/// A specification with its probabilities.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Followed {
    /// The specification.
    pub(crate) specification: Arc<Specification>,
    /// Its probabilities.
    pub(crate) probabilities: Arc<Probabilities>,
}

/// All memos of watching.
pub(crate) struct Watched {
    /// What the Run tab is for at present.
    pub(crate) mode: Memo<RunMode>,
    /// Whether runs are on display: then nothing is edited.
    pub(crate) monitoring: Memo<bool>,
    /// SHA-256 of the specification on display, hexadecimal.
    pub(crate) viewed_sha256: Memo<Option<String>>,
    /// The run that is looked at, as it is now.
    pub(crate) run: Memo<Option<RunView>>,
    /// What it follows, once that is known.
    pub(crate) followed: Memo<Option<Followed>>,
    /// The run as it is shown: now, or at the moment of the replay.
    pub(crate) shown: Memo<Option<RunView>>,
    /// The last new plan up to that moment.
    pub(crate) replanned: Memo<Option<Replanned>>,
    /// Whether the specification on display is the one that the run follows.
    pub(crate) agrees: Memo<bool>,
    /// The run in the drawing.
    pub(crate) marks: Memo<Option<Arc<RunMarks>>>,
    /// Positions of the events that the filter lets through.
    pub(crate) listed: Memo<Vec<usize>>,
    /// The executor that commands go to.
    pub(crate) executor: Memo<Option<SeenExecutor>>,
}

impl Watched {
    /// The memos over `model`, beside the specification on display.
    pub(super) fn of(model: &'static Model, viewed: Memo<Option<Arc<Specification>>>) -> Self {
        let watching = &model.watching;
        let mode = Memo::new(move |_| watching.mode.get().unwrap_or_default());
        let monitoring = Memo::new(move |_| model.tab.get() == Tab::Run && mode.get() == RunMode::Monitor);
        let viewed_sha256 = Memo::new(move |_| viewed.get().map(|it| sha256(&it.to_json())));
        let run = Memo::new(move |_| run(model));
        let sha256 = Memo::new(move |_| run.with(|run| run.as_ref().map(|run| run.sha256.clone())));
        let agrees = Memo::new(move |_| sha256.with(Option::is_some) && sha256.get() == viewed_sha256.get());
        let followed = Memo::new(move |_| {
            let known = || {
                let sha256 = sha256.get()?;
                watching.followed.with(|followed| followed.get(&sha256).cloned().flatten())
            };
            let specification = if agrees.get() { viewed.get() } else { known() }?;
            let probabilities = Arc::new(specification.pdfa.probabilities(specification.semantics));
            Some(Followed { specification, probabilities })
        });
        let shown = Memo::new(move |_| shown(model, run.get()?, followed.get()));
        let replanned = Memo::new(move |_| {
            let (followed, shown) = (followed.get()?, shown.get()?);
            let is_of = |log: &crate::page::model::EventLog| log.run == shown.run;
            watching.log.with(|log| {
                is_of(log).then(|| fold::replanned(&followed.specification.pdfa, log.up_to(shown.events)))?
            })
        });
        let marks = Memo::new(move |_| {
            if !monitoring.get() || !agrees.get() {
                return None;
            }
            let followed = followed.get()?;
            let shown = shown.get()?;
            let label = run_text::doing(Some(&followed.specification), &shown);
            replanned.with(|replanned| {
                let marks = RunMarks::of(&followed.specification.pdfa, &shown, replanned.as_ref(), label);
                Some(Arc::new(marks))
            })
        });
        Self {
            mode,
            monitoring,
            viewed_sha256,
            run,
            followed,
            shown,
            replanned,
            agrees,
            marks,
            listed: Memo::new(move |_| listed(model, followed)),
            executor: Memo::new(move |_| executor(model, run)),
        }
    }
}

/// The run that somebody chose, or the newest.
fn run(model: &Model) -> Option<RunView> {
    let chosen = model.watching.chosen.get();
    model.watching.heard.with(|heard| {
        let chosen = chosen.and_then(|id| heard.run(&id));
        chosen.or(heard.newest()).cloned()
    })
}

fn shown(model: &Model, run: RunView, followed: Option<Followed>) -> Option<RunView> {
    let replay = model.watching.replay.get();
    let Some((replay, followed)) = replay.zip(followed) else { return Some(run) };
    model.watching.log.with(|log| {
        if log.run != run.run {
            return Some(run);
        }
        let events = log.up_to(replay.at);
        Some(fold::replayed(run, &followed.specification.pdfa, &followed.probabilities, events))
    })
}

fn listed(model: &Model, followed: Memo<Option<Followed>>) -> Vec<usize> {
    let filter = model.watching.filter.get();
    let text = filter.text.trim().to_lowercase();
    let followed = followed.get();
    let specification = followed.as_ref().map(|it| &*it.specification);
    model.watching.log.with(|log| {
        let events = log.events.iter().enumerate();
        let of_kind =
            events.filter(|(_, event)| filter.kind.is_none_or(|kind| EventKind::of(&event.happened) == kind));
        let with_text = of_kind.filter(|(_, event)| {
            text.is_empty()
                || run_text::happened(specification, &event.happened).to_lowercase().contains(&text)
        });
        with_text.map(|(index, _)| index).collect()
    })
}

/// The one that somebody chose, or that of the run, or the only one.
fn executor(model: &Model, run: Memo<Option<RunView>>) -> Option<SeenExecutor> {
    let chosen = model.watching.executor.get();
    let of_run = run.with(|run| run.as_ref().map(|run| run.executor.clone()));
    model.watching.heard.with(|heard| {
        let named = |name: Option<String>| heard.executors.get(&name?);
        let only = || heard.executors.values().next().filter(|_| heard.executors.len() == 1);
        named(chosen).or_else(|| named(of_run)).or_else(only).cloned()
    })
}
