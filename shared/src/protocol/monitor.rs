//! The WebSocket between the server and a page that watches executors and runs.
//!
//! The server speaks, the page listens. The snapshot comes first; after it only what has changed since, always as it is
//! now: what changes twice before the page could read is sent once.

use serde::{Deserialize, Serialize};

use crate::pdfa::{StateId, Symbol, Word};
use crate::run::{Departure, Phase, Run};

/// The WebSocket subprotocol, version included.
pub const SUBPROTOCOL: &str = "goalgraph.monitor.v1";

/// What the server says to a page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ToMonitor {
    /// Everything as it is now.
    Snapshot {
        /// The executors that are connected, or hold a run that is not over; by name.
        executors: Vec<ExecutorView>,
        /// The runs that are not over, and the last that are; newest first.
        runs: Vec<RunView>,
        /// What is approved; by specification.
        approved: Vec<ApprovedView>,
    },
    /// What has changed, as it is now.
    Changes {
        /// The executors that have changed.
        executors: Vec<ExecutorView>,
        /// The runs that have changed.
        runs: Vec<RunView>,
        /// The specifications whose approval has changed.
        approved: Vec<ApprovedView>,
    },
}

/// An executor as it is now.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct ExecutorView {
    /// Its name.
    pub executor: String,
    /// What software it is.
    pub software: Option<String>,
    /// Whether it is connected.
    pub connected: bool,
    /// What it was sent last.
    pub holds: Option<Held>,
    /// The run that it is in.
    pub run: Option<String>,
}

/// A specification at an executor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct Held {
    /// Id of the specification.
    pub specification: String,
    /// What it is called.
    pub name: String,
    /// Number of the revision.
    pub revision: u64,
    /// SHA-256 of the content.
    pub sha256: String,
    /// What the executor answered.
    pub answer: Answer,
}

/// What an executor answered to a specification.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(tag = "answer", rename_all = "snake_case")]
pub enum Answer {
    /// Nothing yet.
    Awaited,
    /// It will follow it.
    Accepted,
    /// It will not.
    Rejected {
        /// Why, for people.
        reason: String,
    },
}

/// A run as it is now.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct RunView {
    /// Id of the run.
    pub run: String,
    /// The executor that holds it, or held it last.
    pub executor: String,
    /// Id of the specification that it follows.
    pub specification: String,
    /// What the specification is called.
    pub name: String,
    /// Number of the revision that it follows.
    pub revision: u64,
    /// SHA-256 of that revision.
    pub sha256: String,
    /// How it stands.
    pub phase: Phase,
    /// Where it is; none once it has left the automaton.
    #[cfg_attr(feature = "openapi", schema(value_type = Option<String>))]
    pub state: Option<StateId>,
    /// The states passed, the first is the initial state.
    #[cfg_attr(feature = "openapi", schema(value_type = Vec<String>))]
    pub states: Vec<StateId>,
    /// The sub-goals completed, in order.
    #[cfg_attr(feature = "openapi", schema(value_type = Vec<String>))]
    pub trail: Word,
    /// The sub-goal that it works on.
    #[cfg_attr(feature = "openapi", schema(value_type = Option<String>))]
    pub active: Option<Symbol>,
    /// The sub-goals ahead.
    #[cfg_attr(feature = "openapi", schema(value_type = Vec<String>))]
    pub plan: Word,
    /// What is unavailable.
    #[cfg_attr(feature = "openapi", schema(value_type = Vec<String>))]
    pub unavailable: Vec<Symbol>,
    /// How often it planned anew.
    pub replans: u64,
    /// How many events it has.
    pub events: u64,
    /// How it left the automaton, if it did.
    #[cfg_attr(feature = "openapi", schema(value_type = Option<Object>))]
    pub departure: Option<Departure>,
    /// Natural logarithm of the probability of the transitions taken, at most 0.
    pub log_likelihood: f64,
    /// When it began, by the server's clock (RFC 3339).
    pub began_at: String,
    /// When its last event was stored, by the server's clock (RFC 3339).
    pub heard_at: String,
}

/// Which run a view is of: everything about it that its events do not tell.
#[derive(Clone, Debug, PartialEq)]
pub struct RunOrigin {
    /// Id of the run.
    pub run: String,
    /// The executor that holds it, or held it last.
    pub executor: String,
    /// Id of the specification that it follows.
    pub specification: String,
    /// What the specification is called.
    pub name: String,
    /// Number of the revision that it follows.
    pub revision: u64,
    /// SHA-256 of that revision.
    pub sha256: String,
    /// When it began, by the server's clock (RFC 3339).
    pub began_at: String,
}

impl RunView {
    /// The view of a run that was last heard of at `heard_at` (RFC 3339).
    pub fn new(origin: RunOrigin, run: &Run, heard_at: String) -> Self {
        Self {
            run: origin.run,
            executor: origin.executor,
            specification: origin.specification,
            name: origin.name,
            revision: origin.revision,
            sha256: origin.sha256,
            phase: run.phase,
            state: run.state,
            states: run.states.clone(),
            trail: run.trail.clone(),
            active: run.active,
            plan: run.plan.clone(),
            unavailable: run.unavailable.iter().copied().collect(),
            replans: run.replans,
            events: run.events,
            departure: run.departure,
            log_likelihood: run.log_likelihood,
            began_at: origin.began_at,
            heard_at,
        }
    }
}

/// What of a specification is approved now.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct ApprovedView {
    /// Id of the specification.
    pub specification: String,
    /// What it is called.
    pub name: String,
    /// Number of the approved revision; none when nothing is approved.
    pub revision: Option<u64>,
}
