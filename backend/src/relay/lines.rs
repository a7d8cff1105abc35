//! Every connection there is, so that it can be ended: with the program, or with its token.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::watch;

use super::outgoing::Ending;

/// The connections that are open.
#[derive(Debug, Clone)]
pub(super) struct Lines {
    state: Arc<Mutex<State>>,
    open: Arc<watch::Sender<usize>>,
}

#[derive(Debug, Default)]
struct State {
    lines: BTreeMap<u64, Listed>,
    next: u64,
    /// What every further connection is told at once.
    ending: Option<Ending>,
}

#[derive(Debug)]
struct Listed {
    token: Option<String>,
    stop: watch::Sender<Option<Ending>>,
}

/// A connection is listed until this is dropped.
#[derive(Debug)]
pub(super) struct Listing {
    lines: Lines,
    number: u64,
}

impl Lines {
    /// None yet.
    pub(super) fn new() -> Self {
        Self { state: Arc::default(), open: Arc::new(watch::Sender::new(0)) }
    }

    /// Lists a connection that showed this token and ends when `stop` says so.
    pub(super) fn list(&self, token: Option<String>, stop: watch::Sender<Option<Ending>>) -> Listing {
        let mut state = self.state();
        if let Some(ending) = state.ending {
            stop.send_replace(Some(ending));
        }
        state.next += 1;
        let number = state.next;
        state.lines.insert(number, Listed { token, stop });
        self.open.send_replace(state.lines.len());
        Listing { lines: self.clone(), number }
    }

    /// Ends every connection, also those to come.
    pub(super) fn end_all(&self, ending: Ending) {
        let mut state = self.state();
        state.ending = Some(ending);
        end(state.lines.values(), ending);
    }

    /// Ends the connections that showed this token.
    pub(super) fn end_of_token(&self, token: &str, ending: Ending) {
        let state = self.state();
        end(state.lines.values().filter(|listed| listed.token.as_deref() == Some(token)), ending);
    }

    /// Waits until no connection is open.
    pub(super) async fn all_ended(&self) {
        // The sender lives as long as `self`.
        let _ = self.open.subscribe().wait_for(|open| *open == 0).await;
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn end<'a>(lines: impl Iterator<Item = &'a Listed>, ending: Ending) {
    for listed in lines {
        listed.stop.send_replace(Some(ending));
    }
}

impl Drop for Listing {
    fn drop(&mut self) {
        let mut state = self.lines.state();
        state.lines.remove(&self.number);
        self.lines.open.send_replace(state.lines.len());
    }
}
