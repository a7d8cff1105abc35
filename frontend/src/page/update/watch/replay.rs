//! Which run is looked at, and which moment of it.

use leptos::prelude::*;

use crate::page::model::Replay;
use crate::page::update::App;

impl App {
    /// Looks at a run as it is now; none for the newest.
    pub(super) fn choose_run(self, run: Option<String>) {
        self.model.watching.replay.set(None);
        self.model.watching.chosen.set(run);
    }

    /// Looks at the next older run, or a newer one; at the ends nothing happens.
    pub(super) fn step_run(self, step: isize) {
        let shown = self.derived.watched.run.with_untracked(|run| run.as_ref().map(|run| run.run.clone()));
        let next = self.model.watching.heard.with_untracked(|heard| {
            let at = heard.runs.iter().position(|run| Some(&run.run) == shown.as_ref())?;
            heard.runs.get(at.checked_add_signed(step)?).map(|run| run.run.clone())
        });
        if next.is_some() {
            self.choose_run(next);
        }
    }

    /// Looks at the run as it was after the event `at`; none for as it is now. What the run does meanwhile does not move
    /// the look.
    pub(super) fn replay(self, at: Option<u64>) {
        let Some(run) = self.derived.watched.run.get_untracked() else { return };
        self.model.watching.chosen.set(Some(run.run));
        // The last event of a run that goes on is now.
        let at = at.filter(|at| run.phase.is_over() || *at < run.events);
        let playing = self.model.watching.replay.get_untracked().is_some_and(|replay| replay.playing);
        let replay = at.map(|at| Replay { at: at.min(run.events), playing: playing && at < run.events });
        self.model.watching.replay.set(replay);
    }

    /// Lets the replay go on by itself, from the first event when it is at the last; or lets it stay.
    pub(super) fn play(self, on: bool) {
        let Some(run) = self.derived.watched.run.get_untracked() else { return };
        let at = self.model.watching.replay.get_untracked().map_or(run.events, |replay| replay.at);
        let at = if on && at >= run.events { 0 } else { at };
        self.model.watching.chosen.set(Some(run.run));
        self.model.watching.replay.set(Some(Replay { at, playing: on }));
    }

    /// Goes so many events on, or back by a negative number.
    pub(super) fn step_replay(self, step: i64) {
        let Some(run) = self.derived.watched.run.get_untracked() else { return };
        let at = self.model.watching.replay.get_untracked().map_or(run.events, |replay| replay.at);
        self.replay(Some(at.saturating_add_signed(step).min(run.events)));
    }
}
