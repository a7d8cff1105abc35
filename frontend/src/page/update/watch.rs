//! Watching executors and runs.

mod fetch;
mod replay;

use goalgraph::edit::Edit;
use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::ToMonitor;
use leptos::prelude::*;
use wasm_bindgen_futures::spawn_local;

use super::App;
use crate::page::model::{Connection, EventFilter, Notice, RunMode, Tab};
use crate::page::{run_text, server};

/// What can be asked of the watching part.
#[derive(Clone, Debug)]
pub(crate) enum WatchAction {
    /// Show the Run tab as this.
    Mode(RunMode),
    /// Take what the server said at a time in milliseconds since 1970.
    Heard(Box<ToMonitor>, f64),
    /// The line broke off at a time in milliseconds since 1970.
    Lost(f64),
    /// Look at a run; none for the newest.
    Choose(Option<String>),
    /// Look at the next older run, or by a negative number at a newer one.
    StepRun(isize),
    /// Let commands go to this executor.
    ChooseExecutor(String),
    /// Tell an executor what to do.
    Order(String, Command),
    /// Look at the run as it was after the event with this number; none for now.
    Replay(Option<u64>),
    /// Let the replay go on by itself, or stay.
    Play(bool),
    /// Go so many events on in the replay.
    StepReplay(i64),
    /// Replay so many events a second.
    Pace(u32),
    /// List these events.
    Filter(EventFilter),
    /// List runs from before.
    FetchOlder,
    /// Fetch what is missing of the events of a run.
    FetchEvents(String),
    /// Fetch what runs follow.
    FetchRevision {
        /// Id of the specification.
        specification: String,
        /// Number of the revision.
        number: u64,
        /// SHA-256 of the revision.
        sha256: String,
    },
    /// Begin the edit that adds what the run completed as a word.
    Promote,
}

impl App {
    /// Does what a gesture means.
    pub(super) fn watch(self, action: WatchAction) {
        let watching = &self.model.watching;
        match action {
            WatchAction::Mode(mode) => watching.mode.set(Some(mode)),
            WatchAction::Heard(message, now_ms) => {
                watching.connection.set(Connection::Live);
                watching.heard.update(|heard| heard.take(*message, now_ms));
            }
            WatchAction::Lost(now_ms) => {
                watching.connection.update(|connection| *connection = connection.broken(now_ms));
            }
            WatchAction::Choose(run) => self.choose_run(run),
            WatchAction::StepRun(step) => self.step_run(step),
            WatchAction::ChooseExecutor(name) => watching.executor.set(Some(name)),
            WatchAction::Order(executor, command) => self.order(executor, command),
            WatchAction::Replay(at) => self.replay(at),
            WatchAction::Play(on) => self.play(on),
            WatchAction::StepReplay(step) => self.step_replay(step),
            WatchAction::Pace(pace) => watching.pace.set(pace),
            WatchAction::Filter(filter) => watching.filter.set(filter),
            WatchAction::FetchOlder => self.fetch_older(),
            WatchAction::FetchEvents(run) => self.fetch_events(run),
            WatchAction::FetchRevision { specification, number, sha256 } => {
                self.fetch_revision(specification, number, sha256);
            }
            WatchAction::Promote => self.promote(),
        }
    }

    /// Shows the Run tab for what is going on, until somebody chooses.
    pub(super) fn settle_mode(self, tab: Tab) {
        let watching = &self.model.watching;
        if tab == Tab::Run && watching.mode.get_untracked().is_none() {
            let busy = watching.heard.with_untracked(crate::page::model::Heard::is_busy);
            watching.mode.set(Some(if busy { RunMode::Monitor } else { RunMode::Simulate }));
        }
    }

    fn order(self, executor: String, command: Command) {
        let watching = &self.model.watching;
        watching.executor.set(Some(executor.clone()));
        if command == Command::Start {
            // The run that begins is the one to look at.
            self.choose_run(None);
        }
        spawn_local(async move {
            let what = run_text::command(command);
            self.say(match server::order(&executor, command).await {
                Ok(()) => Notice::calm(format!("{what}: told to {executor}.")),
                Err(reason) => Notice::alarm(format!("{what} was not told to {executor}: {reason}.")),
            });
        });
    }

    /// The consequence is shown before anything is done.
    fn promote(self) {
        let watched = &self.derived.watched;
        let Some(run) = watched.run.get_untracked() else { return };
        if let Some(reason) = self.promotion_refusal() {
            return self.say(Notice::alarm(format!("Not done: {reason}.")));
        }
        let followed = watched.followed.get_untracked();
        let names = run_text::names(followed.as_ref().map(|it| &*it.specification), &run.trail);
        let label = format!("Promote run {} of {}: {names}", run_text::short_id(&run.run), run.executor);
        let edit = Edit::AddWord { word: run.trail, first_new: self.next_state() };
        self.model.tab.set(Tab::Automaton);
        self.think_of(Some(label), vec![edit], true);
    }

    /// Why the run that is looked at cannot be made a demonstration; none when it can.
    pub(crate) fn promotion_refusal(self) -> Option<String> {
        let watched = &self.derived.watched;
        let Some(run) = watched.run.get() else { return Some("there is no run".to_owned()) };
        let (Some(viewed), Some(followed)) = (self.derived.specification.get(), watched.followed.get())
        else {
            return Some(format!("open r{} of {} first", run.revision, run.name));
        };
        if run.departure.is_none() {
            return Some("the run has not left the automaton".to_owned());
        }
        if !run.phase.is_over() {
            return Some("the run is not over".to_owned());
        }
        // Ids are never reused, but another specification has ids of its own.
        let same = |symbol: &goalgraph::pdfa::Symbol| {
            let (there, here) = (followed.specification.sub_goal(*symbol), viewed.sub_goal(*symbol));
            there.zip(here).is_some_and(|(there, here)| {
                there.ball == here.ball && (here.ball.is_some() || there.name == here.name)
            })
        };
        let strange = run.trail.iter().find(|symbol| !same(symbol));
        strange.map(|symbol| {
            let name = followed.specification.name_of(*symbol);
            format!(
                "{name} is not in the specification on display: open r{} of {} first",
                run.revision, run.name
            )
        })
    }
}
