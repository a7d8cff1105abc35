//! The JSON below `/api/v1`. Times are RFC 3339, by the server's clock; nothing is ordered by them.

use serde::{Deserialize, Serialize};
use serde_json::Value;

pub use super::role::{Role, UnknownRole};

/// A part of a list.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct Page<T> {
    /// This part.
    pub items: Vec<T>,
    /// What to give as `after` for the next part; none when this was the last.
    pub next: Option<String>,
}

/// A specification that the server keeps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct SpecificationEntry {
    /// Its id.
    pub id: String,
    /// What it is called.
    pub name: String,
    /// The last revision.
    pub head: Revision,
    /// Number of the approved revision; none when nothing is approved.
    pub approved: Option<u64>,
}

/// A revision of a specification: it never changes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct Revision {
    /// Its number: 1, 2, 3..
    pub number: u64,
    /// What the specification is called in it.
    pub name: String,
    /// SHA-256 of the specification's canonical bytes, hexadecimal.
    pub sha256: String,
    /// Who saved it.
    pub author: String,
    /// What the author said about it.
    pub message: String,
    /// When it was saved.
    pub saved_at: String,
}

/// A revision with what is in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct RevisionContent {
    /// The revision.
    pub revision: Revision,
    /// The specification file (`*.goalgraph.json`), byte for byte, as text.
    pub content: String,
    /// Where states were put by hand; of the page that saved it, not part of what is approved.
    #[cfg_attr(feature = "openapi", schema(value_type = Option<Object>))]
    pub positions: Option<Value>,
}

/// What is saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Save {
    /// The specification file (`*.goalgraph.json`) as text. It is kept in its canonical form.
    pub content: String,
    /// Who saves it. A token's name is taken instead where tokens are needed.
    #[serde(default)]
    pub author: Option<String>,
    /// What there is to say about it.
    #[serde(default)]
    pub message: String,
    /// Where states were put by hand.
    #[serde(default)]
    #[cfg_attr(feature = "openapi", schema(value_type = Option<Object>))]
    pub positions: Option<Value>,
}

/// A signature under a revision.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Signature {
    /// Printed name of who signs. A token's name is taken instead where tokens are needed.
    #[serde(default)]
    pub who: Option<String>,
    /// What the signature means, such as `approved for production`.
    pub meaning: String,
    /// What there is to say about it.
    #[serde(default)]
    pub comment: String,
    /// SHA-256 of the revision that was looked at.
    pub sha256: String,
    /// Number of the revision that was approved when the signer looked; none when nothing was.
    pub instead_of: Option<u64>,
}

/// What an entry of the approval journal says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Decision {
    /// The revision is approved from here on, and no other.
    Approved,
    /// The revision is not approved from here on.
    Revoked,
}

/// An entry of the approval journal: it never changes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct Approval {
    /// Its place in the journal of the server: 1, 2, 3..
    pub sequence: u64,
    /// Number of the revision.
    pub revision: u64,
    /// SHA-256 of the revision.
    pub sha256: String,
    /// What was decided.
    pub decision: Decision,
    /// Printed name of who signed.
    pub who: String,
    /// What the signature means.
    pub meaning: String,
    /// What there was to say about it.
    pub comment: String,
    /// When.
    pub at: String,
}

/// A demonstration file that the server keeps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct DemonstrationFile {
    /// SHA-256 of its bytes, hexadecimal: its identity.
    pub sha256: String,
    /// What it was called.
    pub name: String,
    /// How many bytes it has.
    pub bytes: u64,
}

/// An event of a run as it was stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct StoredEvent {
    /// Its number in the run: 1, 2, 3..
    pub number: u64,
    /// When it was stored.
    pub stored_at: String,
    /// When it happened by the executor's clock, if it said.
    pub happened_at: Option<String>,
    /// What happened.
    #[cfg_attr(feature = "openapi", schema(value_type = Object))]
    pub happened: crate::run::RunEvent,
}

/// Who asks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct Session {
    /// Name of the token; none where no token is needed.
    pub name: Option<String>,
    /// What may be done.
    pub role: Role,
    /// Whether this server asks for tokens.
    pub tokens_needed: bool,
}

/// A way in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Login {
    /// The token.
    pub token: String,
}

/// What an executor is told to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct CommandRequest {
    /// What.
    pub command: super::executor::Command,
}

/// Why a request was not done (RFC 9457).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct Problem {
    /// Which kind of problem, as a path that does not change, such as `/problems/changed-meanwhile`.
    #[serde(rename = "type")]
    pub kind: String,
    /// The kind in a few words.
    pub title: String,
    /// The HTTP status.
    pub status: u16,
    /// One sentence: what, where, what was expected.
    pub detail: String,
    /// What was saved meanwhile, when that is the problem.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub head: Option<Revision>,
    /// Number of the revision that is approved, when that is the problem.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub approved: Option<u64>,
    /// What is wrong with the specification, when that is the problem.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<String>,
}
