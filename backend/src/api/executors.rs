//! Executors: who is connected, what they are told, and the two sockets.

use axum::Json;
use axum::extract::State;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::ws::rejection::WebSocketUpgradeRejection;
use axum::http::StatusCode;
use axum::response::Response;
use goalgraph::protocol::api::{CommandRequest, Page};
use goalgraph::protocol::monitor::ExecutorView;
use serde::Deserialize;
use utoipa::IntoParams;

use super::Api;
use super::extract::{Body, PathParts, QueryParts};
use super::problem::{ApiError, ApiResult};
use crate::access::Caller;
use crate::relay::{CommandError, SocketCaller};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The addresses of this module.
pub(super) fn routes() -> OpenApiRouter<Api> {
    OpenApiRouter::new()
        .routes(routes!(list_executors))
        .routes(routes!(command_executor))
        .routes(routes!(connect_executor))
        .routes(routes!(connect_monitor))
}

/// The executors that are connected, or hold a run that is not over.
#[utoipa::path(get, path = "/executors", tag = "executors", responses((status = 200, body = Page<ExecutorView>)))]
async fn list_executors(State(api): State<Api>) -> Json<Page<ExecutorView>> {
    Json(Page { items: api.relay.executors(), next: None })
}

/// Tells an executor what to do. It answers by what it then reports.
#[utoipa::path(post, path = "/executors/{name}/commands", tag = "executors", request_body = CommandRequest,
    params(("name" = String, Path)), responses((status = 202)))]
async fn command_executor(
    State(api): State<Api>,
    PathParts(name): PathParts<String>,
    Body(request): Body<CommandRequest>,
) -> ApiResult<StatusCode> {
    api.relay.command(&name, request.command).map_err(|error| match error {
        CommandError::NotConnected { .. } => ApiError::not_found(error.to_string()),
        _ => ApiError::conflict(error.to_string()),
    })?;
    Ok(StatusCode::ACCEPTED)
}

/// Which specification an executor follows.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
struct Followed {
    /// Id of the specification; left out for the one that was approved last.
    specification: Option<String>,
}

/// The WebSocket of executors, subprotocol `goalgraph.executor.v1`.
#[utoipa::path(get, path = "/executor", tag = "executors", params(Followed), responses((status = 101)))]
async fn connect_executor(
    State(api): State<Api>,
    caller: Caller,
    QueryParts(Followed { specification }): QueryParts<Followed>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> ApiResult<Response> {
    let caller = SocketCaller { token_id: caller.token, name: caller.name };
    Ok(crate::relay::executor_socket(socket(upgrade)?, api.relay, caller, specification).await)
}

/// The WebSocket of those who watch, subprotocol `goalgraph.monitor.v1`.
#[utoipa::path(get, path = "/monitor", tag = "executors", responses((status = 101)))]
async fn connect_monitor(
    State(api): State<Api>,
    caller: Caller,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> ApiResult<Response> {
    let caller = SocketCaller { token_id: caller.token, name: caller.name };
    Ok(crate::relay::monitor_socket(socket(upgrade)?, api.relay, caller))
}

fn socket(upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>) -> ApiResult<WebSocketUpgrade> {
    upgrade.map_err(|rejection| {
        ApiError::bad_request(format!("this address is a WebSocket: {}", rejection.body_text()))
    })
}
