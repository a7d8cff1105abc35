//! The fan-out that there is nothing to take away from: a list of sockets, and a loop that sends to each.

use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use futures_util::{SinkExt, StreamExt};
use goalgraph::protocol::executor::SUBPROTOCOL;
use tokio::net::{TcpListener, TcpStream};
use tokio_tungstenite::tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tokio_tungstenite::tungstenite::{Message, Utf8Bytes};
use tokio_tungstenite::{WebSocketStream, accept_hdr_async};

use super::clients::Clients;

/// Sockets that were accepted, and the clients at their other ends.
pub(crate) struct Bare {
    sockets: Vec<WebSocketStream<TcpStream>>,
    clients: Clients,
}

impl Bare {
    /// Connects this many clients.
    pub(crate) async fn begin(executors: usize) -> Result<Self> {
        let listener = TcpListener::bind("127.0.0.1:0").await?;
        let address = listener.local_addr()?;
        let connecting = tokio::spawn(Clients::connect(address, executors));
        let mut sockets = Vec::new();
        for _ in 0..executors {
            let (stream, _) = listener.accept().await?;
            sockets.push(welcome(stream).await?);
        }
        Ok(Self { sockets, clients: connecting.await?? })
    }

    /// Sends `message` to all, and returns how long it took until the last had it.
    pub(crate) async fn send(&mut self, message: &Utf8Bytes) -> Result<Duration> {
        self.clients.expect();
        let began = Instant::now();
        for socket in &mut self.sockets {
            socket.send(Message::Text(message.clone())).await?;
        }
        self.clients.all_since(began).await
    }
}

// The callback's signature is the library's.
#[allow(clippy::result_large_err, clippy::unnecessary_wraps)]
fn choose_protocol(_: &Request, mut response: Response) -> Result<Response, ErrorResponse> {
    let chosen = tokio_tungstenite::tungstenite::http::HeaderValue::from_static(SUBPROTOCOL);
    response.headers_mut().insert("sec-websocket-protocol", chosen);
    Ok(response)
}

async fn welcome(stream: TcpStream) -> Result<WebSocketStream<TcpStream>> {
    let mut socket = accept_hdr_async(stream, choose_protocol).await?;
    match socket.next().await {
        Some(Ok(Message::Text(_))) => socket.send(Message::text("welcome")).await?,
        other => bail!("the client said {other:?}"),
    }
    Ok(socket)
}
