//! The journal of approvals: who approved or revoked what. Entries are only ever added.

use sqlx::Any;

use super::connection::Writing;
use super::revision::{not_found, refuse_nul, select_revision, stored_number};
use super::specification::select_specification;
use super::{
    ApprovalKind, ApprovalRow, ApprovedRow, Conflict, NewApproval, Page, PageRequest, Signature, Store,
    StoreError,
};

/// The query for entries of the journal, with conditions.
macro_rules! select {
    ($condition:literal) => {
        concat!(
            "SELECT sequence, specification, revision, kind, sha256, who, token, meaning, comment, at_ms ",
            "FROM approvals WHERE specification = $1 AND ",
            $condition
        )
    };
}

/// The query for approved revisions, with conditions. The last entry for a specification with an approved revision is
/// its approval.
macro_rules! select_approved {
    ($condition:literal) => {
        concat!(
            "SELECT s.id AS specification, r.name, r.number AS revision, r.sha256, a.sequence, a.who, a.at_ms ",
            "FROM specifications s JOIN revisions r ON r.specification = s.id AND r.number = s.approved ",
            "JOIN approvals a ON a.sequence = ",
            "(SELECT MAX(last.sequence) FROM approvals last WHERE last.specification = s.id) ",
            "WHERE s.deleted = 0 AND s.approved > 0 ",
            $condition
        )
    };
}

impl Store {
    /// Makes a revision the approved one of its specification.
    ///
    /// # Errors
    ///
    /// [`Conflict::Approved`] with the journal's last entry when not `expected_approved` is the approved revision, or
    /// when this revision is approved already; [`Conflict::OtherContent`] when the revision's content is not what was seen; [`StoreError::NotFound`];
    /// [`StoreError::Invalid`] when a text cannot be stored; when the database fails.
    pub async fn approve(&self, id: &str, new: NewApproval) -> Result<ApprovalRow, StoreError> {
        refuse_unstorable(&new.signature)?;
        // 0 stands for no approved revision.
        if new.revision == 0 {
            return Err(not_found(id, new.revision));
        }
        let mut writing = self.write().await?;
        let expected = new.expected_approved.map_or(0, stored_number);
        move_approved(&mut writing, id, expected, new.revision).await?;
        let revision = select_revision(&mut writing, id, new.revision).await?;
        let revision = revision.ok_or_else(|| not_found(id, new.revision))?;
        if revision.sha256 != new.sha256_seen {
            return Err(Conflict::OtherContent(revision).into());
        }
        let entry = entry(revision.specification, new.revision, revision.sha256, new.signature);
        let row =
            insert_approval(&mut writing, ApprovalRow { kind: ApprovalKind::Approved, ..entry }).await?;
        writing.commit().await?;
        Ok(row)
    }

    /// Takes the approval of a revision back, so that no revision of its specification is approved.
    ///
    /// # Errors
    ///
    /// [`Conflict::Approved`] with the journal's last entry when this revision is not the approved one;
    /// [`StoreError::NotFound`]; [`StoreError::Invalid`] when a text cannot be stored; when the database fails.
    pub async fn revoke(
        &self,
        id: &str,
        revision: u64,
        signature: Signature,
    ) -> Result<ApprovalRow, StoreError> {
        refuse_unstorable(&signature)?;
        let mut writing = self.write().await?;
        // No revision has the number 0: asked to revoke that, nothing may be found.
        let expected = if revision == 0 { -1 } else { stored_number(revision) };
        move_approved(&mut writing, id, expected, 0).await?;
        let approved = select_revision(&mut writing, id, revision).await?;
        let approved = approved.ok_or_else(|| not_found(id, revision))?;
        let entry = entry(approved.specification, revision, approved.sha256, signature);
        let row = insert_approval(&mut writing, ApprovalRow { kind: ApprovalKind::Revoked, ..entry }).await?;
        writing.commit().await?;
        Ok(row)
    }

    /// The journal of a specification, newest entry first.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`] when there is no such specification; [`StoreError::Invalid`] when the request's `after`
    /// is not of a page before; when the database fails.
    pub async fn approvals(&self, id: &str, page: &PageRequest) -> Result<Page<ApprovalRow>, StoreError> {
        self.specification(id).await?;
        let rows = sqlx::query_as(select!("sequence < $2 ORDER BY sequence DESC LIMIT $3"))
            .bind(id)
            .bind(page.position_from_newest()?)
            .bind(page.rows_to_read())
            .fetch_all(&self.pool)
            .await?;
        Ok(page.page(rows, |row: &ApprovalRow| row.sequence))
    }

    /// The approved revision of a specification, if one is.
    ///
    /// # Errors
    ///
    /// When the database fails.
    pub async fn approved(&self, id: &str) -> Result<Option<ApprovedRow>, StoreError> {
        let query = sqlx::query_as(select_approved!("AND s.id = $1"));
        Ok(query.bind(id).fetch_optional(&self.pool).await?)
    }

    /// The revision that was approved last of all specifications' approved revisions.
    ///
    /// # Errors
    ///
    /// When the database fails.
    pub async fn latest_approved(&self) -> Result<Option<ApprovedRow>, StoreError> {
        let query = sqlx::query_as(select_approved!("ORDER BY a.sequence DESC LIMIT 1"));
        Ok(query.fetch_optional(&self.pool).await?)
    }

    /// The approval that held at a time: the last entry, in the journal's order, of those recorded at `at_ms` or before,
    /// unless it revoked. Where the clock went back, the later entry counts.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`] when there is no such specification; when the database fails.
    pub async fn approved_at(&self, id: &str, at_ms: i64) -> Result<Option<ApprovalRow>, StoreError> {
        self.specification(id).await?;
        let query = sqlx::query_as(select!("at_ms <= $2 ORDER BY sequence DESC LIMIT 1"));
        let last: Option<ApprovalRow> = query.bind(id).bind(at_ms).fetch_optional(&self.pool).await?;
        Ok(last.filter(|entry| entry.kind == ApprovalKind::Approved))
    }
}

/// Makes `revision` the approved one where `expected`, another, was; 0 is none. Were it allowed to stay the same, two who
/// know the same state could both win.
async fn move_approved(
    writing: &mut Writing,
    id: &str,
    expected: i64,
    revision: u64,
) -> Result<(), StoreError> {
    let moved = sqlx::query(
        "UPDATE specifications SET approved = $1 \
         WHERE id = $2 AND approved = $3 AND approved <> $1 AND deleted = 0",
    )
    .bind(stored_number(revision))
    .bind(id)
    .bind(expected)
    .execute(writing.connection())
    .await?;
    if moved.rows_affected() > 0 {
        return Ok(());
    }
    if select_specification(writing, id).await?.is_none() {
        return Err(StoreError::not_found("specification", id));
    }
    let last = sqlx::query_as::<Any, ApprovalRow>(select!("sequence > 0 ORDER BY sequence DESC LIMIT 1"));
    let last = last.bind(id).fetch_optional(writing.connection()).await?;
    Err(Conflict::Approved(last).into())
}

/// An entry that has no number yet.
fn entry(specification: String, revision: u64, sha256: String, signature: Signature) -> ApprovalRow {
    let Signature { who, token, meaning, comment, at_ms } = signature;
    let kind = ApprovalKind::Approved;
    ApprovalRow { sequence: 0, specification, revision, kind, sha256, who, token, meaning, comment, at_ms }
}

/// Adds an entry and returns it with its number.
async fn insert_approval(writing: &mut Writing, entry: ApprovalRow) -> Result<ApprovalRow, StoreError> {
    let sequence = writing.next_sequence().await?;
    sqlx::query(
        "INSERT INTO approvals \
         (sequence, specification, revision, kind, sha256, who, token, meaning, comment, at_ms) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10)",
    )
    .bind(sequence)
    .bind(&entry.specification)
    .bind(stored_number(entry.revision))
    .bind(entry.kind.name())
    .bind(&entry.sha256)
    .bind(&entry.who)
    .bind(&entry.token)
    .bind(&entry.meaning)
    .bind(&entry.comment)
    .bind(entry.at_ms)
    .execute(writing.connection())
    .await?;
    Ok(ApprovalRow { sequence: sequence.unsigned_abs(), ..entry })
}

fn refuse_unstorable(signature: &Signature) -> Result<(), StoreError> {
    refuse_nul(&[
        ("the name", &signature.who),
        ("the meaning", &signature.meaning),
        ("the comment", &signature.comment),
    ])
}
