//! The line to the server that executors and runs are watched over: opened when the page starts, and again whenever it
//! breaks off.

mod backoff;
mod keep_up;

use std::time::Duration;

use futures_util::StreamExt;
use gloo_net::websocket::Message;
use gloo_net::websocket::futures::WebSocket;
use goalgraph::protocol::monitor::{SUBPROTOCOL, ToMonitor};
use js_sys::{Date, Promise};
use leptos::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::model::{Connection, Server};
use super::update::{Action, App, WatchAction};
use backoff::Backoff;

/// How long until it is looked again whether there is a server that lets the page in.
const LOOK_AGAIN: Duration = Duration::from_millis(250);

/// Watches from now on, for as long as the page is open.
pub(crate) fn start(app: App) {
    keep_up::start(app);
    spawn_local(async move {
        let mut backoff = Backoff::new();
        loop {
            if !is_open(app) {
                sleep(LOOK_AGAIN).await;
                continue;
            }
            if listen(app).await {
                backoff = Backoff::new();
            }
            app.act(Action::Watch(WatchAction::Lost(Date::now())));
            sleep(backoff.next_delay(js_sys::Math::random())).await;
        }
    });
}

/// Whether there is a server that lets the page in; asked without the network.
fn is_open(app: App) -> bool {
    app.model.keeping.server.with_untracked(|server| matches!(server, Server::Present(_)))
}

/// Takes what the server says, until the line breaks off; whether it said anything.
async fn listen(app: App) -> bool {
    let Some(address) = address() else { return false };
    let Ok(mut socket) = WebSocket::open_with_protocol(&address, SUBPROTOCOL) else { return false };
    let mut heard = false;
    while let Some(Ok(message)) = socket.next().await {
        let Message::Text(text) = message else { continue };
        // A server that speaks otherwise is none that can be watched.
        let Ok(message) = serde_json::from_str::<ToMonitor>(&text) else { break };
        heard = true;
        app.act(Action::Watch(WatchAction::Heard(Box::new(message), Date::now())));
    }
    heard
}

/// The address of the monitor on the server that the page came from.
fn address() -> Option<String> {
    let location = window().location();
    let scheme = if location.protocol().ok()? == "https:" { "wss" } else { "ws" };
    Some(format!("{scheme}://{}/api/v1/monitor", location.host().ok()?))
}

/// Ends after `delay`.
pub(crate) async fn sleep(delay: Duration) {
    let promise = Promise::new(&mut |resolve, _| {
        set_timeout(
            move || {
                // A promise that is resolved cannot refuse.
                let _ = resolve.call0(&wasm_bindgen::JsValue::NULL);
            },
            delay,
        );
    });
    // It is never rejected.
    let _ = JsFuture::from(promise).await;
}

impl Connection {
    /// How the line is after it broke off at `now_ms`, or could not be opened.
    pub(crate) fn broken(self, now_ms: f64) -> Self {
        match self {
            Self::Live => Self::Lost { since_ms: now_ms },
            Self::Connecting => Self::NoServer,
            known => known,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_was_never_open_is_no_server_and_one_that_was_is_lost_since_then() {
        assert_eq!(Connection::Connecting.broken(5.0), Connection::NoServer);
        let lost = Connection::Live.broken(5.0);
        assert_eq!(lost, Connection::Lost { since_ms: 5.0 });
        assert_eq!(lost.broken(9.0), lost, "another attempt that fails changes nothing");
    }
}
