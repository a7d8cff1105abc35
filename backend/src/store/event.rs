//! What an executor reports of a run: numbered from 1 without gaps, each stored once.

use std::cmp::Ordering;

use sqlx::{Any, FromRow};

use super::connection::Writing;
use super::revision::{refuse_nul, stored_number};
use super::{Store, StoreError};

/// An event to store.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewEvent {
    /// Number that the executor gave it: 1 for a run's first, then without gaps.
    pub number: u64,
    /// The event as JSON.
    pub event: String,
    /// What the robot's clock said, in milliseconds since 1970.
    pub robot_at_ms: Option<i64>,
    /// When it was received, in milliseconds since 1970.
    pub received_at_ms: i64,
}

/// A stored event.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct EventRow {
    /// Number, from 1 without gaps.
    #[sqlx(try_from = "i64")]
    pub number: u64,
    /// The event as JSON.
    pub event: String,
    /// What the robot's clock said, in milliseconds since 1970.
    pub robot_at_ms: Option<i64>,
    /// When it was first received, in milliseconds since 1970.
    pub received_at_ms: i64,
}

/// What became of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Appended {
    /// It is stored now.
    Stored,
    /// The same was stored before.
    Known,
    /// Events before it are missing: nothing was stored of it.
    Gap {
        /// The number that comes next.
        expected: u64,
    },
    /// Another event has this number: nothing was stored of it.
    Different,
}

impl Store {
    /// Stores an event of a run.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`] when there is no such run; [`StoreError::Invalid`] when the event cannot be stored; when
    /// the database fails.
    pub async fn append_event(&self, run: &str, event: NewEvent) -> Result<Appended, StoreError> {
        let outcomes = self.append_events(run, &[event]).await?;
        outcomes.first().copied().ok_or_else(|| StoreError::not_found("run", run))
    }

    /// Stores events of a run in one transaction, in their order, and tells what became of each. It ends with the first
    /// that is [`Appended::Gap`] or [`Appended::Different`]: what comes after it is not looked at, what comes before it
    /// is stored.
    ///
    /// # Errors
    ///
    /// As [`Store::append_event`]; nothing is stored then.
    pub async fn append_events(&self, run: &str, events: &[NewEvent]) -> Result<Vec<Appended>, StoreError> {
        for event in events {
            refuse_nul(&[("the event", &event.event)])?;
        }
        let mut writing = self.write().await?;
        let before = lock_run(&mut writing, run).await?;
        let mut last = before;
        let mut outcomes = Vec::with_capacity(events.len());
        for event in events {
            let outcome = append(&mut writing, run, last, event).await?;
            outcomes.push(outcome);
            match outcome {
                Appended::Stored => last = event.number,
                Appended::Known => {}
                Appended::Gap { .. } | Appended::Different => break,
            }
        }
        if last > before {
            set_last_event(&mut writing, run, last).await?;
            writing.commit().await?;
        }
        Ok(outcomes)
    }

    /// The events of a run after the number `after` (0 for all), at most `limit`, in their order.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`] when there is no such run; when the database fails.
    pub async fn events(&self, run: &str, after: u64, limit: u32) -> Result<Vec<EventRow>, StoreError> {
        self.run(run).await?;
        let after = i64::try_from(after).unwrap_or(i64::MAX);
        let rows = sqlx::query_as(
            "SELECT number, event, robot_at_ms, received_at_ms FROM run_events \
             WHERE run = $1 AND number > $2 ORDER BY number LIMIT $3",
        );
        Ok(rows.bind(run).bind(after).bind(i64::from(limit)).fetch_all(&self.pool).await?)
    }
}

/// Keeps other writers from the run until the transaction ends, and returns the number of its newest event.
pub(super) async fn lock_run(writing: &mut Writing, run: &str) -> Result<u64, StoreError> {
    let query = "UPDATE runs SET last_event = last_event WHERE id = $1 RETURNING last_event";
    let last: Option<i64> = sqlx::query_scalar(query).bind(run).fetch_optional(writing.connection()).await?;
    Ok(last.ok_or_else(|| StoreError::not_found("run", run))?.unsigned_abs())
}

pub(super) async fn set_last_event(writing: &mut Writing, run: &str, last: u64) -> Result<(), StoreError> {
    let query = sqlx::query("UPDATE runs SET last_event = $1 WHERE id = $2");
    query.bind(stored_number(last)).bind(run).execute(writing.connection()).await?;
    Ok(())
}

/// Stores `event` of a run whose newest event has the number `last`, if it is the next.
pub(super) async fn append(
    writing: &mut Writing,
    run: &str,
    last: u64,
    event: &NewEvent,
) -> Result<Appended, StoreError> {
    let expected = last + 1;
    match event.number.cmp(&expected) {
        Ordering::Less => compare_with_stored(writing, run, event).await,
        Ordering::Greater => Ok(Appended::Gap { expected }),
        Ordering::Equal => {
            insert_event(writing, run, event).await?;
            Ok(Appended::Stored)
        }
    }
}

async fn compare_with_stored(
    writing: &mut Writing,
    run: &str,
    event: &NewEvent,
) -> Result<Appended, StoreError> {
    let stored: Option<(String, Option<i64>)> =
        sqlx::query_as::<Any, _>("SELECT event, robot_at_ms FROM run_events WHERE run = $1 AND number = $2")
            .bind(run)
            .bind(stored_number(event.number))
            .fetch_optional(writing.connection())
            .await?;
    let is_same = stored.is_some_and(|it| it == (event.event.clone(), event.robot_at_ms));
    Ok(if is_same { Appended::Known } else { Appended::Different })
}

async fn insert_event(writing: &mut Writing, run: &str, event: &NewEvent) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO run_events (run, number, event, robot_at_ms, received_at_ms) \
         VALUES ($1, $2, $3, $4, $5)",
    )
    .bind(run)
    .bind(stored_number(event.number))
    .bind(&event.event)
    .bind(event.robot_at_ms)
    .bind(event.received_at_ms)
    .execute(writing.connection())
    .await?;
    Ok(())
}
