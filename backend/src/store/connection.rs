//! Connections and transactions: what differs between SQLite and PostgreSQL.

use std::fs::File;
use std::path::Path;
use std::str::FromStr;

use sqlx::any::{AnyConnectOptions, AnyPoolOptions};
use sqlx::migrate::Migrator;
use sqlx::{Any, AnyConnection, AnyPool, AssertSqlSafe, ConnectOptions, Connection, Executor, Transaction};
use tokio::sync::OwnedMutexGuard;
use tokio::time::timeout;

use super::file::Files;
use super::{Location, Store, StoreError, StoreOptions};

static MIGRATIONS: Migrator = sqlx::migrate!();

/// For how many of those that a locked database keeps for the whole of its timeout one that comes after them waits.
const TURNS: u32 = 6;

/// A kind of database.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Backend {
    /// A file in the data folder.
    Sqlite,
    /// A server elsewhere.
    Postgres,
}

impl Backend {
    /// The kind of database at `location`.
    ///
    /// # Errors
    ///
    /// [`StoreError::Invalid`] when the URL is none of PostgreSQL; the message does not repeat it.
    pub(super) fn of(location: &Location) -> Result<Self, StoreError> {
        let Some(url) = &location.database else { return Ok(Self::Sqlite) };
        if url.starts_with("postgres://") || url.starts_with("postgresql://") {
            return Ok(Self::Postgres);
        }
        Err(StoreError::Invalid("the database's URL must begin with postgres://".to_owned()))
    }

    fn max_connections(self) -> u32 {
        match self {
            Self::Sqlite => 8,
            Self::Postgres => 16,
        }
    }

    /// What every new connection is told first.
    fn greeting(self, options: StoreOptions) -> String {
        let milliseconds = options.busy_timeout.as_millis();
        match self {
            Self::Sqlite => {
                let limit =
                    options.max_pages.map_or(String::new(), |it| format!("PRAGMA max_page_count = {it};"));
                format!(
                    "PRAGMA busy_timeout = {milliseconds}; PRAGMA journal_mode = WAL; \
                     PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON; {limit}"
                )
            }
            // 0 would be no limit at all.
            Self::Postgres => format!("SET lock_timeout = {}", milliseconds.max(1)),
        }
    }

    fn begin_writing(self) -> &'static str {
        match self {
            // A transaction that begins with reading could not become a writing one while another writes.
            Self::Sqlite => "BEGIN IMMEDIATE",
            Self::Postgres => "BEGIN",
        }
    }

    fn begin_snapshot(self) -> &'static str {
        match self {
            Self::Sqlite => "BEGIN",
            Self::Postgres => "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY",
        }
    }
}

/// Connects to the database at `location` and brings it to this program's version.
pub(super) async fn open(
    location: &Location,
    files: &Files,
    options: StoreOptions,
) -> Result<AnyPool, StoreError> {
    sqlx::any::install_default_drivers();
    let backend = Backend::of(location)?;
    let database = address(location, files, options)?;
    let greeting = backend.greeting(options);
    migrate(&database, &greeting, files).await?;
    let pool = AnyPoolOptions::new()
        .max_connections(backend.max_connections())
        .acquire_timeout(options.busy_timeout.max(std::time::Duration::from_secs(1)))
        .after_connect(move |connection, _| {
            let greeting = greeting.clone();
            Box::pin(async move { greet(connection, greeting).await })
        })
        // SQLite itself rolls a transaction back when the disk is full, and the driver then takes it for unfinished:
        // such a connection is closed, not used again.
        .before_acquire(|connection, _| {
            let is_free = !connection.is_in_transaction();
            Box::pin(async move { Ok(is_free) })
        })
        .connect_lazy_with(database);
    Ok(pool)
}

/// What to connect to.
fn address(
    location: &Location,
    files: &Files,
    options: StoreOptions,
) -> Result<AnyConnectOptions, StoreError> {
    if let Some(url) = &location.database {
        return AnyConnectOptions::from_str(url).map_err(|_| unreadable_url());
    }
    let file = files.database();
    if !options.create && !file.is_file() {
        return Err(StoreError::NoDatabase(location.data.clone()));
    }
    Ok(AnyConnectOptions::from_str(&sqlite_url(&file)?)?)
}

fn unreadable_url() -> StoreError {
    let message = "the database's URL cannot be read; expected postgres://user:password@host/name";
    StoreError::Invalid(message.to_owned())
}

async fn greet(connection: &mut AnyConnection, greeting: String) -> sqlx::Result<()> {
    connection.execute(AssertSqlSafe(greeting)).await.map(|_| ())
}

/// The file's URL; the driver wants one, whatever characters the path is made of.
fn sqlite_url(file: &Path) -> Result<String, StoreError> {
    let path = file.to_str().ok_or_else(|| {
        StoreError::Invalid(format!("{}: the data folder's path must be UTF-8", file.display()))
    })?;
    let encode = |byte: u8| {
        let is_plain = byte.is_ascii_alphanumeric() || b"/-_.~".contains(&byte);
        if is_plain { char::from(byte).to_string() } else { format!("%{byte:02X}") }
    };
    let encoded: String = path.bytes().map(encode).collect();
    Ok(format!("sqlite://{encoded}?mode=rwc"))
}

/// Brings the database to this program's version, on a connection of its own: closing it lets go of every lock.
async fn migrate(database: &AnyConnectOptions, greeting: &str, files: &Files) -> Result<(), StoreError> {
    let lock = files.migration_lock();
    // Locked until it is dropped, so that of two programs that open a new folder one migrates.
    let _lock: File = tokio::task::spawn_blocking(lock).await.map_err(|error| {
        StoreError::Invalid(format!("the data folder could not be locked for migration: {error}"))
    })??;
    let mut connection = database.connect().await.map_err(|error| match error {
        // The message may repeat any part of the URL.
        sqlx::Error::Configuration(_) => unreadable_url(),
        other => other.into(),
    })?;
    greet(&mut connection, greeting.to_owned()).await?;
    let known = MIGRATIONS.iter().map(|it| it.version).max().unwrap_or(0);
    let migrated = MIGRATIONS.run_direct(None, &mut connection, false).await;
    let closed = connection.close().await;
    migrated.map_err(|error| StoreError::of_migration(error, known))?;
    Ok(closed?)
}

/// A transaction that writes; dropped before [`Writing::commit`] it changes nothing.
pub(super) struct Writing {
    transaction: Transaction<'static, Any>,
    /// Given up after the transaction has ended: fields are dropped in their order.
    _turn: Option<OwnedMutexGuard<()>>,
}

impl Writing {
    /// What the transaction's statements run on.
    pub(super) fn connection(&mut self) -> &mut AnyConnection {
        &mut self.transaction
    }

    /// The next number of the order in which things were written: on one database no two transactions get the same,
    /// and the one that commits first gets the smaller.
    pub(super) async fn next_sequence(&mut self) -> Result<i64, StoreError> {
        let next = "UPDATE counters SET value = value + 1 WHERE name = 'sequence' RETURNING value";
        Ok(sqlx::query_scalar(next).fetch_one(self.connection()).await?)
    }

    /// Makes it durable.
    pub(super) async fn commit(self) -> Result<(), StoreError> {
        Ok(self.transaction.commit().await?)
    }
}

impl Store {
    /// Begins a transaction that writes, once it is its turn.
    pub(super) async fn write(&self) -> Result<Writing, StoreError> {
        let turn = match self.backend {
            Backend::Sqlite => Some(self.wait_for_turn().await?),
            Backend::Postgres => None,
        };
        let transaction = self.pool.begin_with(self.backend.begin_writing()).await?;
        Ok(Writing { transaction, _turn: turn })
    }

    /// Waits longer than for another program's lock: those who wait here do get on.
    async fn wait_for_turn(&self) -> Result<OwnedMutexGuard<()>, StoreError> {
        let patience = self.busy_timeout.saturating_mul(TURNS);
        timeout(patience, self.turn.clone().lock_owned()).await.map_err(|_| StoreError::Busy)
    }

    /// Begins a transaction whose reads all see the same state.
    pub(super) async fn snapshot(&self) -> Result<Transaction<'static, Any>, StoreError> {
        Ok(self.pool.begin_with(self.backend.begin_snapshot()).await?)
    }
}
