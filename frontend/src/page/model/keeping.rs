//! What the page knows of the server that keeps specifications, and what of it the work is.

use std::collections::BTreeMap;
use std::sync::Arc;

use goalgraph::layout::Layout;
use goalgraph::protocol::api::{Approval, Problem, Revision, Save, Session, SpecificationEntry};
use goalgraph::specification::Specification;
use leptos::prelude::*;
use serde::{Deserialize, Serialize};

use crate::page::links::Link;

/// What is known of the server.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Server {
    /// It was asked and has not answered yet.
    #[default]
    Asking,
    /// There is none: the page comes from somewhere that only hands out files.
    Absent,
    /// It asks for a token.
    Locked,
    /// It is there, and this is who asks.
    Present(Session),
}

/// A revision that the work is made from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Kept {
    /// The specification's id on the server.
    pub(crate) id: String,
    /// The revision's number.
    pub(crate) revision: u64,
    /// What the server tells it by when something is saved on top of it.
    pub(crate) etag: String,
    /// SHA-256 of its content.
    pub(crate) sha256: String,
    /// Number of the approved revision, when last heard.
    pub(crate) approved: Option<u64>,
}

/// The work is a specification of the server from a place in the history on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Lineage {
    /// The place.
    pub(crate) from: usize,
    /// What it is there.
    pub(crate) kept: Kept,
    /// Places in the history that are revisions, by number.
    pub(crate) revisions: BTreeMap<usize, u64>,
}

/// A save that the server has not taken yet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Queued {
    /// The revision on top of which it goes; none for a new specification.
    pub(crate) onto: Option<Onto>,
    /// What is saved.
    pub(crate) save: Save,
    /// Its place in the history.
    pub(crate) position: usize,
}

/// A revision to save on top of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Onto {
    /// The specification.
    pub(crate) id: String,
    /// What the server tells the revision by.
    pub(crate) etag: String,
}

/// Something that the server was asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Loading<T> {
    /// It has not answered yet.
    #[default]
    Waiting,
    /// It is here.
    Here(T),
    /// It is not, for this reason.
    Failed(String),
}

impl<T> Loading<T> {
    /// What is here.
    pub(crate) fn here(&self) -> Option<&T> {
        match self {
            Self::Here(it) => Some(it),
            Self::Waiting | Self::Failed(_) => None,
        }
    }
}

/// One of two specifications that are compared.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Compared {
    /// What it is called: `r7`, `your work`.
    pub(crate) name: String,
    /// What it says.
    pub(crate) specification: Arc<Specification>,
}

/// A revision that is to be signed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Signing {
    /// It.
    pub(crate) revision: Revision,
    /// What it says.
    pub(crate) specification: Arc<Specification>,
    /// Number of the revision that is approved.
    pub(crate) approved: Option<u64>,
}

/// What is asked or shown over the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum KeepDialog {
    /// A token.
    Login,
    /// What there is to say about a save.
    Message,
    /// The specifications of the server.
    Open,
    /// The revisions of the work, and its approvals.
    Revisions,
    /// A signature under a revision.
    Approve,
    /// A signature that takes an approval back.
    Revoke,
    /// Somebody else saved meanwhile.
    Conflict,
    /// What differs between two revisions.
    Difference,
    /// Whether the specification is to go from the server.
    Delete,
}

/// All of it.
#[derive(Default)]
pub(crate) struct Keeping {
    /// What is known of the server.
    pub(crate) server: RwSignal<Server>,
    /// Whether it did not answer when it was asked last.
    pub(crate) offline: RwSignal<bool>,
    /// Whether the work of the last visit is back, or there was none.
    pub(crate) restored: RwSignal<bool>,
    /// What of the server the work is, by places in the history, in their order.
    pub(crate) lineages: RwSignal<Vec<Lineage>>,
    /// The specification that the work is, as the server had it last.
    pub(crate) entry: RwSignal<Option<SpecificationEntry>>,
    /// What is still to be saved.
    pub(crate) queued: RwSignal<Option<Queued>>,
    /// How often in a row the server did not answer.
    pub(crate) attempts: RwSignal<u32>,
    /// Whether it is asked again after a while.
    pub(crate) asks_again: RwSignal<bool>,
    /// Whether a save is under way.
    pub(crate) saving: RwSignal<bool>,
    /// How many recordings are at the server, of how many.
    pub(crate) uploading: RwSignal<Option<(usize, usize)>>,
    /// A link that is to be followed.
    pub(crate) link: RwSignal<Option<Link>>,
    /// Printed name of who saves and signs.
    pub(crate) author: RwSignal<String>,
    /// The specifications of the server.
    pub(crate) entries: RwSignal<Loading<Vec<SpecificationEntry>>>,
    /// The revisions of the work, newest first.
    pub(crate) revisions: RwSignal<Loading<Vec<Revision>>>,
    /// Its approvals, newest first.
    pub(crate) approvals: RwSignal<Loading<Vec<Approval>>>,
    /// What is to be signed.
    pub(crate) signing: RwSignal<Loading<Signing>>,
    /// Why the server did not take what the open dialog sent.
    pub(crate) refusal: RwSignal<Option<Problem>>,
    /// What somebody else saved meanwhile.
    pub(crate) conflict: RwSignal<Option<Revision>>,
    /// What is compared: before and after.
    pub(crate) compared: RwSignal<Loading<(Compared, Compared)>>,
    /// Where what differs is drawn, with the number of the request.
    pub(crate) placed: RwSignal<(u32, Option<Arc<Layout>>)>,
    /// The part of the difference that is pointed out.
    pub(crate) pointed: RwSignal<Option<String>>,
}
