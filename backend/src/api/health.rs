//! Whether the server is there, and whether it can work.

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use serde::Serialize;
use utoipa::ToSchema;

use super::Api;
use super::problem::{ApiError, ApiResult};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The addresses of this module.
pub(super) fn routes() -> OpenApiRouter<Api> {
    OpenApiRouter::new().routes(routes!(read_health)).routes(routes!(read_readiness))
}

/// The server is there.
#[derive(Serialize, ToSchema)]
struct Health {
    /// Always `ok`.
    status: &'static str,
    /// Version of the program.
    version: &'static str,
}

/// Whether the program runs; asks nothing else.
#[utoipa::path(get, path = "/health", tag = "server", responses((status = 200, body = Health)))]
async fn read_health() -> Json<Health> {
    Json(Health { status: "ok", version: env!("CARGO_PKG_VERSION") })
}

/// Whether the server can work: its database answers.
#[utoipa::path(get, path = "/ready", tag = "server", responses((status = 204), (status = 503)))]
async fn read_readiness(State(api): State<Api>) -> ApiResult<StatusCode> {
    api.store.ping().await.map_err(|error| {
        tracing::warn!(%error, "not ready");
        ApiError::busy("the database does not answer")
    })?;
    Ok(StatusCode::NO_CONTENT)
}
