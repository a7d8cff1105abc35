//! What the relay reads of the store, and how it makes runs of it.

use std::sync::Arc;

use goalgraph::protocol::monitor::{RunOrigin, RunView};
use goalgraph::run::RunEvent;
use goalgraph::specification::Specification;

use super::RelayError;
use super::relayed_run::{Automaton, RelayedRun, rfc3339};
use crate::store::{EventRow, RunRow, Store};

/// How many events are read at a time.
const EVENTS_AT_A_TIME: u32 = 500;

/// A revision of a specification, and what runs of it are followed through.
///
/// # Errors
///
/// When it cannot be read.
pub(super) async fn revision(
    store: &Store,
    specification: &str,
    revision: u64,
) -> Result<(String, Arc<Automaton>), RelayError> {
    let content = store.kept_content(specification, revision).await?;
    // A large specification takes long enough to parse to keep other connections waiting.
    let parsing = tokio::task::spawn_blocking(move || {
        let parsed = Specification::from_json(&content).map(Automaton::of);
        (content, parsed)
    });
    let (content, parsed) = parsing.await.map_err(|_| RelayError::Closing)?;
    match parsed {
        Ok(automaton) => Ok((content, Arc::new(automaton))),
        Err(source) => {
            Err(RelayError::Specification { specification: specification.to_owned(), revision, source })
        }
    }
}

/// A run with all its events, followed through `automaton`.
///
/// # Errors
///
/// When its events cannot be read.
pub(super) async fn follow(
    store: &Store,
    row: RunRow,
    automaton: Arc<Automaton>,
) -> Result<RelayedRun, RelayError> {
    let mut followed = begin(row, automaton);
    loop {
        let rows = store.events(&followed.origin.run, followed.run.events, EVENTS_AT_A_TIME).await?;
        let is_last = rows.len() < EVENTS_AT_A_TIME as usize;
        for row in &rows {
            apply(&mut followed, row)?;
        }
        if is_last {
            return Ok(followed);
        }
    }
}

/// A run before its first event.
pub(super) fn begin(row: RunRow, automaton: Arc<Automaton>) -> RelayedRun {
    let closed = !row.is_open();
    let origin = RunOrigin {
        run: row.id,
        executor: row.executor,
        specification: row.specification,
        name: automaton.name.clone(),
        revision: row.revision,
        sha256: row.sha256,
        began_at: rfc3339(row.began_at_ms),
    };
    let run = automaton.run();
    let heard_at_ms = row.began_at_ms;
    RelayedRun { origin, sequence: row.sequence, automaton, run, heard_at_ms, lease: None, closed }
}

fn apply(followed: &mut RelayedRun, row: &EventRow) -> Result<(), RelayError> {
    let run = || followed.origin.run.clone();
    let event: RunEvent = serde_json::from_str(&row.event).map_err(|source| RelayError::Event {
        run: run(),
        number: row.number,
        source,
    })?;
    followed
        .apply(row.number, &event, row.received_at_ms)
        .map_err(|source| RelayError::Events { run: followed.origin.run.clone(), source })
}

/// The view of a run: as it was kept when the run ended, else made of its events.
///
/// # Errors
///
/// When the run's specification or its events cannot be read.
pub(super) async fn view(store: &Store, row: RunRow) -> Result<RunView, RelayError> {
    let kept = row.summary.as_deref().filter(|_| !row.is_open());
    if let Some(view) = kept.and_then(|text| serde_json::from_str(text).ok()) {
        return Ok(view);
    }
    let (_, automaton) = revision(store, &row.specification, row.revision).await?;
    Ok(follow(store, row, automaton).await?.view())
}
