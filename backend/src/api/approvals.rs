//! Approvals: who signed what, and which revision robots are given.

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use goalgraph::protocol::api::{Approval, Page, Signature};
use goalgraph::specification::Specification;
use serde::Deserialize;
use utoipa::IntoParams;

use super::aside::aside;
use super::extract::{Body, PathParts, QueryParts};
use super::limits::{self, line, lines};
use super::list::ListQuery;
use super::problem::{ApiError, ApiResult};
use super::{Api, entries};
use crate::access::Caller;
use crate::clock;
use crate::store::{self, NewApproval};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The addresses of this module.
pub(super) fn routes() -> OpenApiRouter<Api> {
    OpenApiRouter::new()
        .routes(routes!(approve_revision))
        .routes(routes!(revoke_revision))
        .routes(routes!(list_approvals))
        .routes(routes!(read_approved))
}

/// Approves a revision: from here on it is what robots are given. Refused while it has an error.
#[utoipa::path(post, path = "/specifications/{id}/revisions/{number}/approval", tag = "approvals",
    request_body = Signature, params(("id" = String, Path), ("number" = u64, Path)),
    responses((status = 201, body = Approval)))]
async fn approve_revision(
    State(api): State<Api>,
    caller: Caller,
    PathParts((id, number)): PathParts<(String, u64)>,
    Body(signature): Body<Signature>,
) -> ApiResult<(StatusCode, Json<Approval>)> {
    refuse_faulty(api.store.content(&id, number).await?).await?;
    let new = NewApproval {
        revision: number,
        sha256_seen: signature.sha256.clone(),
        expected_approved: signature.instead_of,
        signature: signed(&caller, &signature)?,
    };
    let row = whole(async move {
        let row = api.store.approve(&id, new).await?;
        tracing::info!(specification = id, revision = number, who = row.who, "approved");
        api.relay.approval_changed(&id).await;
        Ok(row)
    })
    .await?;
    Ok((StatusCode::CREATED, Json(entries::approval(&row))))
}

/// Takes an approval back: from here on robots are given nothing of this specification.
#[utoipa::path(post, path = "/specifications/{id}/revisions/{number}/revocation", tag = "approvals",
    request_body = Signature, params(("id" = String, Path), ("number" = u64, Path)),
    responses((status = 201, body = Approval)))]
async fn revoke_revision(
    State(api): State<Api>,
    caller: Caller,
    PathParts((id, number)): PathParts<(String, u64)>,
    Body(signature): Body<Signature>,
) -> ApiResult<(StatusCode, Json<Approval>)> {
    let signature = signed(&caller, &signature)?;
    let row = whole(async move {
        let row = api.store.revoke(&id, number, signature).await?;
        tracing::info!(specification = id, revision = number, who = row.who, "revoked");
        api.relay.approval_changed(&id).await;
        Ok(row)
    })
    .await?;
    Ok((StatusCode::CREATED, Json(entries::approval(&row))))
}

/// The approval journal of a specification, newest first.
#[utoipa::path(get, path = "/specifications/{id}/approvals", tag = "approvals",
    params(("id" = String, Path), ListQuery), responses((status = 200, body = Page<Approval>)))]
async fn list_approvals(
    State(api): State<Api>,
    PathParts(id): PathParts<String>,
    QueryParts(query): QueryParts<ListQuery>,
) -> ApiResult<Json<Page<Approval>>> {
    let rows = api.store.approvals(&id, &query.request()).await?;
    Ok(Json(entries::page(rows, entries::approval)))
}

/// When.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
struct At {
    /// A time (RFC 3339); left out for now.
    at: Option<String>,
}

/// What was approved at a time: the entry of the journal that held then.
#[utoipa::path(get, path = "/specifications/{id}/approved", tag = "approvals", params(("id" = String, Path), At),
    responses((status = 200, body = Approval)))]
async fn read_approved(
    State(api): State<Api>,
    PathParts(id): PathParts<String>,
    QueryParts(At { at }): QueryParts<At>,
) -> ApiResult<Json<Approval>> {
    let at_ms = match &at {
        None => i64::MAX,
        Some(text) => clock::milliseconds(text).ok_or_else(|| {
            ApiError::bad_request(format!("at: {text:?} is no time such as 2026-01-31T12:00:00Z"))
        })?,
    };
    let row = api.store.approved_at(&id, at_ms).await?;
    let row = row.ok_or_else(|| ApiError::not_found("nothing of this specification was approved then"))?;
    Ok(Json(entries::approval(&row)))
}

/// Does all of a task also when the client leaves in the middle: what is in the journal must reach the robots.
async fn whole<T: Send + 'static>(task: impl Future<Output = ApiResult<T>> + Send + 'static) -> ApiResult<T> {
    tokio::spawn(task).await.unwrap_or_else(|error| Err(ApiError::broken(&error)))
}

/// Refuses a specification that has errors.
async fn refuse_faulty(content: String) -> ApiResult<()> {
    let errors = move || Specification::from_json(&content).map(|specification| specification.errors());
    let errors = aside(errors).await?.map_err(|error| ApiError::broken(&error))?;
    let findings: Vec<String> =
        errors.iter().map(|problem| format!("{}: {}", problem.place(), problem.message)).collect();
    if findings.is_empty() { Ok(()) } else { Err(ApiError::faulty(findings)) }
}

fn signed(caller: &Caller, signature: &Signature) -> ApiResult<store::Signature> {
    let who = caller.signs_as(signature.who.as_deref()).unwrap_or_default();
    let who = line("who", who, limits::NAME)?;
    let meaning = line("meaning", &signature.meaning, limits::NAME)?;
    if who.is_empty() || meaning.is_empty() {
        return Err(ApiError::invalid("a signature needs a name (who) and a meaning"));
    }
    Ok(store::Signature {
        who,
        token: caller.token.clone(),
        meaning,
        comment: lines("comment", &signature.comment)?,
        at_ms: clock::now_ms(),
    })
}
