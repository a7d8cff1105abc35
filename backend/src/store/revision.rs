//! Revisions: written once, never changed.

use sqlx::{Any, FromRow};

use super::connection::Writing;
use super::{Page, PageRequest, Store, StoreError};
use crate::digest::sha256_hex;

/// A revision to save.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewRevision {
    /// The specification file as canonical JSON: these bytes are what is hashed, approved and relayed.
    pub content: String,
    /// Name of the specification.
    pub name: String,
    /// Who saves it.
    pub author: String,
    /// What they say of it.
    pub message: String,
    /// When, in milliseconds since 1970.
    pub saved_at_ms: i64,
    /// Places of hand-moved states, as JSON. They are beside the content and no part of what is hashed.
    pub positions: Option<String>,
}

/// A revision without its content.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct RevisionRow {
    /// Id of the specification.
    pub specification: String,
    /// Number, from 1 without gaps.
    #[sqlx(try_from = "i64")]
    pub number: u64,
    /// Name of the specification.
    pub name: String,
    /// SHA-256 of the content, 64 lower-case hexadecimal digits.
    pub sha256: String,
    /// Who saved it.
    pub author: String,
    /// What they said of it.
    pub message: String,
    /// When, in milliseconds since 1970.
    pub saved_at_ms: i64,
    /// Places of hand-moved states, as JSON.
    pub positions: Option<String>,
}

/// The query for rows of revisions of specifications that are not deleted, with a further condition.
macro_rules! select {
    ($condition:literal) => {
        concat!(
            "SELECT r.specification, r.number, r.name, r.sha256, r.author, r.message, r.saved_at_ms, r.positions ",
            "FROM revisions r JOIN specifications s ON s.id = r.specification ",
            "WHERE s.deleted = 0 AND r.specification = $1 AND ",
            $condition
        )
    };
}

impl Store {
    /// The revisions of a specification, newest first.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`] when there is no such specification; [`StoreError::Invalid`] when the request's `after`
    /// is not of a page before; when the database fails.
    pub async fn revisions(&self, id: &str, page: &PageRequest) -> Result<Page<RevisionRow>, StoreError> {
        self.specification(id).await?;
        let rows = sqlx::query_as(select!("r.number < $2 ORDER BY r.number DESC LIMIT $3"))
            .bind(id)
            .bind(page.position_from_newest()?)
            .bind(page.rows_to_read())
            .fetch_all(&self.pool)
            .await?;
        Ok(page.page(rows, |row: &RevisionRow| row.number))
    }

    /// One revision.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`] when there is no such specification or revision; when the database fails.
    pub async fn revision(&self, id: &str, number: u64) -> Result<RevisionRow, StoreError> {
        let query = sqlx::query_as(select!("r.number = $2")).bind(id).bind(stored_number(number));
        query.fetch_optional(&self.pool).await?.ok_or_else(|| not_found(id, number))
    }

    /// The content of a revision, which has the SHA-256 that its row has.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; [`StoreError::Corrupt`] when the content is not what was saved; when the database
    /// fails.
    pub async fn content(&self, id: &str, number: u64) -> Result<String, StoreError> {
        self.revision(id, number).await?;
        self.kept_content(id, number).await
    }

    /// As [`content`](Self::content), also of a specification that was deleted: runs of it go on.
    ///
    /// # Errors
    ///
    /// As [`content`](Self::content).
    pub async fn kept_content(&self, id: &str, number: u64) -> Result<String, StoreError> {
        let query = "SELECT content, sha256 FROM revisions WHERE specification = $1 AND number = $2";
        let query = sqlx::query_as(query).bind(id).bind(stored_number(number));
        let row: Option<(String, String)> = query.fetch_optional(&self.pool).await?;
        let (content, sha256) = row.ok_or_else(|| not_found(id, number))?;
        match fault_of_content(id, number, &content, &sha256) {
            None => Ok(content),
            Some(fault) => Err(StoreError::Corrupt(fault)),
        }
    }
}

/// What is wrong with the content of a revision, if anything is.
pub(super) fn fault_of_content(id: &str, number: u64, content: &str, sha256: &str) -> Option<String> {
    let found = sha256_hex(content.as_bytes());
    (found != sha256).then(|| {
        format!(
            "specification {id}, revision {number}: the content has the SHA-256 {found}, saved was {sha256}"
        )
    })
}

/// Nothing is a revision of this number.
pub(super) fn not_found(id: &str, number: u64) -> StoreError {
    StoreError::not_found("revision", format!("{number} of specification {id}"))
}

/// A number as the database has it. One that is out of its range is the number of nothing, and so is -1.
pub(super) fn stored_number(number: u64) -> i64 {
    i64::try_from(number).unwrap_or(-1)
}

/// A revision of a specification that is not deleted, as the transaction sees it.
pub(super) async fn select_revision(
    writing: &mut Writing,
    id: &str,
    number: u64,
) -> Result<Option<RevisionRow>, StoreError> {
    let query = sqlx::query_as::<Any, RevisionRow>(select!("r.number = $2"));
    Ok(query.bind(id).bind(stored_number(number)).fetch_optional(writing.connection()).await?)
}

/// Adds a revision to a specification that is there.
pub(super) async fn insert_revision(
    writing: &mut Writing,
    id: &str,
    number: u64,
    new: NewRevision,
) -> Result<RevisionRow, StoreError> {
    let sha256 = sha256_hex(new.content.as_bytes());
    sqlx::query(
        "INSERT INTO revisions \
         (specification, number, name, sha256, content, positions, author, message, saved_at_ms) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9)",
    )
    .bind(id)
    .bind(stored_number(number))
    .bind(&new.name)
    .bind(&sha256)
    .bind(new.content)
    .bind(&new.positions)
    .bind(&new.author)
    .bind(&new.message)
    .bind(new.saved_at_ms)
    .execute(writing.connection())
    .await?;
    Ok(RevisionRow {
        specification: id.to_owned(),
        number,
        name: new.name,
        sha256,
        author: new.author,
        message: new.message,
        saved_at_ms: new.saved_at_ms,
        positions: new.positions,
    })
}

/// Refuses texts that not every database can hold.
///
/// # Errors
///
/// [`StoreError::Invalid`] that names the first of `texts`, each with what it is, that holds a NUL character.
pub(super) fn refuse_nul(texts: &[(&str, &str)]) -> Result<(), StoreError> {
    match texts.iter().find(|(_, text)| text.contains('\0')) {
        None => Ok(()),
        Some((what, _)) => Err(StoreError::Invalid(format!("{what} holds a NUL character"))),
    }
}

/// Refuses a revision whose texts not every database can hold.
pub(super) fn refuse_unstorable(new: &NewRevision) -> Result<(), StoreError> {
    refuse_nul(&[
        ("the content", &new.content),
        ("the name", &new.name),
        ("the author", &new.author),
        ("the message", &new.message),
        ("the positions", new.positions.as_deref().unwrap_or_default()),
    ])
}
