//! The Run tab: trying the automaton, or watching robots follow it.

mod executors;
mod headline;
mod holding;
mod log;
mod log_row;
mod modes;
mod planning;
mod replay;
mod runs;
mod verdict;
mod watch;

use leptos::prelude::*;

use crate::page::model::RunMode;
use crate::page::update::App;

/// What the Run tab is for at present.
pub(crate) fn run(app: App) -> impl IntoView {
    move || match app.derived.watched.mode.get() {
        RunMode::Simulate => planning::planning(app).into_any(),
        RunMode::Monitor => watch::watch(app).into_any(),
    }
}
