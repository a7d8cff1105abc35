//! Whatever changes the ground state: actions from gestures, answers from the worker.

mod action;
mod edit;
mod files;
mod keeping;
mod open;
mod rehearsal;
mod save;
mod select;
mod simulation;
mod tuning;
mod watch;
mod worker;

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use goalgraph::edit::{Edit, MAX_NAME};
use goalgraph::history::{History, Mark};
use goalgraph::pdfa::Semantics;
use leptos::prelude::*;
use web_sys::File;

use super::autosave;
use super::derived::Derived;
use super::model::{Model, Notice, Search, Tidied};
use super::monitor;
use super::samples;
use super::theme::Theme;
use super::view;
use super::worker_link::WorkerLink;
use crate::protocol::{FileId, ToWorker};

pub(crate) use action::Action;
pub(crate) use keeping::{Choice, KeepAction};
pub(crate) use select::Flow;
pub(crate) use tuning::Tune;
pub(crate) use watch::WatchAction;

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
    link: OnceCell<Rc<WorkerLink>>,
    files: RefCell<BTreeMap<FileId, File>>,
    let_go: RefCell<Option<autosave::LetGo>>,
    next_file: Cell<u32>,
    loads: Cell<u32>,
    has_rehearsed: Cell<bool>,
    /// Whether files come that belong to what is there: nothing is to be learned from them unasked.
    brought: Cell<bool>,
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
        autosave::start(self);
        self.start_keeping();
        monitor::start(self);
        self.follow_curve();
        // Something else was learned or opened.
        Effect::new(move |_| {
            let waiting = self.model.tidied.with(|tidied| tidied.asked != tidied.answered);
            if !waiting && self.derived.untidy.get() {
                self.tidy();
            }
        });
    }

    /// Does what a gesture means.
    pub(crate) fn act(self, action: Action) {
        let model = self.model;
        if action.is_edit() && self.derived.watched.monitoring.get_untracked() {
            return self.say(Notice::alarm("Runs are only watched here: edit on the Automaton tab."));
        }
        match action {
            Action::Open(files) => self.open(files),
            Action::Remove(id) => self.remove(id),
            Action::ReadAgain(id) => self.read(&[id]),
            Action::LoadSample(sample) => samples::load(self, sample),
            Action::Clear => self.clear(),
            Action::BringBack => self.bring_back(),
            Action::Infer => self.infer(),
            Action::Cancel => self.cancel(),
            Action::Name(name) => self.name(name),
            Action::ChooseSubsets(subsets) => model.settings.update(|settings| settings.subsets = subsets),
            Action::Restore { subset, center } => self.restore(&subset, center),
            Action::ChooseMethod(method) => model.settings.update(|settings| settings.method = method),
            Action::ChooseRadius(radius) => model.settings.update(|settings| settings.radius = radius),
            Action::ChooseSemantics(semantics) => self.choose_semantics(semantics),
            Action::ChooseStrategy(strategy) => model.strategy.set(strategy),
            Action::Show(demonstration) => self.show(demonstration),
            Action::ShowNamed(index, frame) => self.show_named(index, frame),
            Action::ShowSubset(index) => model.subset.set(index),
            Action::Tune(tune) => self.tune(tune),
            Action::GoTo(tab) => {
                self.settle_mode(tab);
                model.tab.set(tab);
            }
            Action::Select(selection) => self.select(selection),
            Action::ToggleSelected(item) => self.toggle_selected(item),
            Action::SelectAll(items) => model.selection.set(items),
            Action::SelectFlow(flow) => self.select_flow(flow),
            Action::Consider(edits) => self.think_of(None, edits, false),
            Action::ConsiderNoMore => self.think_no_more(),
            Action::Begin(edits) => self.think_of(None, edits, true),
            Action::Apply => self.apply_draft(),
            Action::CancelDraft => model.draft.set(None),
            Action::Edit(label, edits) => self.edit(label, edits),
            Action::Undo => self.travel(History::undo),
            Action::Redo => self.travel(History::redo),
            Action::MarkApproved => self.mark(Mark::Approved),
            Action::Jump(position) => self.travel(|history| {
                history.jump(position);
                true
            }),
            Action::Veto(first, second) => model.vetoed.update(|vetoed| {
                vetoed.insert((first, second));
            }),
            Action::Lock(state, outcome, lock) => model.locked.update(|locked| {
                if lock {
                    locked.insert((state, outcome))
                } else {
                    locked.remove(&(state, outcome))
                };
            }),
            Action::Move(places) => model.moving.set(places),
            Action::Drop => self.hold_moving(),
            Action::Unpin(states) => model.held.update(|held| held.retain(|id, _| !states.contains(id))),
            Action::Tidy => self.tidy(),
            Action::Light(word) => model.lit.update(|lit| {
                if !lit.remove(&word) {
                    lit.insert(word);
                }
            }),
            Action::HideBelow(share) => model.hidden_below.set(share),
            Action::ShowSide(side) => model.side.set(side),
            Action::ShowText(pane) => model.text_pane.set(pane),
            Action::Search(text) => model.search.set(Search { text, at: 0 }),
            Action::NextHit(step) => self.next_hit(step),
            Action::Menu(menu) => model.menu.set(menu),
            Action::Abort => {
                model.gesture.set(None);
                model.moving.set(BTreeMap::new());
            }
            Action::Walk(on) => self.walk(on),
            Action::Step(symbol) => self.step(symbol),
            Action::StepBack(steps) => self.step_back(steps),
            Action::Seed(seed) => model.simulation.update(|walk| walk.seed = seed),
            Action::ToggleTable => model.as_table.update(|as_table| *as_table = !*as_table),
            Action::SetAvailable(symbol, available) => model.unavailable.update(|unavailable| {
                if available {
                    unavailable.remove(&symbol)
                } else {
                    unavailable.insert(symbol)
                };
            }),
            Action::Keep(action) => self.keep(action),
            Action::Overlay(overlay) => model.overlay.set(overlay),
            Action::ToggleTheme => self.set_theme(model.theme.get_untracked().toggled()),
            Action::Export(format) => self.export(format),
            Action::Watch(action) => self.watch(action),
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

    /// Before there is a specification the name waits for it; afterwards naming is an edit.
    fn name(self, name: String) {
        let there = self.derived.specification.get_untracked();
        match there {
            Some(specification) if specification.name != name => {
                self.edit(None, vec![Edit::RenameTask { name }]);
            }
            Some(_) => {}
            None => self.model.task_name.set(name.chars().take(MAX_NAME).collect()),
        }
    }

    fn choose_semantics(self, semantics: Semantics) {
        self.model.semantics.set(semantics);
        let there = self.derived.specification.get_untracked();
        if there.is_some_and(|specification| specification.semantics != semantics) {
            self.edit(None, vec![Edit::SetSemantics { semantics }]);
        }
    }

    /// Has everything placed anew; what is held stays.
    fn tidy(self) {
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        let of = self.derived.learned.get_untracked();
        let number = self.model.tidied.with_untracked(|tidied| tidied.asked + 1);
        self.model.tidied.update(|tidied| *tidied = Tidied { of, asked: number, ..tidied.clone() });
        self.post(&ToWorker::LayOut { specification: specification.to_json(), number }, None);
    }

    /// The drag is over: what was moved is held from now on.
    fn hold_moving(self) {
        let moving = self.model.moving.get_untracked();
        self.model.held.update(|held| held.extend(moving));
        self.model.moving.set(BTreeMap::new());
    }

    fn next_hit(self, step: isize) {
        let hits = self.derived.hits.get_untracked();
        if hits.is_empty() {
            return;
        }
        let shown = hits.get(self.model.search.with_untracked(|search| search.at)).copied();
        let is_shown = self.model.selection.with_untracked(|selection| selection.last().copied() == shown);
        // The first hit is gone to before the second.
        let step = if is_shown || step < 0 { step } else { 0 };
        self.model.search.update(|search| {
            let next = (search.at.cast_signed() + step).rem_euclid(hits.len().cast_signed());
            search.at = next.cast_unsigned();
        });
        let hit = hits[self.model.search.with_untracked(|search| search.at) % hits.len()];
        self.select(Some(hit));
        view::viewport::show(self, &[hit]);
    }

    fn set_theme(self, theme: Theme) {
        self.model.theme.set(theme);
        theme.apply();
    }

    /// A number for a sample that is about to be loaded: of several only the last is wanted.
    pub(crate) fn next_load(self) -> u32 {
        let outside = self.outside.get_value();
        outside.loads.set(outside.loads.get() + 1);
        outside.loads.get()
    }

    /// Whether no other sample was asked for since.
    pub(crate) fn is_last_load(self, load: u32) -> bool {
        self.outside.get_value().loads.get() == load
    }

    /// The recordings that are loaded, as the browser has them, by name.
    pub(crate) fn loaded_files(self) -> Vec<(String, File)> {
        let outside = self.outside.get_value();
        let handles = outside.files.borrow();
        let loaded = self.model.files.get_untracked();
        loaded.into_iter().filter_map(|file| Some((file.name, handles.get(&file.id)?.clone()))).collect()
    }

    fn say(self, notice: Notice) {
        self.model.notice.set(notice);
    }

    /// Asks the worker for something, with the files that it is about. Where none could be started, one is tried again
    /// and given what the one before had read.
    fn post<'a>(self, request: &ToWorker, files: impl IntoIterator<Item = &'a File>) {
        let outside = self.outside.get_value();
        let Some(link) = outside.link.get() else { return };
        if link.is_down() {
            link.restart();
            if !link.is_down() {
                self.give_accepted();
                self.ask_again();
            }
        }
        link.post(request, files);
    }
}
