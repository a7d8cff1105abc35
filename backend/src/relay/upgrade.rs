//! How a request becomes a connection, or is answered instead.

use std::sync::Arc;

use axum::Json;
use axum::extract::ws::{WebSocket, WebSocketUpgrade};
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use goalgraph::protocol::api::Problem;
use goalgraph::protocol::{executor, monitor};
use tokio::sync::Semaphore;

use super::offer::Follow;
use super::{Relay, greeting, monitoring};
use crate::store::StoreError;

/// How much is read of a connection at once, in bytes: there may be thousands.
const READ_BUFFER: usize = 8 * 1024;

/// How many times the longest message is read before the connection is cut, so that one a little too long is answered.
const MARGIN: usize = 4;

/// Longest message that a monitor may send, in bytes: it has nothing to say.
const MONITOR_MESSAGE: usize = 4 * 1024;

/// Who asks for a connection, as far as the server knows.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SocketCaller {
    /// Id of the token that was shown; none where no token is needed.
    pub token_id: Option<String>,
    /// Name of the token.
    pub name: Option<String>,
}

/// The answer to `GET /api/v1/executor`: a WebSocket that speaks [`goalgraph::protocol::executor`].
///
/// The executor follows what is approved of `specification`; without it, of the specification that was approved last.
/// Answered with a problem are a client that does not offer the subprotocol (400), a specification that there is not
/// (404), and one connection too many or a store that cannot be read (503).
pub async fn executor_socket(
    upgrade: WebSocketUpgrade,
    relay: Relay,
    caller: SocketCaller,
    specification: Option<String>,
) -> Response {
    let upgrade = upgrade.protocols([executor::SUBPROTOCOL]);
    if upgrade.selected_protocol().is_none() {
        return other_protocol(executor::SUBPROTOCOL);
    }
    let follow = match specification {
        None => Follow::Latest,
        Some(id) => match relay.inner.store.specification(&id).await {
            Ok(row) => Follow::Specification(row.id),
            Err(StoreError::NotFound { .. }) => return not_found(&id),
            Err(_) => return unavailable("the store cannot be read at the moment"),
        },
    };
    let limit = relay.inner.limits.message_bytes;
    let upgrade = upgrade.max_message_size(limit * MARGIN).max_frame_size(limit * MARGIN);
    let slots = relay.inner.executor_slots.clone();
    connect(upgrade, &slots, async move |socket| {
        greeting::serve(relay.inner, socket, caller.token_id, follow).await;
    })
}

/// The answer to `GET /api/v1/monitor`: a WebSocket that speaks [`goalgraph::protocol::monitor`].
///
/// Answered with a problem are a client that does not offer the subprotocol (400), and one connection too many (503).
pub fn monitor_socket(upgrade: WebSocketUpgrade, relay: Relay, caller: SocketCaller) -> Response {
    let upgrade = upgrade.protocols([monitor::SUBPROTOCOL]);
    if upgrade.selected_protocol().is_none() {
        return other_protocol(monitor::SUBPROTOCOL);
    }
    let upgrade = upgrade.max_message_size(MONITOR_MESSAGE).max_frame_size(MONITOR_MESSAGE);
    let slots = relay.inner.monitor_slots.clone();
    connect(upgrade, &slots, async move |socket| {
        monitoring::serve(relay.inner, socket, caller.token_id).await;
    })
}

/// Takes the connection if there is a slot for it, and gives the slot back when it ends.
fn connect<F, R>(upgrade: WebSocketUpgrade, slots: &Arc<Semaphore>, serve: F) -> Response
where
    F: FnOnce(WebSocket) -> R + Send + 'static,
    R: Future<Output = ()> + Send + 'static,
{
    let Ok(slot) = slots.clone().try_acquire_owned() else {
        return unavailable("as many connections are open as the server takes; try again later");
    };
    upgrade.read_buffer_size(READ_BUFFER).write_buffer_size(0).on_upgrade(async move |socket| {
        serve(socket).await;
        drop(slot);
    })
}

fn other_protocol(subprotocol: &str) -> Response {
    let detail = format!("the request must offer the WebSocket subprotocol {subprotocol}");
    problem(StatusCode::BAD_REQUEST, "/problems/subprotocol", "Subprotocol not offered", detail)
}

fn not_found(id: &str) -> Response {
    let id: String = id.chars().take(executor::MAX_ID).collect();
    problem(
        StatusCode::NOT_FOUND,
        "/problems/not-found",
        "Not found",
        format!("there is no specification {id}"),
    )
}

fn unavailable(detail: &str) -> Response {
    problem(StatusCode::SERVICE_UNAVAILABLE, "/problems/unavailable", "Not available", detail.to_owned())
}

fn problem(status: StatusCode, kind: &str, title: &str, detail: String) -> Response {
    let problem = Problem {
        kind: kind.to_owned(),
        title: title.to_owned(),
        status: status.as_u16(),
        detail,
        head: None,
        approved: None,
        findings: Vec::new(),
    };
    let mut response = (status, Json(problem)).into_response();
    response.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static("application/problem+json"));
    response
}
