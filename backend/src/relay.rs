//! The relay: takes the approved revision to executors, keeps what they report, and shows it to whoever watches.
//!
//! Reading order: [`limits`], [`lease`], [`relayed_run`], [`archive`] (runs made of what the store has), [`offer`] (what
//! is approved, to all who follow it); [`hub`] with [`runs`] and [`inbox`] (the present state, behind one lock);
//! [`writer`], [`begin`], [`events`] (the one task that writes); [`upgrade`], [`greeting`], [`connection`],
//! [`incoming`], [`monitoring`] (one task for each connection), [`outgoing`], [`lines`] (how they end).
//!
//! What holds for all of it:
//!
//! - Nothing is acknowledged before the store has it durably, and nothing that was is lost.
//! - A connection that is not read holds back nobody: it gets the newest, and is dropped if it does not take that.
//! - What a connection can make grow is bounded by [`RelayLimits`]. Where the store is slow, reading waits.
//! - Leases go by a clock that never goes back. The wall clock is for people.

mod archive;
mod begin;
mod connection;
mod counts;
mod error;
mod events;
mod greeting;
mod hub;
mod inbox;
mod incoming;
mod lease;
mod limits;
mod lines;
mod monitoring;
mod offer;
mod opening;
mod outgoing;
mod refusal;
mod relayed_run;
mod runs;
mod upgrade;
mod upkeep;
mod writer;

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::{Answer, ExecutorView, RunView};
use tokio::sync::{Semaphore, mpsc, oneshot};
use tokio::time::{Instant, timeout};

use crate::store::{Page, PageRequest, RunFilter, Store};
use counts::Counters;
use hub::Hub;
use lines::Lines;
use offer::Offers;
use outgoing::Ending;
use writer::Job;

pub use counts::RelayCounts;
pub use error::{CommandError, RelayError};
pub use limits::RelayLimits;
pub use upgrade::{SocketCaller, executor_socket, monitor_socket};

/// The relay of a server; a clone is the same relay.
#[derive(Debug, Clone)]
pub struct Relay {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    store: Store,
    limits: RelayLimits,
    /// When it was opened.
    since: Instant,
    hub: Mutex<Hub>,
    offers: Offers,
    lines: Lines,
    counts: Counters,
    jobs: mpsc::Sender<Job>,
    /// Bytes that may wait for the store.
    rooms: Arc<Semaphore>,
    executor_slots: Arc<Semaphore>,
    monitor_slots: Arc<Semaphore>,
}

impl Inner {
    fn hub(&self) -> MutexGuard<'_, Hub> {
        self.hub.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Relay {
    /// Tells everybody who follows a specification what is approved now; to be called after the store has it.
    ///
    /// When the store cannot be read, it is tried again until it can.
    pub async fn approval_changed(&self, specification: &str) {
        self.inner.refresh(specification).await;
    }

    /// The executors that are connected or are in a run that is not over, by name.
    pub fn executors(&self) -> Vec<ExecutorView> {
        let hub = self.inner.hub();
        hub.executors.keys().map(|name| hub.executor_view(name)).collect()
    }

    /// A run as it is now.
    ///
    /// # Errors
    ///
    /// [`crate::store::StoreError::NotFound`] when there is no such run; when the store cannot be read.
    pub async fn run(&self, id: &str) -> Result<RunView, RelayError> {
        if let Some(view) = self.inner.known_view(id) {
            return Ok(view);
        }
        archive::view(&self.inner.store, self.inner.store.run(id).await?).await
    }

    /// Runs as they are now, newest first.
    ///
    /// # Errors
    ///
    /// As [`Store::runs`]. A run that cannot be read is left out.
    pub async fn runs(&self, filter: &RunFilter, page: &PageRequest) -> Result<Page<RunView>, RelayError> {
        let Page { rows, next } = self.inner.store.runs(filter, page).await?;
        let mut views = Vec::with_capacity(rows.len());
        for row in rows {
            let id = row.id.clone();
            let view = match self.inner.known_view(&id) {
                Some(view) => Ok(view),
                None => archive::view(&self.inner.store, row).await,
            };
            match view {
                Ok(view) => views.push(view),
                Err(error) => tracing::warn!(run = id, %error, "a run cannot be read"),
            }
        }
        Ok(Page { rows: views, next })
    }

    /// Tells an executor what a person wants of it. Of commands that it has not read yet, the last counts.
    ///
    /// # Errors
    ///
    /// When it is not connected, or the command makes no sense for it.
    pub fn command(&self, executor: &str, command: Command) -> Result<(), CommandError> {
        let hub = self.inner.hub();
        let known = hub.executors.get(executor);
        let (Some(known), Some(link)) = (known, known.and_then(|known| known.link.as_ref())) else {
            return Err(CommandError::NotConnected(executor.to_owned()));
        };
        let has_accepted = known.holds.as_ref().is_some_and(|held| held.answer == Answer::Accepted);
        let at_work = known.run.as_ref().filter(|run| hub.is_held_by(run, link.number));
        match (command, at_work) {
            (Command::Start, Some(run)) => {
                return Err(CommandError::Busy { executor: executor.to_owned(), run: run.clone() });
            }
            (Command::Start, None) if !has_accepted => {
                return Err(CommandError::NotAccepted(executor.to_owned()));
            }
            (Command::Pause | Command::Resume | Command::Stop, None) if known.run.is_none() => {
                return Err(CommandError::Idle(executor.to_owned()));
            }
            _ => {}
        }
        link.commands.send_replace(Some(command));
        Ok(())
    }

    /// Ends every connection that showed this token, because it was revoked.
    pub fn disconnect_token(&self, token_id: &str) {
        self.inner.lines.end_of_token(token_id, Ending::revoked());
    }

    /// What there is to measure.
    pub fn counts(&self) -> RelayCounts {
        let hub = self.inner.hub();
        RelayCounts {
            executors: hub.executors.values().filter(|executor| executor.link.is_some()).count(),
            monitors: hub.monitors.len(),
            events_stored: self.inner.counts.events_stored(),
            messages_refused: self.inner.counts.messages_refused(),
        }
    }

    /// Ends every connection with the close code 1001 once what it sent is stored and acknowledged, and takes no more.
    pub async fn shutdown(&self) {
        let inner = &self.inner;
        inner.executor_slots.close();
        inner.monitor_slots.close();
        inner.lines.end_all(Ending::closing());
        // A connection that does not read is not waited for any longer than its messages are.
        let _ = timeout(inner.limits.send * 2, inner.lines.all_ended()).await;
        let (done, flushed) = oneshot::channel();
        if inner.jobs.send(Job::Flush(done)).await.is_ok() {
            let _ = flushed.await;
        }
    }
}

impl Inner {
    fn known_view(&self, id: &str) -> Option<RunView> {
        self.hub().runs.get(id).map(relayed_run::RelayedRun::view)
    }
}
