//! The WebSocket protocol `goalgraph.executor.v1`, between the server and an executor.
//!
//! Every message is one JSON object in one text frame. The executor speaks first ([`FromExecutor::Hello`]); the server
//! answers with [`ToExecutor::Welcome`] and the approved specification. docs/executor-protocol.md tells the whole of it.

mod transcript;

use serde::{Deserialize, Serialize};

use crate::run::RunEvent;
pub use transcript::Spoken;
#[cfg(feature = "schema")]
pub use transcript::json_schema;

/// The WebSocket subprotocol, version included.
pub const SUBPROTOCOL: &str = "goalgraph.executor.v1";

/// Longest message that the server takes, in bytes.
pub const MAX_MESSAGE_BYTES: usize = 256 * 1024;

/// Longest name of an executor, and longest id of a run, in characters.
pub const MAX_ID: usize = 100;

/// What an executor says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum FromExecutor {
    /// Who it is; the first message, once.
    Hello {
        /// Its name: the same each time it connects, other than that of every other executor.
        executor: String,
        /// What software it is, with its version, for people.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        software: Option<String>,
    },
    /// It will follow the specification with this SHA-256.
    Accepted {
        /// SHA-256 of the content as it was received, hexadecimal.
        sha256: String,
    },
    /// It will not follow the specification with this SHA-256.
    Rejected {
        /// The SHA-256 that the server named, whatever that of the content is.
        sha256: String,
        /// Why, for people.
        reason: String,
    },
    /// It wants to begin a run, or to go on with one after it was disconnected: asks for the run's lease.
    Begin {
        /// Id of the run, chosen by the executor, such as a UUID.
        run: String,
        /// SHA-256 of the specification that the run follows.
        sha256: String,
    },
    /// Something happened in a run whose lease it holds.
    Event {
        /// Id of the run.
        run: String,
        /// Number of the event within the run: 1, 2, 3..
        number: u64,
        /// Time by the executor's clock, in milliseconds since 1970; for people, nothing is ordered by it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at_ms: Option<i64>,
        /// What happened.
        happened: RunEvent,
    },
    /// It is still there. Keeps the leases that it holds.
    Heartbeat,
}

/// What the server says to an executor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum ToExecutor {
    /// The answer to the hello.
    Welcome {
        /// Send a heartbeat at least this often, in milliseconds.
        heartbeat_ms: u64,
        /// A lease ends when nothing was heard for this long, in milliseconds.
        lease_ms: u64,
        /// Longest message that the server takes, in bytes.
        max_message_bytes: u64,
    },
    /// The approved specification: after the welcome, and whenever another one is approved.
    Specification {
        /// Id of the specification.
        specification: String,
        /// Number of the approved revision.
        revision: u64,
        /// Place of its approval in the server's journal: what was approved later has a higher one.
        approval: u64,
        /// SHA-256 of the UTF-8 bytes of `content`, hexadecimal.
        sha256: String,
        /// The specification file (`*.goalgraph.json`), byte for byte.
        content: String,
    },
    /// Nothing is approved (any more): no new run may begin. A run under way goes on.
    Withdrawn,
    /// The lease of a run.
    Granted {
        /// Id of the run.
        run: String,
        /// Number of the run's last event that is stored; 0 for a new run. The executor goes on with the one after it.
        stored: u64,
    },
    /// No lease for this run.
    Denied {
        /// Id of the run.
        run: String,
        /// Why.
        reason: Denial,
        /// The same in a sentence, for people.
        message: String,
    },
    /// The events of the run up to this number are stored.
    Acknowledged {
        /// Id of the run.
        run: String,
        /// Number of the last event stored.
        number: u64,
    },
    /// What a person wants of the executor.
    Command {
        /// What.
        command: Command,
    },
    /// The answer to a heartbeat.
    Heartbeat,
    /// A message was not taken. Nothing of it was stored.
    Refused {
        /// Why.
        reason: Refusal,
        /// The same in a sentence, for people.
        message: String,
        /// Id of the run that it is about.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        run: Option<String>,
        /// Number of the event that the server expects next in that run.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        expected: Option<u64>,
    },
}

/// What a person wants of an executor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Command {
    /// Begin a run with the specification that it has accepted.
    Start,
    /// Pause the run before the next sub-goal.
    Pause,
    /// Go on after a pause.
    Resume,
    /// End the run.
    Stop,
}

/// Why a lease is not granted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Denial {
    /// Another executor holds it.
    Held,
    /// The specification is not the approved one (any more).
    Stale,
    /// The executor has not accepted the specification.
    NotAccepted,
    /// The run is over.
    Over,
    /// The run follows another specification.
    OtherSpecification,
    /// The id of the run is empty, too long or holds control characters.
    BadId,
}

/// Why a message is not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Refusal {
    /// It is no message of this protocol. The connection ends.
    Malformed,
    /// It came before the hello, or the hello came twice. The connection ends.
    OutOfTurn,
    /// The executor does not hold the lease of the run.
    NoLease,
    /// Events before it are missing.
    Gap,
    /// Another event with this number is stored.
    Conflict,
    /// The run is over.
    Over,
    /// It names a specification that was not sent.
    UnknownSpecification,
    /// More messages than the server takes in a second.
    TooMany,
    /// The server cannot store at the moment; send it again later.
    Unavailable,
}

/// Close codes of the connection beside those of RFC 6455.
pub mod close {
    /// Another connection of the same executor took the place of this one.
    pub const REPLACED: u16 = 4000;
    /// The token was revoked.
    pub const REVOKED: u16 = 4001;
    /// Nothing was heard for longer than a lease lasts.
    pub const SILENT: u16 = 4002;
    /// A message could not be understood, or came out of turn.
    pub const PROTOCOL: u16 = 4003;
}
