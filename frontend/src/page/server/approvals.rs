//! Signatures under revisions.

use gloo_net::http::Request;
use goalgraph::protocol::api::{Approval, Decision, Signature};

use super::ROOT;
use super::answer::{Failure, all, escaped, read, send};

/// The approval journal of a specification, newest first.
pub(crate) async fn approvals(id: &str) -> Result<Vec<Approval>, Failure> {
    all(&format!("{ROOT}/specifications/{}/approvals", escaped(id))).await
}

/// Approves a revision, or takes its approval back.
pub(crate) async fn sign(
    id: &str,
    number: u64,
    decision: Decision,
    signature: &Signature,
) -> Result<Approval, Failure> {
    let what = match decision {
        Decision::Approved => "approval",
        Decision::Revoked => "revocation",
    };
    let address = format!("{ROOT}/specifications/{}/revisions/{number}/{what}", escaped(id));
    read(send(Request::post(&address).json(signature)).await?).await.map(|it| it.value)
}
