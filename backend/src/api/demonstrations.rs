//! Demonstration files, kept once each under their SHA-256.

use std::io;

use axum::Json;
use axum::body::Body;
use axum::extract::State;
use axum::http::header::{CONTENT_DISPOSITION, CONTENT_LENGTH, CONTENT_TYPE, ETAG};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::IntoResponse;
use futures_util::{StreamExt, TryStreamExt};
use goalgraph::protocol::api::{DemonstrationFile, Page};
use serde::Deserialize;
use tokio_util::io::ReaderStream;
use utoipa::IntoParams;

use super::extract::{PathParts, QueryParts};
use super::limits::{self, DEMONSTRATION_BYTES, line};
use super::problem::{ApiError, ApiResult};
use super::{Api, entries};
use crate::clock;
use crate::store::{NewDemonstration, StoreError};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The addresses of this module.
pub(super) fn routes() -> OpenApiRouter<Api> {
    OpenApiRouter::new()
        .routes(routes!(put_demonstration, read_demonstration))
        .routes(routes!(list_demonstrations))
        .routes(routes!(link_demonstration))
}

/// What a file is called.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
struct Named {
    /// Its name.
    name: String,
}

/// Keeps a file, whose SHA-256 must be the one in the address. 200 when it was there already.
#[utoipa::path(put, path = "/demonstrations/{sha256}", tag = "demonstrations",
    params(("sha256" = String, Path), Named), request_body(content = Vec<u8>, content_type = "application/octet-stream"),
    responses((status = 201, body = DemonstrationFile), (status = 200, body = DemonstrationFile)))]
async fn put_demonstration(
    State(api): State<Api>,
    PathParts(sha256): PathParts<String>,
    QueryParts(Named { name }): QueryParts<Named>,
    headers: HeaderMap,
    body: Body,
) -> ApiResult<(StatusCode, Json<DemonstrationFile>)> {
    let sha256 = digest(&sha256)?;
    match api.store.open_demonstration(&sha256).await {
        Ok((row, _)) => {
            // Browsers take an answer that comes before all of the body was read for a broken connection.
            drain(body).await?;
            return Ok((StatusCode::OK, Json(entries::demonstration(&row))));
        }
        // A file that is gone or damaged is stored again.
        Err(StoreError::NotFound { .. } | StoreError::Corrupt(_)) => {}
        Err(error) => return Err(error.into()),
    }
    let length = headers.get(CONTENT_LENGTH).and_then(|value| value.to_str().ok()?.parse::<u64>().ok());
    if length.is_some_and(|bytes| bytes > DEMONSTRATION_BYTES) {
        return Err(ApiError::too_large(DEMONSTRATION_BYTES));
    }
    let media_type = headers.get(CONTENT_TYPE).and_then(|value| value.to_str().ok());
    let new = NewDemonstration {
        name: line("name", &name, limits::NAME)?,
        media_type: line("content-type", media_type.unwrap_or("application/octet-stream"), limits::NAME)?,
        limit_bytes: DEMONSTRATION_BYTES,
        expected_sha256: Some(sha256),
        at_ms: clock::now_ms(),
    };
    let chunks = body.into_data_stream().map_err(io::Error::other);
    let row = api.store.put_demonstration(new, chunks).await?;
    Ok((StatusCode::CREATED, Json(entries::demonstration(&row))))
}

/// The bytes of a file.
#[utoipa::path(get, path = "/demonstrations/{sha256}", tag = "demonstrations", params(("sha256" = String, Path)),
    responses((status = 200, body = Vec<u8>, content_type = "application/octet-stream")))]
async fn read_demonstration(
    State(api): State<Api>,
    PathParts(sha256): PathParts<String>,
) -> ApiResult<impl IntoResponse> {
    let (row, file) = api.store.open_demonstration(&digest(&sha256)?).await?;
    let mut headers = HeaderMap::new();
    headers.insert(CONTENT_LENGTH, row.bytes.into());
    headers.insert(CONTENT_TYPE, HeaderValue::from_static("application/octet-stream"));
    // A file from elsewhere is never shown as a page of this server.
    headers.insert(CONTENT_DISPOSITION, HeaderValue::from_static("attachment"));
    if let Ok(tag) = HeaderValue::try_from(format!("\"{}\"", row.sha256)) {
        headers.insert(ETAG, tag);
    }
    Ok((headers, Body::from_stream(ReaderStream::new(file))))
}

/// The demonstration files of a specification.
#[utoipa::path(get, path = "/specifications/{id}/demonstrations", tag = "demonstrations",
    params(("id" = String, Path)), responses((status = 200, body = Page<DemonstrationFile>)))]
async fn list_demonstrations(
    State(api): State<Api>,
    PathParts(id): PathParts<String>,
) -> ApiResult<Json<Page<DemonstrationFile>>> {
    let rows = api.store.demonstrations_of(&id).await?;
    Ok(Json(Page { items: rows.iter().map(entries::linked).collect(), next: None }))
}

/// Says that a specification was learned from a file.
#[utoipa::path(put, path = "/specifications/{id}/demonstrations/{sha256}", tag = "demonstrations",
    params(("id" = String, Path), ("sha256" = String, Path), Named), responses((status = 204)))]
async fn link_demonstration(
    State(api): State<Api>,
    PathParts((id, sha256)): PathParts<(String, String)>,
    QueryParts(Named { name }): QueryParts<Named>,
) -> ApiResult<StatusCode> {
    let name = line("name", &name, limits::NAME)?;
    api.store.link_demonstration(&id, &digest(&sha256)?, &name).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Reads a body and forgets it.
async fn drain(body: Body) -> ApiResult<()> {
    let mut bytes = 0;
    let mut chunks = body.into_data_stream();
    while let Some(chunk) = chunks.next().await {
        bytes += chunk.map_err(|error| ApiError::bad_request(error.to_string()))?.len() as u64;
        if bytes > DEMONSTRATION_BYTES {
            return Err(ApiError::too_large(DEMONSTRATION_BYTES));
        }
    }
    Ok(())
}

/// The SHA-256 in an address, 64 lower-case hexadecimal digits.
fn digest(text: &str) -> ApiResult<String> {
    let is_digest = text.len() == 64 && text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'));
    if is_digest {
        return Ok(text.to_owned());
    }
    Err(ApiError::not_found("a file is named by its SHA-256: 64 lower-case hexadecimal digits"))
}
