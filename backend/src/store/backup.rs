//! A copy of everything at one moment, made while others write.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use futures_util::TryStreamExt;
use sqlx::any::{AnyArguments, AnyRow, AnyTypeInfoKind};
use sqlx::query::Query;
use sqlx::{Any, AssertSqlSafe, Row, Transaction, TypeInfo, ValueRef};

use super::connection::Writing;
use super::file::sync_folder;
use super::{Location, Store, StoreError, StoreOptions};

/// A table's name and its columns.
type Table = (&'static str, &'static [&'static str]);

/// Every table; one that another refers to stands before it.
const TABLES: [Table; 10] = [
    ("counters", &["name", "value"]),
    ("specifications", &["id", "head", "approved", "saved_sequence", "created_at_ms", "deleted"]),
    (
        "revisions",
        &[
            "specification",
            "number",
            "name",
            "sha256",
            "content",
            "positions",
            "author",
            "message",
            "saved_at_ms",
        ],
    ),
    (
        "approvals",
        &[
            "sequence",
            "specification",
            "revision",
            "kind",
            "sha256",
            "who",
            "token",
            "meaning",
            "comment",
            "at_ms",
        ],
    ),
    (
        "runs",
        &[
            "id",
            "sequence",
            "executor",
            "specification",
            "revision",
            "sha256",
            "state",
            "is_open",
            "began_at_ms",
            "changed_at_ms",
            "summary",
            "last_event",
        ],
    ),
    ("run_events", &["run", "number", "event", "robot_at_ms", "received_at_ms"]),
    (DEMONSTRATIONS, &["sha256", "bytes", "name", "media_type", "added_at_ms"]),
    ("specification_demonstrations", &["specification", "sha256", "name", "sequence"]),
    ("tokens", &["id", "sequence", "name", "role", "hash", "created_at_ms", "revoked_at_ms"]),
    ("sessions", &["hash", "token", "expires_at_ms"]),
];

const DEMONSTRATIONS: &str = "demonstrations";

/// What a backup holds.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct BackupReport {
    /// Rows of all tables.
    pub rows: u64,
    /// Demonstration files.
    pub demonstrations: u64,
}

impl Store {
    /// Copies everything that is stored at one moment into a new data folder with an SQLite database, from whichever
    /// database. Others may write meanwhile. The folder is there when all of it is there.
    ///
    /// # Errors
    ///
    /// [`StoreError::Invalid`] when `destination` is there and not an empty folder, or its `.partial` sibling is there;
    /// [`StoreError::Corrupt`] when a demonstration file is gone; when a file or a database fails. Nothing is left of the
    /// copy then.
    pub async fn backup(&self, destination: &Path) -> Result<BackupReport, StoreError> {
        refuse_occupied(destination)?;
        let partial = Partial::create(destination)?;
        let copy = Self::open(&Location::folder(&partial.0), StoreOptions::default()).await?;
        let copied = self.copy_into(&copy).await;
        // The database becomes a single file.
        copy.close().await;
        let report = copied?;
        partial.finish(destination)?;
        Ok(report)
    }

    async fn copy_into(&self, copy: &Self) -> Result<BackupReport, StoreError> {
        let mut snapshot = self.snapshot().await?;
        let mut writing = copy.write().await?;
        // The new database has begun to count; the copy goes on with the numbers of the original.
        sqlx::query("DELETE FROM counters").execute(writing.connection()).await?;
        let mut report = BackupReport::default();
        for table in &TABLES {
            report.rows += copy_table(&mut snapshot, &mut writing, table).await?;
        }
        let query = sqlx::query_scalar("SELECT sha256 FROM demonstrations");
        let files: Vec<String> = query.fetch_all(&mut *snapshot).await?;
        drop(snapshot);
        for sha256 in files {
            self.files.copy_to(&copy.files, &sha256).await?;
            report.demonstrations += 1;
        }
        writing.commit().await?;
        Ok(report)
    }
}

async fn copy_table(
    snapshot: &mut Transaction<'static, Any>,
    writing: &mut Writing,
    (name, columns): &Table,
) -> Result<u64, StoreError> {
    let list = columns.join(", ");
    let places: Vec<String> = (1..=columns.len()).map(|place| format!("${place}")).collect();
    let select = format!("SELECT {list} FROM {name}");
    let insert = format!("INSERT INTO {name} ({list}) VALUES ({})", places.join(", "));
    let mut copied = 0;
    // Names of tables and columns are this program's own.
    let mut rows = sqlx::query(AssertSqlSafe(select)).fetch(&mut **snapshot);
    while let Some(row) = rows.try_next().await? {
        let mut query = sqlx::query(AssertSqlSafe(insert.clone()));
        for place in 0..columns.len() {
            query = bind_value(query, &row, place)?;
        }
        query.execute(writing.connection()).await?;
        copied += 1;
    }
    Ok(copied)
}

fn bind_value<'q>(
    query: Query<'q, Any, AnyArguments>,
    row: &AnyRow,
    place: usize,
) -> Result<Query<'q, Any, AnyArguments>, StoreError> {
    let value = row.try_get_raw(place)?;
    let kind = value.type_info().kind();
    Ok(match kind {
        _ if value.is_null() || value.type_info().is_null() => query.bind(None::<String>),
        AnyTypeInfoKind::Text => query.bind(row.try_get::<String, _>(place)?),
        _ => query.bind(row.try_get::<i64, _>(place)?),
    })
}

fn refuse_occupied(destination: &Path) -> Result<(), StoreError> {
    let occupied = || StoreError::Invalid(format!("{}: it is there already", destination.display()));
    match fs::read_dir(destination) {
        Ok(mut entries) => entries.next().map_or(Ok(()), |_| Err(occupied())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => Err(occupied()),
        Err(error) => Err(StoreError::io(destination, error)),
    }
}

/// A folder that is removed again unless it is finished.
struct Partial(PathBuf);

impl Partial {
    fn create(destination: &Path) -> Result<Self, StoreError> {
        let name = destination
            .file_name()
            .ok_or_else(|| StoreError::Invalid(format!("{}: it has no name", destination.display())))?;
        let mut partial = name.to_os_string();
        partial.push(".partial");
        let path = destination.with_file_name(partial);
        match fs::create_dir(&path) {
            Ok(()) => Ok(Self(path)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                let sentence =
                    "another backup is being made, or one was interrupted; remove this folder then";
                Err(StoreError::Invalid(format!("{}: {sentence}", path.display())))
            }
            Err(error) => Err(StoreError::io(&path, error)),
        }
    }

    /// Gives the folder its name.
    fn finish(self, destination: &Path) -> Result<(), StoreError> {
        let rename = || {
            if destination.is_dir() {
                fs::remove_dir(destination)?;
            }
            sync_folder(&self.0)?;
            fs::rename(&self.0, destination)?;
            match destination.parent() {
                Some(parent) if !parent.as_os_str().is_empty() => sync_folder(parent),
                _ => sync_folder(Path::new(".")),
            }
        };
        rename().map_err(|error| StoreError::io(destination, error))
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        // Once it has its name it is not here any more.
        let _ = fs::remove_dir_all(&self.0);
    }
}
