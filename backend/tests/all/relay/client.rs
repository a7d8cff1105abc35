//! An executor or a monitor on the other end of a real socket.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use goalgraph::protocol::executor::{FromExecutor, Refusal, ToExecutor};
use goalgraph::protocol::monitor::{ExecutorView, RunView, ToMonitor};
use goalgraph::run::RunEvent;
use tokio::net::TcpStream;
use tokio::time::timeout;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::{Error, Message};
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

/// How long a test waits for what must come before it fails.
const PATIENCE: Duration = Duration::from_secs(30);

/// One end of a WebSocket.
pub(crate) struct Client {
    pub(crate) socket: WebSocketStream<MaybeTlsStream<TcpStream>>,
    executors: BTreeMap<String, ExecutorView>,
    runs: BTreeMap<String, RunView>,
}

/// Opens a WebSocket; an error is the answer that came instead.
pub(crate) async fn open(
    address: SocketAddr,
    path: &str,
    subprotocol: Option<&str>,
) -> Result<Client, Error> {
    let mut request = format!("ws://{address}{path}").into_client_request().unwrap();
    if let Some(subprotocol) = subprotocol {
        request.headers_mut().insert("sec-websocket-protocol", subprotocol.parse().unwrap());
    }
    let (socket, _) = connect_async(request).await?;
    Ok(Client { socket, executors: BTreeMap::new(), runs: BTreeMap::new() })
}

impl Client {
    /// Sends a message of the protocol.
    pub(crate) async fn say(&mut self, message: &FromExecutor) {
        self.say_text(&serde_json::to_string(message).unwrap()).await;
    }

    /// Sends any text.
    pub(crate) async fn say_text(&mut self, text: &str) {
        self.socket.send(Message::text(text)).await.unwrap();
    }

    /// The next text or close frame.
    async fn frame(&mut self) -> Option<Message> {
        loop {
            let next = timeout(PATIENCE, self.socket.next()).await.expect("a message, in time");
            match next {
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
                Some(Ok(message)) => return Some(message),
                Some(Err(_)) | None => return None,
            }
        }
    }

    /// What the server says next.
    pub(crate) async fn hear(&mut self) -> ToExecutor {
        match self.frame().await {
            Some(Message::Text(text)) => serde_json::from_str(&text).unwrap(),
            other => panic!("a message was expected, not {other:?}"),
        }
    }

    /// What the server says next, or the code of the close frame.
    pub(crate) async fn hear_or_close(&mut self) -> Result<ToExecutor, Option<u16>> {
        match self.frame().await {
            Some(Message::Text(text)) => Ok(serde_json::from_str(&text).unwrap()),
            Some(Message::Close(frame)) => Err(frame.map(|frame| frame.code.into())),
            _ => Err(None),
        }
    }

    /// What the server says next, which is a refusal.
    pub(crate) async fn hear_refusal(&mut self) -> (Refusal, Option<u64>) {
        match self.hear().await {
            ToExecutor::Refused { reason, expected, .. } => (reason, expected),
            other => panic!("a refusal was expected, not {other:?}"),
        }
    }

    /// Reads until the connection ends, and returns the code of the close frame.
    pub(crate) async fn hear_close(&mut self) -> Option<u16> {
        loop {
            if let Message::Close(frame) = self.frame().await? {
                return frame.map(|frame| frame.code.into());
            }
        }
    }

    /// Says hello and reads the welcome.
    pub(crate) async fn greet(&mut self, executor: &str) {
        self.say(&FromExecutor::Hello { executor: executor.to_owned(), software: Some("test 1".to_owned()) })
            .await;
        assert!(matches!(self.hear().await, ToExecutor::Welcome { .. }));
    }

    /// Reads the specification that is offered, accepts it, and returns its SHA-256.
    pub(crate) async fn accept(&mut self) -> String {
        let ToExecutor::Specification { sha256, .. } = self.hear().await else { panic!("no specification") };
        self.say(&FromExecutor::Accepted { sha256: sha256.clone() }).await;
        sha256
    }

    /// Asks for a lease.
    pub(crate) async fn begin(&mut self, run: &str, sha256: &str) -> ToExecutor {
        self.say(&FromExecutor::Begin { run: run.to_owned(), sha256: sha256.to_owned() }).await;
        self.hear().await
    }

    /// Asks for a lease, which is granted, and returns how many events are stored.
    pub(crate) async fn must_begin(&mut self, run: &str, sha256: &str) -> u64 {
        match self.begin(run, sha256).await {
            ToExecutor::Granted { run: granted, stored } if granted == run => stored,
            other => panic!("a lease was expected, not {other:?}"),
        }
    }

    /// Reports an event.
    pub(crate) async fn report(&mut self, run: &str, number: u64, happened: RunEvent) {
        self.say(&FromExecutor::Event { run: run.to_owned(), number, at_ms: Some(1), happened }).await;
    }

    /// Reports an event, which is acknowledged.
    pub(crate) async fn must_report(&mut self, run: &str, number: u64, happened: RunEvent) {
        self.report(run, number, happened).await;
        assert_eq!(self.hear().await, ToExecutor::Acknowledged { run: run.to_owned(), number });
    }

    /// What a monitor is told next. The client keeps it in mind as a page does.
    pub(crate) async fn watch(&mut self) -> ToMonitor {
        let told: ToMonitor = match self.frame().await {
            Some(Message::Text(text)) => serde_json::from_str(&text).unwrap(),
            other => panic!("a message was expected, not {other:?}"),
        };
        let (ToMonitor::Snapshot { executors, runs, .. } | ToMonitor::Changes { executors, runs, .. }) =
            &told;
        for view in executors {
            self.executors.insert(view.executor.clone(), view.clone());
        }
        for view in runs {
            self.runs.insert(view.run.clone(), view.clone());
        }
        told
    }

    /// Watches until an executor that is shown is as wanted.
    pub(crate) async fn watch_executor(&mut self, wanted: impl Fn(&ExecutorView) -> bool) -> ExecutorView {
        loop {
            if let Some(found) = self.executors.values().find(|it| wanted(it)) {
                return found.clone();
            }
            self.watch().await;
        }
    }

    /// Watches until a run that is shown is as wanted.
    pub(crate) async fn watch_run(&mut self, wanted: impl Fn(&RunView) -> bool) -> RunView {
        loop {
            if let Some(found) = self.runs.values().find(|it| wanted(it)) {
                return found.clone();
            }
            self.watch().await;
        }
    }
}
