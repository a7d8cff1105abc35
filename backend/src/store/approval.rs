//! What is signed: approvals and revocations of revisions.

use std::fmt;

use sqlx::FromRow;

use super::StoreError;

/// Who says it, and what they say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// Name of the person.
    pub who: String,
    /// Id of the token that they showed, if one was needed.
    pub token: Option<String>,
    /// What the signature stands for, such as `approved for the robot`.
    pub meaning: String,
    /// Free text.
    pub comment: String,
    /// When, in milliseconds since 1970.
    pub at_ms: i64,
}

/// An approval to enter in the journal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewApproval {
    /// Number of the revision to approve.
    pub revision: u64,
    /// SHA-256 of the content that the approver looked at.
    pub sha256_seen: String,
    /// Number of the revision that they saw approved, if one was.
    pub expected_approved: Option<u64>,
    /// Who approves.
    pub signature: Signature,
}

/// What an entry of the journal does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ApprovalKind {
    /// From here on this revision is the approved one, and no other.
    Approved,
    /// From here on no revision is approved.
    Revoked,
}

/// An entry of the journal.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct ApprovalRow {
    /// Number in the order of the whole server; it grows, with gaps.
    #[sqlx(try_from = "i64")]
    pub sequence: u64,
    /// Id of the specification.
    pub specification: String,
    /// Number of the revision.
    #[sqlx(try_from = "i64")]
    pub revision: u64,
    /// What the entry does.
    #[sqlx(try_from = "String")]
    pub kind: ApprovalKind,
    /// SHA-256 of the revision's content.
    pub sha256: String,
    /// Name of the person.
    pub who: String,
    /// Id of the token that they showed.
    pub token: Option<String>,
    /// What the signature stands for.
    pub meaning: String,
    /// Free text.
    pub comment: String,
    /// When, in milliseconds since 1970.
    pub at_ms: i64,
}

/// The approved revision of a specification.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct ApprovedRow {
    /// Id of the specification.
    pub specification: String,
    /// Name of the specification in this revision.
    pub name: String,
    /// Number of the revision.
    #[sqlx(try_from = "i64")]
    pub revision: u64,
    /// SHA-256 of its content.
    pub sha256: String,
    /// Number of the approval in the journal of the whole server: a later approval has a larger one.
    #[sqlx(try_from = "i64")]
    pub sequence: u64,
    /// Who approved it.
    pub who: String,
    /// When, in milliseconds since 1970.
    pub at_ms: i64,
}

impl ApprovalRow {
    /// Number of the revision that is approved by this entry; none when it revokes.
    pub fn approves(&self) -> Option<u64> {
        (self.kind == ApprovalKind::Approved).then_some(self.revision)
    }
}

impl ApprovalKind {
    /// Its name in the database.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Approved => "approved",
            Self::Revoked => "revoked",
        }
    }
}

impl fmt::Display for ApprovalKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl TryFrom<String> for ApprovalKind {
    type Error = StoreError;

    fn try_from(name: String) -> Result<Self, StoreError> {
        let known = [Self::Approved, Self::Revoked].into_iter().find(|it| it.name() == name);
        known.ok_or_else(|| StoreError::Corrupt(format!("the journal of approvals has the kind {name:?}")))
    }
}
