//! Revisions of a specification: they never change.

use axum::Json;
use axum::extract::State;
use axum::http::header::CONTENT_TYPE;
use axum::response::IntoResponse;
use goalgraph::protocol::api::{Page, Revision, RevisionContent};

use super::extract::{PathParts, QueryParts};
use super::list::ListQuery;
use super::problem::{ApiError, ApiResult};
use super::{Api, entries};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The addresses of this module.
pub(super) fn routes() -> OpenApiRouter<Api> {
    OpenApiRouter::new()
        .routes(routes!(list_revisions))
        .routes(routes!(read_revision))
        .routes(routes!(read_specification_file))
}

/// The revisions of a specification, newest first.
#[utoipa::path(get, path = "/specifications/{id}/revisions", tag = "revisions",
    params(("id" = String, Path), ListQuery), responses((status = 200, body = Page<Revision>)))]
async fn list_revisions(
    State(api): State<Api>,
    PathParts(id): PathParts<String>,
    QueryParts(query): QueryParts<ListQuery>,
) -> ApiResult<Json<Page<Revision>>> {
    let rows = api.store.revisions(&id, &query.request()).await?;
    Ok(Json(entries::page(rows, entries::revision)))
}

/// A revision with its content.
#[utoipa::path(get, path = "/specifications/{id}/revisions/{number}", tag = "revisions",
    params(("id" = String, Path), ("number" = u64, Path)),
    responses((status = 200, body = RevisionContent, headers(("ETag" = String)))))]
async fn read_revision(
    State(api): State<Api>,
    PathParts((id, number)): PathParts<(String, u64)>,
) -> ApiResult<impl IntoResponse> {
    let row = api.store.revision(&id, number).await?;
    let content = api.store.content(&id, number).await?;
    let parse = |text: &String| serde_json::from_str(text);
    let positions =
        row.positions.as_ref().map(parse).transpose().map_err(|error| ApiError::broken(&error))?;
    let body = RevisionContent { revision: entries::revision(&row), content, positions };
    Ok((entries::etag_header(row.number, &row.sha256), Json(body)))
}

/// The specification file of a revision, byte for byte: what is hashed, approved and relayed.
#[utoipa::path(get, path = "/specifications/{id}/revisions/{number}/specification", tag = "revisions",
    params(("id" = String, Path), ("number" = u64, Path)),
    responses((status = 200, body = Object, content_type = "application/json", headers(("ETag" = String)))))]
async fn read_specification_file(
    State(api): State<Api>,
    PathParts((id, number)): PathParts<(String, u64)>,
) -> ApiResult<impl IntoResponse> {
    let row = api.store.revision(&id, number).await?;
    let content = api.store.content(&id, number).await?;
    Ok((entries::etag_header(row.number, &row.sha256), [(CONTENT_TYPE, "application/json")], content))
}
