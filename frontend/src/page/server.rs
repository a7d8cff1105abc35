//! The server's HTTP API, as the page asks it. Nothing here knows the state of the page.

mod answer;
mod approvals;
mod demonstrations;
mod runs;
mod session;
mod specifications;

pub(crate) use answer::{Failure, Tagged};
pub(crate) use approvals::{approvals, sign};
pub(crate) use demonstrations::{
    demonstration, link_demonstration, linked_demonstrations, put_demonstration,
};
pub(crate) use runs::{events, order, runs};
pub(crate) use session::{log_in, session};
pub(crate) use specifications::{create, delete, revision, revisions, save, specification, specifications};

/// Where the API is.
const ROOT: &str = "/api/v1";
