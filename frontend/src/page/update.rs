//! Whatever changes the ground state: actions from gestures, answers from the worker.

mod files;
mod save;
mod worker;

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use goalgraph::export::ExportFormat;
use goalgraph::infer::{Method, RadiusRule};
use goalgraph::pdfa::{Semantics, Symbol};
use goalgraph::plan::Strategy;
use goalgraph::subset::SubsetRequest;
use leptos::prelude::*;
use web_sys::File;

use super::derived::Derived;
use super::model::{Model, Notice, Overlay, Sample, Selection, Tab};
use super::samples;
use super::theme::Theme;
use super::worker_link::WorkerLink;
use crate::protocol::{DemonstrationId, FileId, ToWorker};

/// What a gesture means.
#[derive(Clone, Debug)]
pub(crate) enum Action {
    /// Take these files.
    Open(Vec<(String, File)>),
    /// Let go of a file.
    Remove(FileId),
    /// Read a file whose reading was canceled.
    ReadAgain(FileId),
    /// Load a sample that comes with the app.
    LoadSample(Sample),
    /// Let go of everything.
    Clear,
    /// Infer from what is there.
    Infer,
    /// Stop what the worker does.
    Cancel,
    /// Name the task.
    Name(String),
    /// Search other subsets; none for the engine's proposal.
    ChooseSubsets(Option<Vec<SubsetRequest>>),
    /// Take an eliminated cluster for a sub-goal all the same.
    Restore {
        /// Name of its subset.
        subset: String,
        /// Its center.
        center: Vec<f64>,
    },
    /// Cluster other frames.
    ChooseMethod(Method),
    /// Size balls in another way.
    ChooseRadius(RadiusRule),
    /// Read weights in another way.
    ChooseSemantics(Semantics),
    /// Choose plans in another way.
    ChooseStrategy(Strategy),
    /// Show a demonstration.
    Show(DemonstrationId),
    /// Show a subset.
    ShowSubset(usize),
    /// Show a tab.
    GoTo(Tab),
    /// Select in the automaton.
    Select(Option<Selection>),
    /// Show the automaton as a table or as a graph.
    ToggleTable,
    /// Say that a sub-goal is available, or not.
    SetAvailable(Symbol, bool),
    /// Lay something over the page, or take it away.
    Overlay(Option<Overlay>),
    /// Change between light and dark.
    ToggleTheme,
    /// Save the specification.
    Export(ExportFormat),
    /// Say a sentence.
    Say(Notice),
}

/// The app: its state and its line to the worker. A handle.
#[derive(Clone, Copy)]
pub(crate) struct App {
    /// Ground state.
    pub(crate) model: &'static Model,
    /// What follows from it.
    pub(crate) derived: &'static Derived,
    outside: StoredValue<Rc<Outside>, LocalStorage>,
}

/// What is no plain data: the browser's handles.
#[derive(Default)]
struct Outside {
    link: OnceCell<WorkerLink>,
    files: RefCell<BTreeMap<FileId, File>>,
    next_file: Cell<u32>,
}

impl Notice {
    /// A sentence about something that went well.
    pub(crate) fn calm(text: impl Into<String>) -> Self {
        Self { text: text.into(), alarming: false }
    }

    /// A sentence about something that went wrong.
    pub(crate) fn alarm(text: impl Into<String>) -> Self {
        Self { text: text.into(), alarming: true }
    }
}

impl App {
    /// An empty app. It lives as long as the page, so its state is never given back.
    pub(crate) fn new() -> Self {
        let model: &'static Model = Box::leak(Box::new(Model::new()));
        let derived = Box::leak(Box::new(Derived::of(model)));
        Self { model, derived, outside: StoredValue::new_local(Rc::default()) }
    }

    /// Starts what lives outside the state: worker, theme, list of samples.
    pub(crate) fn start(self) {
        let link = WorkerLink::start(move |report| self.hear(report));
        let _ = self.outside.get_value().link.set(link);
        self.model.theme.get_untracked().apply();
        samples::list(self);
        Effect::new(move |_| {
            if let Some(specification) = self.derived.drawn.get() {
                self.post(&ToWorker::LayOut { specification: specification.to_json() }, None);
            }
        });
    }

    /// Does what a gesture means.
    pub(crate) fn act(self, action: Action) {
        let model = self.model;
        match action {
            Action::Open(files) => self.open(files),
            Action::Remove(id) => self.remove(id),
            Action::ReadAgain(id) => self.read(id),
            Action::LoadSample(sample) => samples::load(self, sample),
            Action::Clear => self.clear(),
            Action::Infer => self.infer(),
            Action::Cancel => self.cancel(),
            Action::Name(name) => model.task_name.set(name),
            Action::ChooseSubsets(subsets) => model.settings.update(|settings| settings.subsets = subsets),
            Action::Restore { subset, center } => self.restore(&subset, center),
            Action::ChooseMethod(method) => model.settings.update(|settings| settings.method = method),
            Action::ChooseRadius(radius) => model.settings.update(|settings| settings.radius = radius),
            Action::ChooseSemantics(semantics) => model.semantics.set(semantics),
            Action::ChooseStrategy(strategy) => model.strategy.set(strategy),
            Action::Show(demonstration) => self.show(demonstration),
            Action::ShowSubset(index) => model.subset.set(index),
            Action::GoTo(tab) => model.tab.set(tab),
            Action::Select(selection) => model.selection.set(selection),
            Action::ToggleTable => model.as_table.update(|as_table| *as_table = !*as_table),
            Action::SetAvailable(symbol, available) => model.unavailable.update(|unavailable| {
                if available {
                    unavailable.remove(&symbol)
                } else {
                    unavailable.insert(symbol)
                };
            }),
            Action::Overlay(overlay) => model.overlay.set(overlay),
            Action::ToggleTheme => self.set_theme(model.theme.get_untracked().toggled()),
            Action::Export(format) => self.export(format),
            Action::Say(notice) => model.notice.set(notice),
        }
    }

    fn restore(self, subset: &str, center: Vec<f64>) {
        let mut subsets = self.derived.subsets.get_untracked();
        if let Some(request) = subsets.iter_mut().find(|request| request.name == subset) {
            request.restored.push(center);
        }
        self.act(Action::ChooseSubsets(Some(subsets)));
        self.act(Action::Infer);
    }

    fn set_theme(self, theme: Theme) {
        self.model.theme.set(theme);
        theme.apply();
    }

    fn say(self, notice: Notice) {
        self.model.notice.set(notice);
    }

    fn post(self, request: &ToWorker, file: Option<&File>) {
        if let Some(link) = self.outside.get_value().link.get() {
            link.post(request, file);
        }
    }
}
