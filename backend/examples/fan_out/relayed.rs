//! The relay over a database in a temporary folder, with executors connected to it.

use std::time::{Duration, Instant};

use anyhow::Result;
use axum::Router;
use axum::extract::{State, WebSocketUpgrade};
use axum::response::Response;
use axum::routing::get;
use goalgraph::infer::infer_words;
use goalgraph::pdfa::Semantics;
use goalgraph::protocol::executor::ToExecutor;
use goalgraph_server::relay::{Relay, RelayLimits, SocketCaller, executor_socket};
use goalgraph_server::store::{Location, NewApproval, NewRevision, Signature, Store, StoreOptions};
use tempfile::TempDir;
use tokio::net::TcpListener;
use tokio_tungstenite::tungstenite::Utf8Bytes;

use super::clients::Clients;

/// How many sub-goals the specification has.
const SUB_GOALS: usize = 40;

/// A relay with executors that hold the present approval.
pub(crate) struct Relayed {
    store: Store,
    relay: Relay,
    clients: Clients,
    specification: String,
    revision: u64,
    _folder: TempDir,
}

/// How long an approval took.
pub(crate) struct Times {
    /// Until the message was there to be sent.
    pub(crate) reading: Duration,
    /// Until the last executor had it.
    pub(crate) all: Duration,
}

impl Relayed {
    /// Connects this many executors.
    pub(crate) async fn begin(executors: usize) -> Result<Self> {
        let folder = tempfile::tempdir()?;
        let store = Store::open(&Location::folder(folder.path()), StoreOptions::default()).await?;
        let specification = store.create(revision(0)).await?.id;
        // Nobody says anything in a round, however long it takes.
        let lease = Duration::from_hours(1);
        let limits = RelayLimits { lease, executors, ..RelayLimits::default() };
        let relay = Relay::open(store.clone(), limits).await?;
        let listener = TcpListener::bind("127.0.0.1:0").await?;
        let address = listener.local_addr()?;
        let router = Router::new().route("/executor", get(upgrade)).with_state(relay.clone());
        tokio::spawn(async move { axum::serve(listener, router).await });
        let clients = Clients::connect(address, executors).await?;
        Ok(Self { store, relay, clients, specification, revision: 1, _folder: folder })
    }

    /// Approves another revision; returns the message that carries it, and how long it took.
    pub(crate) async fn approve(&mut self) -> Result<(Utf8Bytes, Times)> {
        let before = self.revision;
        let row = self.store.save(&self.specification, before, revision(before)).await?;
        let approval = NewApproval {
            revision: row.number,
            sha256_seen: row.sha256.clone(),
            expected_approved: (before > 1).then_some(before),
            signature: signature(),
        };
        let approval = self.store.approve(&self.specification, approval).await?.sequence;
        self.revision = row.number;
        self.clients.expect();
        let began = Instant::now();
        self.relay.approval_changed(&self.specification).await;
        let reading = began.elapsed();
        let all = self.clients.all_since(began).await?;
        let message = ToExecutor::Specification {
            specification: self.specification.clone(),
            revision: row.number,
            approval,
            sha256: row.sha256,
            content: self.store.content(&self.specification, row.number).await?,
        };
        Ok((serde_json::to_string(&message)?.into(), Times { reading, all }))
    }
}

async fn upgrade(State(relay): State<Relay>, upgrade: WebSocketUpgrade) -> Response {
    executor_socket(upgrade, relay, SocketCaller::default(), None).await
}

fn revision(number: u64) -> NewRevision {
    let forwards: Vec<String> = (0..SUB_GOALS).map(|symbol| format!("place {symbol}")).collect();
    let backwards = forwards.iter().rev().cloned().collect();
    let name = format!("Load {number}");
    let content = infer_words(&name, Semantics::MaximumLikelihood, &[forwards, backwards]).to_json();
    NewRevision {
        name,
        content,
        positions: None,
        author: "Ada".to_owned(),
        message: String::new(),
        saved_at_ms: 0,
    }
}

fn signature() -> Signature {
    Signature {
        who: "Grace".to_owned(),
        token: None,
        meaning: "approved for the robot".to_owned(),
        comment: String::new(),
        at_ms: 0,
    }
}
