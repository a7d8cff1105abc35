//! What is shown of a run is fetched as the run goes on: its events, and the specification that it follows.

use leptos::prelude::*;

use crate::page::model::Connection;
use crate::page::update::{Action, App, WatchAction};

/// Fetches from now on what is missing of what is shown.
pub(super) fn start(app: App) {
    let watched = &app.derived.watched;
    let behind = Memo::new(move |_| {
        let (run, number) = watched.run.with(|run| run.as_ref().map(|run| (run.run.clone(), run.events)))?;
        let live = app.model.watching.connection.get() == Connection::Live;
        watched.monitoring.get().then_some((run, number, live))
    });
    Effect::new(move |_| {
        let Some((run, number, _)) = behind.get() else { return };
        // What was refused is asked for again when there is more, or the server is back.
        let done = app
            .model
            .watching
            .log
            .with_untracked(|log| log.run == run && (log.fetching || log.events.len() as u64 >= number));
        if !done {
            app.act(Action::Watch(WatchAction::FetchEvents(run)));
        }
    });
    let unknown = Memo::new(move |_| {
        let run = watched.run.with(|run| {
            run.as_ref().map(|run| (run.specification.clone(), run.revision, run.sha256.clone()))
        });
        let known = |sha256: &String| app.model.watching.followed.with(|it| it.contains_key(sha256));
        run.filter(|(_, _, sha256)| watched.monitoring.get() && !watched.agrees.get() && !known(sha256))
    });
    Effect::new(move |_| {
        if let Some((specification, number, sha256)) = unknown.get() {
            app.act(Action::Watch(WatchAction::FetchRevision { specification, number, sha256 }));
        }
    });
    Effect::new(move |before: Option<Option<TimeoutHandle>>| {
        if let Some(handle) = before.flatten() {
            handle.clear();
        }
        let playing = app.model.watching.replay.get().is_some_and(|replay| replay.playing);
        let delay = std::time::Duration::from_millis(1000 / u64::from(app.model.watching.pace.get().max(1)));
        let step = move || app.act(Action::Watch(WatchAction::StepReplay(1)));
        playing.then(|| set_timeout_with_handle(step, delay).ok()).flatten()
    });
}
