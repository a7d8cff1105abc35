//! What a person can ask of the server.

use std::sync::Arc;

use goalgraph::layout::Layout;
use goalgraph::protocol::api::{Decision, Revision, Signature};

use crate::page::model::{KeepDialog, Lineage, Queued};

/// What a gesture means for what is kept.
#[derive(Clone, Debug)]
pub(crate) enum KeepAction {
    /// Save the work, with a message.
    Save(String),
    /// Keep the work as a new specification.
    Copy,
    /// Send again what the server has not taken.
    Retry,
    /// Show a dialog.
    Ask(KeepDialog),
    /// Open a revision of a specification, or the last one.
    Open(String, Option<u64>),
    /// Show what differs between two revisions of the work.
    Compare(u64, u64),
    /// Show what is to be signed: a revision of the work, by this dialog.
    Prepare(u64, KeepDialog),
    /// Sign it.
    Sign {
        /// Its number.
        revision: u64,
        /// What is decided.
        decision: Decision,
        /// The signature.
        signature: Signature,
    },
    /// Answer when somebody else has saved meanwhile.
    Choose(Choice),
    /// Copy the address of a revision.
    CopyLink(u64),
    /// Take the specification off the server.
    Delete,
    /// Show the server a token.
    LogIn(String),
    /// Save and sign under this name.
    Author(String),
    /// Open what the address of the page names.
    Follow,
    /// Point out a part of a difference.
    Point(Option<String>),
    /// Take a placement of what differs.
    Placed(u32, Option<Arc<Layout>>),
    /// Take what the work was on the server, and what was still to be saved.
    PutBack(Vec<Lineage>, Option<Queued>),
    /// The work of the last visit is back.
    Restored,
}

/// The ways out when somebody else has saved meanwhile.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Choice {
    /// See what differs.
    See(Revision),
    /// Keep the own work as a specification of its own.
    KeepMine,
    /// Take theirs, as a step that can be undone.
    TakeTheirs(Revision),
}
