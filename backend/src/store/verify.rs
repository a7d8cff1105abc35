//! Whether everything is still what was stored.

use futures_util::StreamExt;
use sqlx::{Any, Transaction};

use super::revision::fault_of_content;
use super::{Backend, Store, StoreError};

/// What was checked, and what is wrong.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct VerifyReport {
    /// Revisions, whose content was hashed again.
    pub revisions: u64,
    /// Entries of the journal of approvals.
    pub approvals: u64,
    /// Runs, whose events were counted.
    pub runs: u64,
    /// Events of all runs.
    pub events: u64,
    /// Demonstration files, which were hashed again.
    pub demonstrations: u64,
    /// One line for each thing that is wrong, with its place.
    pub faults: Vec<String>,
}

/// A check of one state of the database, which goes on while others write.
struct Verification<'a> {
    store: &'a Store,
    snapshot: Transaction<'static, Any>,
    report: VerifyReport,
}

impl Store {
    /// Hashes every revision and every demonstration file again, and checks the journal of approvals and the numbers of
    /// revisions and events, also of deleted specifications.
    ///
    /// # Errors
    ///
    /// When the database cannot be read at all; what is wrong with what it holds is in the report.
    pub async fn verify(&self) -> Result<VerifyReport, StoreError> {
        let snapshot = self.snapshot().await?;
        let mut it = Verification { store: self, snapshot, report: VerifyReport::default() };
        let result = it.check_database().await;
        it.note("the database file", result);
        let result = it.check_revisions().await;
        it.note("the revisions", result);
        let result = it.check_heads().await;
        it.note("the specifications", result);
        let result = it.check_journal().await;
        it.note("the journal of approvals", result);
        let result = it.check_runs().await;
        it.note("the runs", result);
        let result = it.check_demonstrations().await;
        it.note("the demonstrations", result);
        Ok(it.report)
    }
}

impl Verification<'_> {
    fn fault(&mut self, line: String) {
        self.report.faults.push(line);
    }

    fn note(&mut self, what: &str, result: Result<(), StoreError>) {
        if let Err(error) = result {
            self.fault(format!("{what}: cannot be read to the end: {error}"));
        }
    }

    /// The pages of an SQLite file; PostgreSQL checks its own.
    async fn check_database(&mut self) -> Result<(), StoreError> {
        if self.store.backend() == Backend::Postgres {
            return Ok(());
        }
        let lines: Vec<String> =
            sqlx::query_scalar("PRAGMA integrity_check").fetch_all(&mut *self.snapshot).await?;
        for line in lines.into_iter().filter(|line| line != "ok") {
            self.fault(format!("the database file: {line}"));
        }
        Ok(())
    }

    async fn check_revisions(&mut self) -> Result<(), StoreError> {
        let query = "SELECT specification, number, content, sha256 FROM revisions \
                     ORDER BY specification, number";
        let mut rows = sqlx::query_as::<Any, (String, i64, String, String)>(query).fetch(&mut *self.snapshot);
        while let Some(row) = rows.next().await {
            let (id, number, content, sha256) = row?;
            self.report.revisions += 1;
            let fault = fault_of_content(&id, number.unsigned_abs(), &content, &sha256);
            self.report.faults.extend(fault);
        }
        Ok(())
    }

    /// Revisions have the numbers from 1 to the newest.
    async fn check_heads(&mut self) -> Result<(), StoreError> {
        let query = "SELECT s.id, s.head, COUNT(r.number), COALESCE(MIN(r.number), 1), COALESCE(MAX(r.number), 0) \
                     FROM specifications s LEFT JOIN revisions r ON r.specification = s.id \
                     GROUP BY s.id, s.head ORDER BY s.id";
        let rows: Vec<(String, i64, i64, i64, i64)> =
            sqlx::query_as(query).fetch_all(&mut *self.snapshot).await?;
        for (id, head, count, first, last) in rows {
            if (count, first, last) != (head, 1, head) {
                self.fault(format!(
                    "specification {id}: {count} revisions from {first} to {last}, but {head} is the newest"
                ));
            }
        }
        Ok(())
    }

    /// Every entry names a revision with its SHA-256, and the last one says which revision is approved.
    async fn check_journal(&mut self) -> Result<(), StoreError> {
        let query = "SELECT a.sequence, a.specification, a.revision, a.kind, a.sha256, COALESCE(r.sha256, '') \
                     FROM approvals a LEFT JOIN revisions r \
                     ON r.specification = a.specification AND r.number = a.revision ORDER BY a.sequence";
        let mut rows = sqlx::query_as::<Any, (i64, String, i64, String, String, String)>(query)
            .fetch(&mut *self.snapshot);
        while let Some(row) = rows.next().await {
            let (sequence, id, revision, kind, sha256, found) = row?;
            self.report.approvals += 1;
            let place = format!("approval {sequence}: specification {id}, revision {revision}");
            if found != sha256 {
                let found = if found.is_empty() { "not there".to_owned() } else { format!("now {found}") };
                self.report.faults.push(format!("{place} had the SHA-256 {sha256}, it is {found}"));
            }
            if kind != "approved" && kind != "revoked" {
                self.report.faults.push(format!("{place}: {kind:?} is neither approved nor revoked"));
            }
        }
        drop(rows);
        self.check_approved().await
    }

    async fn check_approved(&mut self) -> Result<(), StoreError> {
        let query = "SELECT s.id, s.approved, COALESCE(a.revision, 0), COALESCE(a.kind, 'revoked') \
                     FROM specifications s LEFT JOIN approvals a ON a.sequence = \
                     (SELECT MAX(last.sequence) FROM approvals last WHERE last.specification = s.id) \
                     ORDER BY s.id";
        let rows: Vec<(String, i64, i64, String)> =
            sqlx::query_as(query).fetch_all(&mut *self.snapshot).await?;
        for (id, approved, revision, kind) in rows {
            let expected = if kind == "approved" { revision } else { 0 };
            if approved != expected {
                let name =
                    |number| if number == 0 { "none".to_owned() } else { format!("revision {number}") };
                let (approved, expected) = (name(approved), name(expected));
                self.fault(format!("specification {id}: approved is {approved}, by the journal {expected}"));
            }
        }
        Ok(())
    }

    /// Events have the numbers from 1 to the newest.
    async fn check_runs(&mut self) -> Result<(), StoreError> {
        let query = "SELECT u.id, u.last_event, COUNT(e.number), COALESCE(MIN(e.number), 1), COALESCE(MAX(e.number), 0) \
                     FROM runs u LEFT JOIN run_events e ON e.run = u.id \
                     GROUP BY u.id, u.last_event ORDER BY u.id";
        let rows: Vec<(String, i64, i64, i64, i64)> =
            sqlx::query_as(query).fetch_all(&mut *self.snapshot).await?;
        for (id, newest, count, first, last) in rows {
            self.report.runs += 1;
            self.report.events += count.unsigned_abs();
            if (count, first, last) != (newest, 1, newest) {
                self.fault(format!(
                    "run {id:?}: {count} events from {first} to {last}, but {newest} is the newest"
                ));
            }
        }
        Ok(())
    }

    /// Every file is there, with its SHA-256; and so is every file that a specification uses.
    async fn check_demonstrations(&mut self) -> Result<(), StoreError> {
        let query = "SELECT sha256, bytes FROM demonstrations ORDER BY sha256";
        let rows: Vec<(String, i64)> = sqlx::query_as(query).fetch_all(&mut *self.snapshot).await?;
        for (sha256, bytes) in rows {
            self.report.demonstrations += 1;
            match self.store.files.digest(&sha256).await {
                Err(error) => self.fault(format!("demonstration {sha256}: the file cannot be read: {error}")),
                Ok(found) if found.sha256 != sha256 => {
                    self.fault(format!("demonstration {sha256}: the file has the SHA-256 {}", found.sha256));
                }
                Ok(found) if i64::try_from(found.bytes) != Ok(bytes) => {
                    self.fault(format!("demonstration {sha256}: {} bytes, stored were {bytes}", found.bytes));
                }
                Ok(_) => {}
            }
        }
        let query = "SELECT l.specification, l.name, l.sha256 FROM specification_demonstrations l \
                     LEFT JOIN demonstrations d ON d.sha256 = l.sha256 WHERE d.sha256 IS NULL \
                     ORDER BY l.specification, l.sequence";
        let missing: Vec<(String, String, String)> =
            sqlx::query_as(query).fetch_all(&mut *self.snapshot).await?;
        for (id, name, sha256) in missing {
            self.fault(format!("specification {id}: its demonstration {name:?} ({sha256}) is not there"));
        }
        Ok(())
    }
}
