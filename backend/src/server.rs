//! The server, in reading order: what there is to serve, how one file is answered, what every answer carries.

mod assets;
mod caching;
mod content_security;
mod pages;

use axum::extract::State;
use axum::http::header::{CONTENT_SECURITY_POLICY, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS};
use axum::http::{HeaderMap, HeaderValue, StatusCode, Uri};
use axum::middleware::map_response;
use axum::response::{IntoResponse, Response};
use axum::routing::{any, get};
use axum::{Json, Router};
use serde::Serialize;

pub use assets::{Asset, Assets, embedded};

/// Everything that the server answers, with `assets` as the files of the app.
///
/// Every answer carries a strict content security policy. Nothing is read but what `assets` hands out.
pub fn app(assets: Assets) -> Router {
    Router::new()
        .route("/api/v1/health", get(health))
        .route("/api/{*path}", any(unknown_api))
        .fallback(get(file))
        .layer(map_response(with_security_headers))
        .with_state(assets)
}

/// The answer of `GET /api/v1/health`.
#[derive(Serialize)]
struct Health {
    status: &'static str,
    version: &'static str,
}

async fn health() -> Response {
    Json(Health { status: "ok", version: env!("CARGO_PKG_VERSION") }).into_response()
}

/// What a call to an address below `/api` is told that is not there.
#[derive(Serialize)]
struct ApiError {
    error: &'static str,
}

async fn unknown_api() -> Response {
    (StatusCode::NOT_FOUND, Json(ApiError { error: "there is nothing at this address" })).into_response()
}

async fn file(State(assets): State<Assets>, uri: Uri, headers: HeaderMap) -> Response {
    let path = match uri.path().trim_start_matches('/') {
        "" => "index.html",
        path => path,
    };
    match assets::answer(assets, path, &headers) {
        Some(response) => response,
        None if path == "index.html" => pages::not_built(),
        None => pages::not_found(),
    }
}

/// Adds what every answer must carry.
async fn with_security_headers(mut response: Response) -> Response {
    let headers = response.headers_mut();
    headers.insert(CONTENT_SECURITY_POLICY, content_security::POLICY);
    headers.insert(X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
    response
}
