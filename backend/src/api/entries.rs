//! Rows of the store as the API shows them.

use axum::http::HeaderValue;
use axum::http::header::ETAG;
use goalgraph::protocol::api::{Approval, Decision, DemonstrationFile, Page, Revision, SpecificationEntry};

use crate::clock::rfc3339;
use crate::store::{
    self, ApprovalKind, ApprovalRow, DemonstrationRow, LinkedDemonstration, RevisionRow, SpecificationRow,
};

/// A page of rows, each turned by `entry`.
pub(super) fn page<R, E>(rows: store::Page<R>, entry: impl Fn(&R) -> E) -> Page<E> {
    Page { items: rows.rows.iter().map(entry).collect(), next: rows.next }
}

/// A specification.
pub(super) fn specification(row: &SpecificationRow) -> SpecificationEntry {
    let head = Revision {
        number: row.head,
        name: row.name.clone(),
        sha256: row.sha256.clone(),
        author: row.author.clone(),
        message: row.message.clone(),
        saved_at: rfc3339(row.saved_at_ms),
    };
    SpecificationEntry { id: row.id.clone(), name: row.name.clone(), head, approved: row.approved() }
}

/// A revision.
pub(super) fn revision(row: &RevisionRow) -> Revision {
    Revision {
        number: row.number,
        name: row.name.clone(),
        sha256: row.sha256.clone(),
        author: row.author.clone(),
        message: row.message.clone(),
        saved_at: rfc3339(row.saved_at_ms),
    }
}

/// An entry of the approval journal.
pub(super) fn approval(row: &ApprovalRow) -> Approval {
    Approval {
        sequence: row.sequence,
        revision: row.revision,
        sha256: row.sha256.clone(),
        decision: match row.kind {
            ApprovalKind::Approved => Decision::Approved,
            ApprovalKind::Revoked => Decision::Revoked,
        },
        who: row.who.clone(),
        meaning: row.meaning.clone(),
        comment: row.comment.clone(),
        at: rfc3339(row.at_ms),
    }
}

/// A demonstration file.
pub(super) fn demonstration(row: &DemonstrationRow) -> DemonstrationFile {
    DemonstrationFile { sha256: row.sha256.clone(), name: row.name.clone(), bytes: row.bytes }
}

/// A demonstration file as a specification knows it.
pub(super) fn linked(row: &LinkedDemonstration) -> DemonstrationFile {
    DemonstrationFile { sha256: row.sha256.clone(), name: row.name.clone(), bytes: row.bytes }
}

/// The entity tag of a revision.
pub(super) fn etag(number: u64, sha256: &str) -> String {
    format!("\"r{number}-{}\"", sha256.get(..16).unwrap_or(sha256))
}

/// The header with the entity tag of a revision.
pub(super) fn etag_header(number: u64, sha256: &str) -> [(axum::http::HeaderName, HeaderValue); 1] {
    let tag = HeaderValue::try_from(etag(number, sha256)).unwrap_or(HeaderValue::from_static("\"\""));
    [(ETAG, tag)]
}
