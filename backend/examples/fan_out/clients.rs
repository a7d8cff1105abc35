//! Executors that only listen.

use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use futures_util::{SinkExt, StreamExt};
use goalgraph::protocol::executor::SUBPROTOCOL;
use tokio::sync::{Notify, Semaphore};
use tokio::time::timeout;
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;

/// How long the last executor may take.
const PATIENCE: Duration = Duration::from_mins(1);

/// How many connect at a time.
const AT_A_TIME: usize = 64;

/// Executors that count the specifications they receive.
pub(crate) struct Clients {
    number: usize,
    received: Arc<Received>,
}

#[derive(Default)]
struct Received {
    specifications: AtomicUsize,
    wanted: AtomicUsize,
    all: Notify,
}

impl Clients {
    /// Connects executors to a server, each of which says hello.
    pub(crate) async fn connect(address: SocketAddr, number: usize) -> Result<Self> {
        let received = Arc::new(Received::default());
        let turns = Arc::new(Semaphore::new(AT_A_TIME));
        let mut connecting = Vec::new();
        for name in 0..number {
            let (received, turns) = (received.clone(), turns.clone());
            connecting.push(tokio::spawn(async move {
                let _turn = turns.acquire().await?;
                listen(address, name, received).await
            }));
        }
        for connected in connecting {
            connected.await??;
        }
        Ok(Self { number, received })
    }

    /// From here on every executor is to receive one more specification.
    pub(crate) fn expect(&self) {
        self.received.specifications.store(0, Ordering::SeqCst);
        self.received.wanted.store(self.number, Ordering::SeqCst);
    }

    /// Waits until the last has received it, and returns the time since `began`.
    pub(crate) async fn all_since(&self, began: Instant) -> Result<Duration> {
        let all = timeout(PATIENCE, self.received.all.notified()).await;
        all.context("an executor did not receive what was sent")?;
        Ok(began.elapsed())
    }
}

impl Received {
    fn count(&self, text: &str) {
        if !text.starts_with(r#"{"type":"specification""#) {
            return;
        }
        let count = self.specifications.fetch_add(1, Ordering::SeqCst) + 1;
        if count == self.wanted.load(Ordering::SeqCst) {
            self.all.notify_one();
        }
    }
}

/// Connects an executor, and reads on in a task of its own.
async fn listen(address: SocketAddr, name: usize, received: Arc<Received>) -> Result<()> {
    let mut request = format!("ws://{address}/executor").into_client_request()?;
    request.headers_mut().insert("sec-websocket-protocol", SUBPROTOCOL.parse()?);
    let (mut socket, _) = connect_async(request).await?;
    let hello = format!(r#"{{"type":"hello","executor":"robot {name}"}}"#);
    socket.send(Message::text(hello)).await?;
    match socket.next().await {
        Some(Ok(Message::Text(_))) => {}
        other => bail!("the server welcomed with {other:?}"),
    }
    tokio::spawn(async move {
        while let Some(Ok(message)) = socket.next().await {
            if let Message::Text(text) = message {
                received.count(&text);
            }
        }
    });
    Ok(())
}
