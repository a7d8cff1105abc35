//! Specifications: made, listed, saved, deleted.

use sqlx::{Any, FromRow};
use uuid::Uuid;

use super::connection::Writing;
use super::revision::{
    NewRevision, RevisionRow, insert_revision, refuse_unstorable, select_revision, stored_number,
};
use super::{Conflict, Page, PageRequest, Store, StoreError};

/// What a specification begins with: its first revision.
pub type NewSpecification = NewRevision;

/// A specification, as its newest revision describes it.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct SpecificationRow {
    /// Id, 32 hexadecimal digits.
    pub id: String,
    /// Name.
    pub name: String,
    /// Number of the newest revision.
    #[sqlx(try_from = "i64")]
    pub head: u64,
    /// SHA-256 of the newest revision's content.
    pub sha256: String,
    /// Who saved the newest revision.
    pub author: String,
    /// What was said of it.
    pub message: String,
    /// When the newest revision was saved, in milliseconds since 1970.
    pub saved_at_ms: i64,
    /// When the first revision was saved, in milliseconds since 1970.
    pub created_at_ms: i64,
    /// Number of the approved revision; 0 is none. See [`SpecificationRow::approved`].
    #[sqlx(try_from = "i64")]
    approved: u64,
    /// Grows with every save of any specification.
    #[sqlx(try_from = "i64")]
    pub saved_sequence: u64,
}

/// The query for rows of specifications that are not deleted, with a further condition.
macro_rules! select {
    ($condition:literal) => {
        concat!(
            "SELECT s.id, r.name, s.head, r.sha256, r.author, r.message, r.saved_at_ms, s.created_at_ms, ",
            "s.approved, s.saved_sequence ",
            "FROM specifications s JOIN revisions r ON r.specification = s.id AND r.number = s.head ",
            "WHERE s.deleted = 0 AND ",
            $condition
        )
    };
}

impl SpecificationRow {
    /// Number of the approved revision, if one is.
    pub fn approved(&self) -> Option<u64> {
        (self.approved > 0).then_some(self.approved)
    }
}

impl Store {
    /// Keeps a new specification and returns it with its new id; its first revision has the number 1.
    ///
    /// # Errors
    ///
    /// [`StoreError::Invalid`] when a text cannot be stored; when the database fails.
    pub async fn create(&self, new: NewSpecification) -> Result<SpecificationRow, StoreError> {
        refuse_unstorable(&new)?;
        let id = Uuid::new_v4().simple().to_string();
        let mut writing = self.write().await?;
        let sequence = writing.next_sequence().await?;
        sqlx::query(
            "INSERT INTO specifications (id, head, approved, saved_sequence, created_at_ms, deleted) \
             VALUES ($1, 1, 0, $2, $3, 0)",
        )
        .bind(&id)
        .bind(sequence)
        .bind(new.saved_at_ms)
        .execute(writing.connection())
        .await?;
        insert_revision(&mut writing, &id, 1, new).await?;
        let row = select_specification(&mut writing, &id).await?;
        writing.commit().await?;
        row.ok_or_else(|| StoreError::not_found("specification", id))
    }

    /// The specifications, newest saved first. One that is saved while one reads page after page moves to the front.
    ///
    /// # Errors
    ///
    /// [`StoreError::Invalid`] when the request's `after` is not of a page before; when the database fails.
    pub async fn specifications(&self, page: &PageRequest) -> Result<Page<SpecificationRow>, StoreError> {
        let rows = sqlx::query_as(select!("s.saved_sequence < $1 ORDER BY s.saved_sequence DESC LIMIT $2"))
            .bind(page.position_from_newest()?)
            .bind(page.rows_to_read())
            .fetch_all(&self.pool)
            .await?;
        Ok(page.page(rows, |row: &SpecificationRow| row.saved_sequence))
    }

    /// One specification.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; when the database fails.
    pub async fn specification(&self, id: &str) -> Result<SpecificationRow, StoreError> {
        let row = sqlx::query_as(select!("s.id = $1")).bind(id).fetch_optional(&self.pool).await?;
        row.ok_or_else(|| StoreError::not_found("specification", id))
    }

    /// Saves a new revision of a specification whose newest is `based_on`.
    ///
    /// # Errors
    ///
    /// [`Conflict::Saved`] with the newest revision when that is another; [`StoreError::NotFound`];
    /// [`StoreError::Invalid`] when a text cannot be stored; when the database fails.
    pub async fn save(&self, id: &str, based_on: u64, new: NewRevision) -> Result<RevisionRow, StoreError> {
        refuse_unstorable(&new)?;
        let mut writing = self.write().await?;
        let moved = sqlx::query(
            "UPDATE specifications SET head = head + 1 WHERE id = $1 AND head = $2 AND deleted = 0",
        )
        .bind(id)
        .bind(stored_number(based_on))
        .execute(writing.connection())
        .await?;
        if moved.rows_affected() == 0 {
            return Err(why_not_saved(&mut writing, id).await?);
        }
        let sequence = writing.next_sequence().await?;
        sqlx::query("UPDATE specifications SET saved_sequence = $1 WHERE id = $2")
            .bind(sequence)
            .bind(id)
            .execute(writing.connection())
            .await?;
        let row = insert_revision(&mut writing, id, based_on + 1, new).await?;
        writing.commit().await?;
        Ok(row)
    }

    /// Hides a specification, whose newest revision is `head`, with its revisions and approvals. Nothing of it is lost.
    ///
    /// # Errors
    ///
    /// [`Conflict::Saved`] when `head` is not the newest revision (any more), [`Conflict::StillApproved`] while one is
    /// approved; [`StoreError::NotFound`]; when the database fails.
    pub async fn delete(&self, id: &str, head: u64) -> Result<(), StoreError> {
        let mut writing = self.write().await?;
        let deleted = sqlx::query(
            "UPDATE specifications SET deleted = 1 WHERE id = $1 AND head = $2 AND approved = 0 AND deleted = 0",
        )
        .bind(id)
        .bind(stored_number(head))
        .execute(writing.connection())
        .await?;
        if deleted.rows_affected() == 0 {
            return Err(why_not_deleted(&mut writing, id, head).await?);
        }
        writing.commit().await
    }
}

/// A specification that is not deleted, as the transaction sees it.
pub(super) async fn select_specification(
    writing: &mut Writing,
    id: &str,
) -> Result<Option<SpecificationRow>, StoreError> {
    let query = sqlx::query_as::<Any, SpecificationRow>(select!("s.id = $1")).bind(id);
    Ok(query.fetch_optional(writing.connection()).await?)
}

async fn why_not_deleted(writing: &mut Writing, id: &str, head: u64) -> Result<StoreError, StoreError> {
    let row = select_specification(writing, id).await?;
    match row.filter(|row| row.head == head).and_then(|row| row.approved()) {
        Some(approved) => Ok(Conflict::StillApproved(approved).into()),
        None => why_not_saved(writing, id).await,
    }
}

async fn why_not_saved(writing: &mut Writing, id: &str) -> Result<StoreError, StoreError> {
    let Some(specification) = select_specification(writing, id).await? else {
        return Ok(StoreError::not_found("specification", id));
    };
    let head = select_revision(writing, id, specification.head).await?;
    let head =
        head.ok_or_else(|| StoreError::Corrupt(format!("specification {id} has no newest revision")))?;
    Ok(Conflict::Saved(head).into())
}
