//! Runs: what an executor makes of an approved revision.

use sqlx::{Any, FromRow};

use super::connection::Writing;
use super::revision::{refuse_nul, stored_number};
use super::{Conflict, Page, PageRequest, Store, StoreError};

/// The state of a run that has begun and of which nothing else is known.
const BEGUN: &str = "started";

/// A run to begin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewRun {
    /// Id, chosen by the executor, of this run alone.
    pub id: String,
    /// Name of the executor.
    pub executor: String,
    /// Id of the specification.
    pub specification: String,
    /// Number of the revision that is run.
    pub revision: u64,
    /// SHA-256 of the content that the executor holds.
    pub sha256: String,
    /// When, in milliseconds since 1970.
    pub at_ms: i64,
}

/// A run.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct RunRow {
    /// Id.
    pub id: String,
    /// Number in the order of the whole server; it grows, with gaps.
    #[sqlx(try_from = "i64")]
    pub sequence: u64,
    /// Name of the executor.
    pub executor: String,
    /// Id of the specification.
    pub specification: String,
    /// Number of the revision that is run.
    #[sqlx(try_from = "i64")]
    pub revision: u64,
    /// SHA-256 of the content that the executor holds.
    pub sha256: String,
    /// The state last set; `started` at first.
    pub state: String,
    /// 1 until the run has ended. See [`RunRow::is_open`].
    is_open: i64,
    /// When it began, in milliseconds since 1970.
    pub began_at_ms: i64,
    /// When its state was last set, in milliseconds since 1970.
    pub changed_at_ms: i64,
    /// What there is to say of it, as JSON.
    pub summary: Option<String>,
    /// Number of its newest event; 0 without one.
    #[sqlx(try_from = "i64")]
    pub last_event: u64,
}

impl RunRow {
    /// Whether the run has not ended.
    pub fn is_open(&self) -> bool {
        self.is_open != 0
    }
}

/// A state to set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RunChange {
    /// The state's name.
    pub state: String,
    /// Whether the run goes on in this state.
    pub is_open: bool,
    /// When, in milliseconds since 1970.
    pub at_ms: i64,
    /// What there is to say of it, as JSON; replaces what was said before.
    pub summary: Option<String>,
}

/// Which runs are wanted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RunFilter {
    /// Only those of this specification.
    pub specification: Option<String>,
    /// Only those that have not ended.
    pub open_only: bool,
}

/// The query for runs, with conditions.
macro_rules! select {
    ($condition:literal) => {
        concat!(
            "SELECT id, sequence, executor, specification, revision, sha256, state, is_open, began_at_ms, ",
            "changed_at_ms, summary, last_event FROM runs WHERE ",
            $condition
        )
    };
}

impl Store {
    /// Begins a run. Beginning one again with the same fields (whenever) is no fault, and returns the run as it is.
    ///
    /// # Errors
    ///
    /// [`Conflict::Run`] when there is a run of this id with other fields; [`StoreError::NotFound`] when there is no such
    /// revision; [`StoreError::Invalid`] when a text cannot be stored; when the database fails.
    pub async fn begin_run(&self, new: NewRun) -> Result<RunRow, StoreError> {
        refuse_nul(&[("the run's id", &new.id), ("the executor's name", &new.executor)])?;
        if let Some(known) = self.known_run(&new).await? {
            return Ok(known);
        }
        self.revision(&new.specification, new.revision).await?;
        match self.insert_run(&new).await {
            // Begun by another connection meanwhile.
            Err(StoreError::Database(error)) if is_taken(&error) => {
                self.known_run(&new).await?.ok_or(StoreError::Database(error))
            }
            result => result,
        }
    }

    async fn known_run(&self, new: &NewRun) -> Result<Option<RunRow>, StoreError> {
        let query = sqlx::query_as::<Any, RunRow>(select!("id = $1"));
        let Some(row) = query.bind(&new.id).fetch_optional(&self.pool).await? else { return Ok(None) };
        let is_same = (&row.executor, &row.specification, row.revision, &row.sha256)
            == (&new.executor, &new.specification, new.revision, &new.sha256);
        if is_same { Ok(Some(row)) } else { Err(Conflict::Run(row).into()) }
    }

    async fn insert_run(&self, new: &NewRun) -> Result<RunRow, StoreError> {
        let mut writing = self.write().await?;
        let sequence = writing.next_sequence().await?;
        sqlx::query(
            "INSERT INTO runs (id, sequence, executor, specification, revision, sha256, state, is_open, \
             began_at_ms, changed_at_ms, summary, last_event) \
             VALUES ($1, $2, $3, $4, $5, $6, $7, 1, $8, $8, NULL, 0)",
        )
        .bind(&new.id)
        .bind(sequence)
        .bind(&new.executor)
        .bind(&new.specification)
        .bind(stored_number(new.revision))
        .bind(&new.sha256)
        .bind(BEGUN)
        .bind(new.at_ms)
        .execute(writing.connection())
        .await?;
        let row = select_run(&mut writing, &new.id).await?;
        writing.commit().await?;
        Ok(row)
    }

    /// One run.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; when the database fails.
    pub async fn run(&self, id: &str) -> Result<RunRow, StoreError> {
        let query = sqlx::query_as(select!("id = $1")).bind(id);
        query.fetch_optional(&self.pool).await?.ok_or_else(|| StoreError::not_found("run", id))
    }

    /// Runs, newest first, also those of deleted specifications.
    ///
    /// # Errors
    ///
    /// [`StoreError::Invalid`] when the request's `after` is not of a page before; when the database fails.
    pub async fn runs(&self, filter: &RunFilter, page: &PageRequest) -> Result<Page<RunRow>, StoreError> {
        let query = select!(
            "sequence < $1 AND ($2 IS NULL OR specification = $2) AND is_open >= $3 \
             ORDER BY sequence DESC LIMIT $4"
        );
        let rows = sqlx::query_as(query)
            .bind(page.position_from_newest()?)
            .bind(&filter.specification)
            .bind(i64::from(filter.open_only))
            .bind(page.rows_to_read())
            .fetch_all(&self.pool)
            .await?;
        Ok(page.page(rows, |row: &RunRow| row.sequence))
    }

    /// Sets a run's state.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; [`StoreError::Invalid`] when a text cannot be stored; when the database fails.
    pub async fn set_run_state(&self, id: &str, change: RunChange) -> Result<RunRow, StoreError> {
        refuse_nul(&[
            ("the state", &change.state),
            ("the summary", change.summary.as_deref().unwrap_or_default()),
        ])?;
        let mut writing = self.write().await?;
        sqlx::query(
            "UPDATE runs SET state = $1, is_open = $2, changed_at_ms = $3, summary = $4 WHERE id = $5",
        )
        .bind(&change.state)
        .bind(i64::from(change.is_open))
        .bind(change.at_ms)
        .bind(&change.summary)
        .bind(id)
        .execute(writing.connection())
        .await?;
        let row = select_run(&mut writing, id).await?;
        writing.commit().await?;
        Ok(row)
    }

    /// Gives a run to another executor.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; [`StoreError::Invalid`] when the name cannot be stored; when the database fails.
    pub async fn hand_over_run(&self, id: &str, executor: &str) -> Result<RunRow, StoreError> {
        refuse_nul(&[("the executor's name", executor)])?;
        let mut writing = self.write().await?;
        let query = sqlx::query("UPDATE runs SET executor = $1 WHERE id = $2");
        query.bind(executor).bind(id).execute(writing.connection()).await?;
        let row = select_run(&mut writing, id).await?;
        writing.commit().await?;
        Ok(row)
    }
}

async fn select_run(writing: &mut Writing, id: &str) -> Result<RunRow, StoreError> {
    let row = sqlx::query_as::<Any, RunRow>(select!("id = $1")).bind(id);
    let row = row.fetch_optional(writing.connection()).await?;
    row.ok_or_else(|| StoreError::not_found("run", id))
}

fn is_taken(error: &sqlx::Error) -> bool {
    error.as_database_error().is_some_and(sqlx::error::DatabaseError::is_unique_violation)
}
