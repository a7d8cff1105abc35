//! The server, in reading order: what there is to serve, how one file is answered, what every answer carries, what is
//! counted, how connections are taken.

mod assets;
mod caching;
mod content_security;
mod listener;
mod metrics;
mod pages;

use std::sync::Arc;
use std::time::Duration;

use axum::extract::State;
use axum::http::header::{
    CONTENT_SECURITY_POLICY, REFERRER_POLICY, STRICT_TRANSPORT_SECURITY, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Request, Uri};
use axum::middleware::{from_fn_with_state, map_response_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use axum::{Router, body::Body};
use tower::ServiceBuilder;
use tower_http::ServiceBuilderExt;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::request_id::{MakeRequestUuid, RequestId};
use tower_http::timeout::RequestBodyTimeoutLayer;
use tower_http::trace::{DefaultOnResponse, TraceLayer};
use tracing::{Level, Span};

use crate::access::guard;
use crate::api::{self, Api, ApiError};
use metrics::Metrics;

pub use assets::{Asset, Assets, embedded};
pub use listener::{BindError, Listening, Tls};

const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");
/// For so long browsers ask by https only, once they did.
const HTTPS_ONLY: HeaderValue = HeaderValue::from_static("max-age=31536000");
/// How long a client may take between two pieces of a body.
const BODY_PATIENCE: Duration = Duration::from_secs(30);
/// How long answers that are under way may take once the server is told to stop.
pub const PATIENCE: Duration = Duration::from_secs(3);

/// Everything that the server answers, with `assets` as the files of the app.
///
/// Every request passes the guard first; every answer carries a strict content security policy. The address of the other
/// end is expected as [`axum::extract::ConnectInfo`].
pub fn app(assets: Assets, api: Api) -> Router {
    let metrics = Arc::new(Metrics::new());
    let numbers = get(metrics::read).with_state((Arc::clone(&metrics), api.relay.clone()));
    let access = Arc::clone(&api.access);
    let https = access.settings.https;
    let around = ServiceBuilder::new()
        .set_request_id(REQUEST_ID, MakeRequestUuid)
        .layer(
            TraceLayer::new_for_http()
                .make_span_with(span)
                .on_response(DefaultOnResponse::new().level(Level::DEBUG)),
        )
        .propagate_request_id(REQUEST_ID);
    api::router(api)
        .layer(CompressionLayer::new())
        .route("/metrics", numbers)
        .fallback(get(file).with_state(assets))
        .layer(RequestBodyTimeoutLayer::new(BODY_PATIENCE))
        .layer(from_fn_with_state(access, guard))
        .layer(CatchPanicLayer::custom(|_| ApiError::broken(&"a handler panicked").into_response()))
        .layer(from_fn_with_state(metrics, metrics::count))
        .layer(map_response_with_state(https, with_security_headers))
        .layer(around)
}

/// What a line of the log says of a request: neither query nor headers, which may hold secrets.
fn span(request: &Request<Body>) -> Span {
    let id = request.extensions().get::<RequestId>().and_then(|id| id.header_value().to_str().ok());
    tracing::info_span!("request", method = %request.method(), path = request.uri().path(), id)
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
async fn with_security_headers(State(https): State<bool>, mut response: Response) -> Response {
    let headers = response.headers_mut();
    headers.insert(CONTENT_SECURITY_POLICY, content_security::POLICY);
    headers.insert(X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
    if https {
        headers.insert(STRICT_TRANSPORT_SECURITY, HTTPS_ONLY);
    }
    response
}
