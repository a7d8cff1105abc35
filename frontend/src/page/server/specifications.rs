//! Specifications and their revisions.

use gloo_net::http::Request;
use goalgraph::protocol::api::{Revision, RevisionContent, Save, SpecificationEntry};

use super::ROOT;
use super::answer::{Failure, Tagged, all, ask, escaped, read, send};

fn address(id: &str) -> String {
    format!("{ROOT}/specifications/{}", escaped(id))
}

/// All specifications, the one saved last first.
pub(crate) async fn specifications() -> Result<Vec<SpecificationEntry>, Failure> {
    all(&format!("{ROOT}/specifications")).await
}

/// One of them, with the tag of its last revision.
pub(crate) async fn specification(id: &str) -> Result<Tagged<SpecificationEntry>, Failure> {
    read(ask(Request::get(&address(id))).await?).await
}

/// Keeps a new specification.
pub(crate) async fn create(save: &Save) -> Result<Tagged<SpecificationEntry>, Failure> {
    read(send(Request::post(&format!("{ROOT}/specifications")).json(save)).await?).await
}

/// Saves a revision on top of the one with the tag `etag`.
pub(crate) async fn save(id: &str, etag: &str, save: &Save) -> Result<Tagged<SpecificationEntry>, Failure> {
    read(send(Request::put(&address(id)).header("If-Match", etag).json(save)).await?).await
}

/// Takes a specification off the server.
pub(crate) async fn delete(id: &str, etag: &str) -> Result<(), Failure> {
    ask(Request::delete(&address(id)).header("If-Match", etag)).await.map(drop)
}

/// Its revisions, newest first.
pub(crate) async fn revisions(id: &str) -> Result<Vec<Revision>, Failure> {
    all(&format!("{}/revisions", address(id))).await
}

/// One of them with its content.
pub(crate) async fn revision(id: &str, number: u64) -> Result<Tagged<RevisionContent>, Failure> {
    read(ask(Request::get(&format!("{}/revisions/{number}", address(id)))).await?).await
}
