//! Why the store did not do what it was asked.

use std::io;
use std::path::{Path, PathBuf};

use sqlx::error::DatabaseError;
use sqlx::migrate::MigrateError;
use sqlx::postgres::PgDatabaseError;
use sqlx::sqlite::SqliteError;

use super::{ApprovalRow, RevisionRow, RunRow};

/// Why nothing was stored, or nothing could be read. Whatever fails leaves everything as it was.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// Nothing has this id, or what had it was deleted.
    #[error("there is no {what} {id}")]
    NotFound {
        /// What was looked for, such as `specification`.
        what: &'static str,
        /// The id that it was looked for by.
        id: String,
    },
    /// Somebody else was first.
    #[error(transparent)]
    Conflict(#[from] Box<Conflict>),
    /// There is no space left.
    #[error("there is no space left for the database, so nothing was stored; free some on its disk")]
    Full,
    /// Another program kept the database locked for longer than the store waits.
    #[error("the database is locked by another program, so nothing was stored; try again")]
    Busy,
    /// What was stored is not what is there: its place, and what is wrong.
    #[error("damaged: {0}")]
    Corrupt(String),
    /// A file is larger than it may be.
    #[error("the file is larger than {limit_bytes} bytes")]
    TooLarge {
        /// The largest size allowed.
        limit_bytes: u64,
    },
    /// A value that cannot be stored: which, and why.
    #[error("{0}")]
    Invalid(String),
    /// The database was written by a later version of this program.
    #[error(
        "the database is of a newer Goalgraph: it has migration {found}, this program knows up to {known}; use the newer program"
    )]
    NewerDatabase {
        /// A migration of the database that this program does not know.
        found: i64,
        /// The last migration of this program.
        known: i64,
    },
    /// There is no database where one was expected.
    #[error("{}: there is no Goalgraph database in this folder", .0.display())]
    NoDatabase(PathBuf),
    /// The database failed in another way.
    #[error("the database failed: {0}")]
    Database(#[source] sqlx::Error),
    /// A file or folder failed.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What went wrong with it.
        source: io::Error,
    },
}

/// What somebody else did meanwhile.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Conflict {
    /// A newer revision was saved: the head.
    #[error("revision {} was saved meanwhile by {}", .0.number, .0.author)]
    Saved(RevisionRow),
    /// Another revision was approved, or the approval revoked: the journal's last entry, if there is one.
    #[error("{}", approval_sentence(.0.as_ref()))]
    Approved(Option<ApprovalRow>),
    /// The content that was looked at is not that of the revision.
    #[error("revision {} has the SHA-256 {}, which is not the one that was looked at", .0.number, .0.sha256)]
    OtherContent(RevisionRow),
    /// A revision is approved: its number.
    #[error("revision {0} is approved and may be with a robot; revoke it first")]
    StillApproved(u64),
    /// A run of this id exists, of other fields.
    #[error("there is another run {} of {}", .0.id, .0.executor)]
    Run(RunRow),
}

fn approval_sentence(last: Option<&ApprovalRow>) -> String {
    match last {
        None => "no revision is approved".to_owned(),
        Some(last) => format!("revision {} was {} by {}", last.revision, last.kind, last.who),
    }
}

impl StoreError {
    /// Whether the database cannot be reached at the moment.
    pub fn is_away(&self) -> bool {
        matches!(self, Self::Database(sqlx::Error::Io(_) | sqlx::Error::PoolClosed))
    }

    /// Nothing has this id.
    pub(super) fn not_found(what: &'static str, id: impl Into<String>) -> Self {
        Self::NotFound { what, id: id.into() }
    }

    /// A file or folder failed.
    pub(super) fn io(path: &Path, source: io::Error) -> Self {
        match source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => Self::Full,
            _ => Self::Io { path: path.to_path_buf(), source },
        }
    }

    /// What a failed migration means, when `known` is the last migration of this program.
    pub(super) fn of_migration(error: MigrateError, known: i64) -> Self {
        match error {
            MigrateError::VersionMissing(found) if found > known => Self::NewerDatabase { found, known },
            MigrateError::Execute(error) | MigrateError::ExecuteMigration(error, _) => error.into(),
            other => Self::Corrupt(format!("the database's version: {other}")),
        }
    }
}

impl From<Conflict> for StoreError {
    fn from(conflict: Conflict) -> Self {
        Self::Conflict(Box::new(conflict))
    }
}

impl From<sqlx::Error> for StoreError {
    fn from(error: sqlx::Error) -> Self {
        match &error {
            sqlx::Error::PoolTimedOut => Self::Busy,
            sqlx::Error::Database(database) => {
                of_database(database.as_ref()).unwrap_or(Self::Database(error))
            }
            sqlx::Error::Decode(_) | sqlx::Error::ColumnDecode { .. } => {
                Self::Corrupt(format!("a row of the database: {error}"))
            }
            _ => Self::Database(error),
        }
    }
}

/// The error that a code of SQLite or PostgreSQL stands for, if it is one that the store tells apart.
fn of_database(error: &dyn DatabaseError) -> Option<StoreError> {
    let code = error.code()?;
    if error.try_downcast_ref::<SqliteError>().is_some() {
        // The low byte is the primary code: https://www.sqlite.org/rescode.html
        return match code.parse::<u32>().ok()? & 0xff {
            5 | 6 => Some(StoreError::Busy),
            13 => Some(StoreError::Full),
            11 | 26 => Some(StoreError::Corrupt(format!("the database file: {}", error.message()))),
            _ => None,
        };
    }
    error.try_downcast_ref::<PgDatabaseError>()?;
    // https://www.postgresql.org/docs/current/errcodes-appendix.html
    match code.as_ref() {
        "53100" => Some(StoreError::Full),
        "55P03" | "40001" | "40P01" | "53300" | "57P01" | "57P02" | "57P03" => Some(StoreError::Busy),
        "XX001" | "XX002" => Some(StoreError::Corrupt(format!("the database: {}", error.message()))),
        _ => None,
    }
}
