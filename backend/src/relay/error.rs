//! Why the relay cannot do what it is asked.

use goalgraph::run::EventError;
use goalgraph::specification::ReadError;

use crate::store::StoreError;

/// Why the relay does not know what it was asked for.
#[derive(Debug, thiserror::Error)]
pub enum RelayError {
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A revision that was saved cannot be read.
    #[error("specification {specification}, revision {revision}: {source}")]
    Specification {
        /// Id of the specification.
        specification: String,
        /// Number of the revision.
        revision: u64,
        /// What is wrong with it.
        source: ReadError,
    },
    /// An event that was stored cannot be read.
    #[error("run {run}, event {number}: {source}")]
    Event {
        /// Id of the run.
        run: String,
        /// Number of the event.
        number: u64,
        /// What is wrong with it.
        source: serde_json::Error,
    },
    /// The events that were stored are not those of a run.
    #[error("run {run}: {source}")]
    Events {
        /// Id of the run.
        run: String,
        /// What is wrong with them.
        source: EventError,
    },
    /// The program ends, and the work was not begun.
    #[error("the server is shutting down")]
    Closing,
}

/// Why an executor is not told what a person wants of it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CommandError {
    /// It is not there.
    #[error("no executor {0} is connected")]
    NotConnected(String),
    /// It has accepted nothing that it could run.
    #[error("{0} has not accepted an approved specification, so there is nothing to start")]
    NotAccepted(String),
    /// It is at work.
    #[error("{executor} is in the run {run}; stop that first")]
    Busy {
        /// Name of the executor.
        executor: String,
        /// Id of the run.
        run: String,
    },
    /// It is not at work.
    #[error("{0} is in no run, so there is nothing to pause, resume or stop")]
    Idle(String),
}
