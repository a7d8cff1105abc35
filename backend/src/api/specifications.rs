//! Specifications: listed, made, read, saved, deleted.

use axum::Json;
use axum::extract::State;
use axum::http::header::LOCATION;
use axum::http::{HeaderName, HeaderValue, StatusCode};
use axum::response::IntoResponse;
use goalgraph::protocol::api::{Page, Save, SpecificationEntry};
use goalgraph::specification::Specification;

use super::aside::aside;
use super::extract::{Body, IfMatch, PathParts, QueryParts};
use super::limits::{self, line, lines};
use super::list::ListQuery;
use super::problem::{ApiError, ApiResult};
use super::{Api, entries};
use crate::access::Caller;
use crate::clock;
use crate::store::{NewRevision, SpecificationRow};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The addresses of this module.
pub(super) fn routes() -> OpenApiRouter<Api> {
    OpenApiRouter::new().routes(routes!(list_specifications, create_specification)).routes(routes!(
        read_specification,
        save_specification,
        delete_specification
    ))
}

/// The specifications that the server keeps, the one saved last first.
#[utoipa::path(get, path = "/specifications", tag = "specifications", params(ListQuery),
    responses((status = 200, body = Page<SpecificationEntry>)))]
async fn list_specifications(
    State(api): State<Api>,
    QueryParts(query): QueryParts<ListQuery>,
) -> ApiResult<Json<Page<SpecificationEntry>>> {
    let rows = api.store.specifications(&query.request()).await?;
    Ok(Json(entries::page(rows, entries::specification)))
}

/// Keeps a new specification; what is sent is its revision 1.
#[utoipa::path(post, path = "/specifications", tag = "specifications", request_body = Save,
    responses((status = 201, body = SpecificationEntry, headers(("ETag" = String), ("Location" = String)))))]
async fn create_specification(
    State(api): State<Api>,
    caller: Caller,
    Body(save): Body<Save>,
) -> ApiResult<impl IntoResponse> {
    let row = api.store.create(new_revision(&caller, save).await?).await?;
    let location = HeaderValue::try_from(format!("/api/v1/specifications/{}", row.id))
        .map_err(|error| ApiError::broken(&error))?;
    let location: [(HeaderName, HeaderValue); 1] = [(LOCATION, location)];
    Ok((StatusCode::CREATED, location, answer(&row)))
}

/// One specification, as its last revision has it.
#[utoipa::path(get, path = "/specifications/{id}", tag = "specifications", params(("id" = String, Path)),
    responses((status = 200, body = SpecificationEntry, headers(("ETag" = String)))))]
async fn read_specification(
    State(api): State<Api>,
    PathParts(id): PathParts<String>,
) -> ApiResult<impl IntoResponse> {
    Ok(answer(&api.store.specification(&id).await?))
}

/// Saves a new revision on top of the one that `If-Match` names; 412 tells who saved what meanwhile.
#[utoipa::path(put, path = "/specifications/{id}", tag = "specifications", request_body = Save,
    params(("id" = String, Path), ("If-Match" = String, Header)),
    responses((status = 200, body = SpecificationEntry, headers(("ETag" = String)))))]
async fn save_specification(
    State(api): State<Api>,
    caller: Caller,
    PathParts(id): PathParts<String>,
    known: IfMatch,
    Body(save): Body<Save>,
) -> ApiResult<impl IntoResponse> {
    let head = known_head(&api, &id, &known).await?;
    let saved = api.store.save(&id, head, new_revision(&caller, save).await?).await?;
    // What is approved may have changed meanwhile; what was saved is what this answer is about.
    let approved = api.store.specification(&id).await.ok().and_then(|row| row.approved());
    let entry =
        SpecificationEntry { id, name: saved.name.clone(), head: entries::revision(&saved), approved };
    Ok((entries::etag_header(saved.number, &saved.sha256), Json(entry)))
}

/// Hides a specification. An approved one must be revoked before.
#[utoipa::path(delete, path = "/specifications/{id}", tag = "specifications",
    params(("id" = String, Path), ("If-Match" = String, Header)), responses((status = 204)))]
async fn delete_specification(
    State(api): State<Api>,
    PathParts(id): PathParts<String>,
    known: IfMatch,
) -> ApiResult<StatusCode> {
    let head = known_head(&api, &id, &known).await?;
    api.store.delete(&id, head).await?;
    Ok(StatusCode::NO_CONTENT)
}

fn answer(row: &SpecificationRow) -> impl IntoResponse + use<> {
    (entries::etag_header(row.head, &row.sha256), Json(entries::specification(row)))
}

/// Number of the head revision, when it is the one that the client knows.
async fn known_head(api: &Api, id: &str, known: &IfMatch) -> ApiResult<u64> {
    let row = api.store.specification(id).await?;
    if known.knows(&entries::etag(row.head, &row.sha256)) {
        return Ok(row.head);
    }
    Err(ApiError::changed(entries::specification(&row).head))
}

/// What is saved, in its canonical form.
async fn new_revision(caller: &Caller, save: Save) -> ApiResult<NewRevision> {
    let read = move || Specification::from_json(&save.content).map(|it| (it.to_json(), it.name));
    let (content, name) =
        aside(read).await?.map_err(|error| ApiError::invalid(format!("content: {error}")))?;
    if save.positions.as_ref().is_some_and(|positions| !positions.is_object()) {
        return Err(ApiError::invalid("positions: expected an object, or null"));
    }
    let author = caller.signs_as(save.author.as_deref()).unwrap_or("somebody").to_owned();
    Ok(NewRevision {
        content,
        name: line("name", &name, usize::MAX)?,
        author: line("author", &author, limits::NAME)?,
        message: lines("message", &save.message)?,
        saved_at_ms: clock::now_ms(),
        positions: save.positions.map(|positions| positions.to_string()),
    })
}
