//! The JSON API below `/api/v1`. One module per resource; the OpenAPI document is made from the handlers.
//!
//! Modules in reading order: [`problem`] (how the API says no), [`extract`], [`limits`], [`list`], [`entries`] (what is
//! taken out of requests and put into answers); then the resources; [`document`] describes them.

mod approvals;
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
use utoipa_axum::routes;
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
    let (router, mut document) = OpenApiRouter::with_openapi(document::about())
        .nest("/api/v1", resources().layer(DefaultBodyLimit::max(limits::JSON_BYTES)).merge(files()))
        .split_for_parts();
    document::add_problems(&mut document);
    (router, document)
}

fn resources() -> OpenApiRouter<Api> {
    use approvals::{approve_revision, list_approvals, read_approved, revoke_revision};
    use executors::{command_executor, connect_executor, connect_monitor, list_executors};
    use health::{read_health, read_readiness};
    use revisions::{list_revisions, read_revision, read_specification_file};
    use runs::{list_events, list_runs, read_run};
    use sessions::{close_session, open_session, read_session};
    use specifications::{
        create_specification, delete_specification, list_specifications, read_specification, save_specification,
    };
    OpenApiRouter::new()
        .routes(routes!(read_health))
        .routes(routes!(read_readiness))
        .routes(routes!(read_session, open_session, close_session))
        .routes(routes!(list_specifications, create_specification))
        .routes(routes!(read_specification, save_specification, delete_specification))
        .routes(routes!(list_revisions))
        .routes(routes!(read_revision))
        .routes(routes!(read_specification_file))
        .routes(routes!(approve_revision))
        .routes(routes!(revoke_revision))
        .routes(routes!(list_approvals))
        .routes(routes!(read_approved))
        .routes(routes!(list_executors))
        .routes(routes!(command_executor))
        .routes(routes!(connect_executor))
        .routes(routes!(connect_monitor))
        .routes(routes!(list_runs))
        .routes(routes!(read_run))
        .routes(routes!(list_events))
}

/// Files are read piece by piece and bounded by the store, not by the limit of other bodies.
fn files() -> OpenApiRouter<Api> {
    use demonstrations::{link_demonstration, list_demonstrations, put_demonstration, read_demonstration};
    OpenApiRouter::new()
        .routes(routes!(put_demonstration, read_demonstration))
        .routes(routes!(list_demonstrations))
        .routes(routes!(link_demonstration))
        .layer(DefaultBodyLimit::disable())
}

async fn nothing_here() -> Response {
    ApiError::not_found("there is nothing at this address; GET /api/openapi.json tells what there is").into_response()
}
