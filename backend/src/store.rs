//! The store: specifications with their revisions, approvals, runs, demonstration files and tokens, kept in a database.
//!
//! The one module that knows SQL. The same queries serve SQLite, embedded, and PostgreSQL; what differs between the two
//! is in [`connection`]. What holds for all of it:
//!
//! - A function that returns `Ok` has stored what it was given durably; one that fails has changed nothing.
//! - Revisions, journal entries and run events are only ever added. A deleted specification is hidden.
//! - The store reads no clock. Times are milliseconds since 1970 as the caller gives them, and order nothing.
//! - Of two writers that know the same state one wins, and the other gets a [`Conflict`] that tells what is there now.
//!
//! Modules in reading order: [`location`], [`error`], [`page`], [`connection`] (open, write); [`specification`],
//! [`revision`], [`approval`], [`journal`]; [`run`], [`event`]; [`file`], [`demonstration`]; [`token`], [`session`]; [`verify`],
//! [`backup`].

mod approval;
mod backup;
mod connection;
mod demonstration;
mod error;
mod event;
mod event_group;
mod file;
mod journal;
mod location;
mod page;
mod revision;
mod run;
mod session;
mod specification;
mod token;
mod verify;

use std::sync::Arc;
use std::time::Duration;

use sqlx::AnyPool;
use tokio::sync::Mutex;

pub use approval::{ApprovalKind, ApprovalRow, ApprovedRow, NewApproval, Signature};
pub use backup::BackupReport;
pub use connection::Backend;
pub use demonstration::{DemonstrationRow, LinkedDemonstration, NewDemonstration};
pub use error::{Conflict, StoreError};
pub use event::{Appended, EventRow, NewEvent};
pub use event_group::RunEvents;
pub use location::{Location, StoreOptions};
pub use page::{MAX_PAGE, Page, PageRequest};
pub use revision::{NewRevision, RevisionRow};
pub use run::{NewRun, RunChange, RunFilter, RunRow};
pub use session::SessionRow;
pub use specification::{NewSpecification, SpecificationRow};
pub use token::{NewToken, TokenRow};
pub use verify::VerifyReport;

/// A database with its demonstration files; a clone is the same store.
#[derive(Clone, Debug)]
pub struct Store {
    backend: Backend,
    pool: AnyPool,
    files: file::Files,
    /// SQLite has one writer at a time: within this program they wait here, in the order of their coming.
    turn: Arc<Mutex<()>>,
    busy_timeout: Duration,
}

impl Store {
    /// Opens the store at `location`; migrates a database of an older version.
    ///
    /// # Errors
    ///
    /// [`StoreError::NoDatabase`] when there is none and none is to be made, [`StoreError::NewerDatabase`] when a later
    /// version of this program wrote it; otherwise when the folder or the database cannot be opened.
    pub async fn open(location: &Location, options: StoreOptions) -> Result<Self, StoreError> {
        let backend = Backend::of(location)?;
        let files = file::Files::open(&location.data, options.create).await?;
        let pool = connection::open(location, &files, options).await?;
        let turn = Arc::new(Mutex::new(()));
        Ok(Self { backend, pool, files, turn, busy_timeout: options.busy_timeout })
    }

    /// Which kind of database this is.
    pub fn backend(&self) -> Backend {
        self.backend
    }

    /// Asks the database for a sign of life.
    ///
    /// # Errors
    ///
    /// When it gives none.
    pub async fn ping(&self) -> Result<(), StoreError> {
        sqlx::query("SELECT value FROM counters").fetch_one(&self.pool).await?;
        Ok(())
    }

    /// Closes every connection once what is under way has ended. Not closing loses nothing.
    pub async fn close(&self) {
        self.pool.close().await;
    }
}
