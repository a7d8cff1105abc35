//! The JSON API below `/api/v1`. One module per resource; the OpenAPI document is made from the handlers.
//!
//! Modules in reading order: [`problem`] (how the API says no), [`extract`], [`limits`], [`list`], [`aside`], [`entries`] (what is
//! taken out of requests and put into answers); then the resources; [`document`] describes them.

mod approvals;
mod aside;
mod demonstrations;
mod document;
mod entries;
mod executors;
mod extract;
mod health;
mod limits;
mod list;
mod problem;
mod revisions;
mod runs;
mod sessions;
mod specifications;

use std::sync::Arc;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::response::{IntoResponse, Response};
use axum::routing::{any, get};
use utoipa::openapi::OpenApi;
use utoipa_axum::router::OpenApiRouter;
use utoipa_swagger_ui::{Config, SwaggerUi};

pub(crate) use problem::{ApiError, ApiResult};

use crate::access::Access;
use crate::relay::Relay;
use crate::store::Store;

/// Where the OpenAPI document is.
const DOCUMENT: &str = "/api/openapi.json";

/// What the handlers work with; a clone is the same.
#[derive(Clone)]
pub struct Api {
    /// Everything that is kept.
    pub store: Store,
    /// Executors and those who watch them.
    pub relay: Relay,
    /// Who may ask.
    pub access: Arc<Access>,
}

/// The addresses below `/api`, and the page that describes them.
pub(crate) fn router(api: Api) -> Router {
    let (router, document) = documented();
    let document: Arc<str> = document.to_json().unwrap_or_default().into();
    let read_document = move || {
        let document = Arc::clone(&document);
        async move { ([(axum::http::header::CONTENT_TYPE, "application/json")], document.to_string()) }
    };
    let page = SwaggerUi::new("/api/docs").config(Config::new([DOCUMENT]).validator_url("none"));
    router
        .route(DOCUMENT, get(read_document))
        .method_not_allowed_fallback(|| async { ApiError::wrong_method() })
        .with_state(api)
        .merge(page)
        .route("/api/{*path}", any(nothing_here))
}

/// The OpenAPI document of the API.
pub fn openapi() -> OpenApi {
    documented().1
}

fn documented() -> (Router<Api>, OpenApi) {
    // Files are read piece by piece and bounded by the store, not by the limit of other bodies.
    let files = demonstrations::routes().layer(DefaultBodyLimit::disable());
    let (router, mut document) = OpenApiRouter::with_openapi(document::about())
        .nest("/api/v1", resources().layer(DefaultBodyLimit::max(limits::JSON_BYTES)).merge(files))
        .split_for_parts();
    document::add_problems(&mut document);
    document::add_examples(&mut document);
    (router, document)
}

fn resources() -> OpenApiRouter<Api> {
    OpenApiRouter::new()
        .merge(health::routes())
        .merge(sessions::routes())
        .merge(specifications::routes())
        .merge(revisions::routes())
        .merge(approvals::routes())
        .merge(executors::routes())
        .merge(runs::routes())
}

async fn nothing_here() -> Response {
    ApiError::not_found("there is nothing at this address; GET /api/openapi.json tells what there is")
        .into_response()
}
