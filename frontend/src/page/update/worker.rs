//! What the worker is asked to do, and what it answers.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use goalgraph::infer::Progress;
use goalgraph::layout::Layout;
use goalgraph::specification::Specification;
use leptos::prelude::*;

use super::App;
use crate::page::model::{Basis, Inferring, Learned, Notice, Reading, Tab, Tidied};
use crate::page::text::count;
use crate::page::update::{Action, KeepAction};
use crate::page::verdict::Verdict;
use crate::page::view::graph;
use crate::page::worker_link::Report;
use crate::protocol::{FromWorker, Outcome, ReadFile, ToWorker};

impl App {
    /// Infers from what is there now; what is being inferred is of no use any more.
    pub(super) fn infer(self) {
        let Some(basis) = self.derived.basis.get_untracked() else {
            return self.say(Notice::alarm("There are no demonstrations to infer from. Open some first."));
        };
        if self.model.inferring.with_untracked(Option::is_some) {
            self.restart_worker();
        }
        self.begin(basis);
    }

    /// Infers with other parameters. What is being inferred goes on to its end, for the subsets are looked at only once.
    pub(super) fn infer_next(self) {
        let inferring = self.model.inferring;
        match self.derived.basis.get_untracked() {
            Some(basis) if inferring.with_untracked(Option::is_some) => inferring.update(|inferring| {
                if let Some(inferring) = inferring {
                    inferring.superseded = true;
                    inferring.basis = basis;
                }
            }),
            _ => self.infer(),
        }
    }

    fn begin(self, basis: Basis) {
        let Basis { files, request } = basis.clone();
        let progress = Progress { stage: "Starting".to_owned(), done: 0, total: 1 };
        self.model.canceled.set(None);
        self.model.inferring.set(Some(Inferring { basis, progress, superseded: false }));
        self.post(&ToWorker::Infer { files, request }, None);
    }

    /// Stops the worker in the middle of whatever it does. What was read stays; what was not is marked.
    pub(super) fn cancel(self) {
        if self.model.inferring.with_untracked(Option::is_none) && !self.derived.reading.get_untracked() {
            return;
        }
        self.say(Notice::calm("Canceled. Nothing was lost."));
        self.restart_worker();
        self.infer_no_more();
        if self.is_placing() {
            self.tidy();
        }
    }

    /// A fresh worker knows nothing: it is given the files again that were accepted.
    pub(super) fn restart_worker(self) {
        self.model.inferring.set(None);
        let outside = self.outside.get_value();
        if let Some(link) = outside.link.get() {
            link.restart();
        }
        self.mark_unread();
        self.give_accepted();
        self.ask_again();
    }

    /// What the worker was to read, and did not.
    fn mark_unread(self) {
        let verdicts = self.derived.verdicts.get_untracked().into_iter();
        let unread = verdicts.filter(|(_, verdict)| *verdict == Verdict::Reading);
        self.set_readings(unread.map(|(id, _)| (id, Reading::Canceled)).collect());
    }

    /// Gives the worker the files that were accepted.
    pub(super) fn give_accepted(self) {
        let verdicts = self.derived.verdicts.get_untracked().into_iter();
        let accepted = verdicts.filter(|(_, verdict)| matches!(verdict, Verdict::Accepted(_)));
        self.post_files(&accepted.map(|(id, _)| id).collect::<Vec<_>>());
    }

    /// What is there now is not inferred from until somebody asks for it.
    fn infer_no_more(self) {
        self.model.canceled.set(self.derived.basis.get_untracked());
        if self.is_attempt_released() {
            self.forget_attempt();
        }
    }

    pub(super) fn hear(self, report: Report) {
        match report {
            Report::Answer(answer) => self.take(answer),
            Report::Broken(reason) => self.replace_broken(&reason),
            Report::Unstarted(reason) => self.do_without(&reason),
        }
    }

    fn replace_broken(self, reason: &str) {
        // The first file that was not read is the one that the worker broke down over.
        let unread = self.derived.verdicts.get_untracked().into_iter();
        let culprit = unread.filter(|(_, verdict)| *verdict == Verdict::Reading).map(|(id, _)| id).next();
        self.restart_worker();
        self.infer_no_more();
        if culprit.is_none() {
            // It would break down again.
            self.place_no_more();
        }
        let reason = format!("the worker broke down ({reason}); the file may be too large for this browser");
        match culprit {
            Some(id) => self.set_readings(BTreeMap::from([(id, Reading::Refused(reason))])),
            None => self.say(Notice::alarm(format!("Not done: {reason}."))),
        }
    }

    /// There is no worker: nothing that was asked for is done.
    fn do_without(self, reason: &str) {
        self.model.inferring.set(None);
        self.mark_unread();
        self.place_no_more();
        self.tune_no_more(reason);
        self.say(Notice::alarm(format!(
            "Nothing can be read or inferred: the worker did not start ({reason}). Nothing is lost, and it is tried again \
             with the next thing that you do."
        )));
    }

    fn place_no_more(self) {
        if self.is_placing() {
            self.model.tidied.update(|tidied| {
                tidied.answered = tidied.asked;
                tidied.layouts = Vec::new();
            });
        }
    }

    fn take(self, answer: FromWorker) {
        let model = self.model;
        match answer {
            FromWorker::Ready => {}
            FromWorker::Rehearsal(said) => self.rehearse(said),
            FromWorker::Read(files) => {
                let reading = |ReadFile { file, result }| {
                    let read = |content| Reading::Read(Arc::new(content));
                    (file, result.map_or_else(Reading::Refused, read))
                };
                self.set_readings(files.into_iter().map(reading).collect());
                self.settle();
            }
            FromWorker::Progress(progress) => model.inferring.update(|inferring| {
                if let Some(inferring) = inferring {
                    inferring.progress = progress;
                }
            }),
            FromWorker::Inferred { result, layouts } => self.learned(result, layouts),
            FromWorker::KDistances { number, result } => self.curve_measured(number, result),
            FromWorker::Previewed { number, result } => self.searched(number, result),
            FromWorker::Track { demonstration, track } => {
                model.track.set(Some((demonstration, Arc::new(track))));
            }
            FromWorker::LaidOut { number, result } => self.laid_out(number, result),
            FromWorker::Opened { file, result } => self.opened(file, result),
            FromWorker::Placed { number, layout } => {
                self.act(Action::Keep(KeepAction::Placed(number, layout.map(Arc::new))));
            }
            FromWorker::Svg(Ok(text)) => drop(self.save("svg", "image/svg+xml", &text)),
            FromWorker::Svg(Err(reason)) => {
                self.say(Notice::alarm(format!("The automaton cannot be drawn: {reason}")));
            }
        }
    }

    /// Whether a placement was asked for and not answered yet.
    fn is_placing(self) -> bool {
        self.model.tidied.with_untracked(|tidied| tidied.asked != tidied.answered)
    }

    /// Takes the placement that was asked for last; an earlier one is of something else.
    fn laid_out(self, number: u32, result: Result<Vec<Layout>, String>) {
        if self.model.tidied.with_untracked(|tidied| tidied.asked != number) {
            return;
        }
        match result {
            Ok(layouts) => {
                self.model.tidied.update(|tidied| {
                    tidied.answered = number;
                    tidied.layouts = layouts.into_iter().map(Arc::new).collect();
                });
                graph::fit(self);
            }
            Err(reason) => {
                self.model.tidied.update(|tidied| tidied.answered = number);
                self.say(Notice::alarm(format!("The automaton cannot be drawn: {reason}")));
            }
        }
    }

    fn learned(self, result: Result<Box<Outcome>, String>, layouts: Vec<Layout>) {
        let Some(inferring) = self.model.inferring.get_untracked() else { return };
        self.model.inferring.set(None);
        if inferring.superseded {
            return self.infer();
        }
        if self.is_attempt_released() {
            self.forget_attempt();
        }
        match result {
            Err(reason) => self.say(Notice::alarm(format!("Nothing was inferred: {reason}"))),
            Ok(outcome) => {
                let first = self.model.learned.with_untracked(Option::is_none);
                let edited = self.is_edited();
                self.model.selection.set(Vec::new());
                self.model.unavailable.update(BTreeSet::clear);
                self.model.simulation.update(|walk| walk.on = false);
                match Specification::from_json(&outcome.specification) {
                    Ok(specification) => self.take_learned(specification, layouts),
                    Err(reason) => {
                        return self.say(Notice::alarm(format!("The result cannot be read: {reason}.")));
                    }
                }
                self.model.learned.set(Some(Learned { basis: inferring.basis, outcome: Arc::from(outcome) }));
                self.announce(first, edited);
            }
        }
    }

    /// Puts what was learned in the place of what is there, as a step that can be undone.
    fn take_learned(self, mut specification: Specification, layouts: Vec<Layout>) {
        let semantics = self.derived.semantics.get_untracked();
        // Probabilities are written at the transitions: read in another way they need another room.
        let placed = semantics == specification.semantics;
        specification.name = self.derived.task_name.get_untracked();
        specification.semantics = semantics;
        let label = format!("Learn from {}", count(specification.demonstrations.len(), "demonstration"));
        self.replace(label, specification);
        if placed {
            let number = self.model.tidied.with_untracked(|tidied| tidied.asked + 1);
            let of = self.derived.learned.get_untracked();
            self.model.tidied.update(|tidied| *tidied = Tidied { of, asked: number, ..tidied.clone() });
            self.laid_out(number, Ok(layouts));
        }
    }

    /// Whether what was learned or opened last was changed since.
    fn is_edited(self) -> bool {
        self.derived.specification.get_untracked() != self.derived.learned.get_untracked()
    }

    /// Says what was learned, and that edits are not lost. The first automaton is shown at once, unless a verdict has to be read before.
    fn announce(self, first: bool, edited: bool) {
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        let found = format!(
            "{} and {} from {}.",
            count(specification.sub_goals.len(), "sub-goal"),
            count(specification.pdfa.states.len(), "state"),
            count(specification.demonstrations.len(), "demonstration"),
        );
        let back = if edited { " Your edits are one step back: Ctrl+Z." } else { "" };
        self.say(Notice::calm(found + back));
        let verdicts = self.derived.verdicts.get_untracked();
        let all_accepted = verdicts.iter().all(|(_, verdict)| matches!(verdict, Verdict::Accepted(_)));
        if first && all_accepted && !specification.sub_goals.is_empty() {
            self.model.tab.set(Tab::Automaton);
        }
    }
}
