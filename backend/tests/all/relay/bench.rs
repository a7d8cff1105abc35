//! A relay with a database in a temporary folder, on a port of its own.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::Duration;

use axum::Router;
use axum::extract::{Query, State, WebSocketUpgrade};
use axum::response::Response;
use axum::routing::get;
use goalgraph::infer::infer_words;
use goalgraph::pdfa::Semantics;
use goalgraph::protocol::{executor, monitor};
use goalgraph_server::relay::{Relay, RelayLimits, SocketCaller, executor_socket, monitor_socket};
use goalgraph_server::store::{Location, NewApproval, NewRevision, Signature, Store, StoreOptions};
use serde::Deserialize;
use tempfile::TempDir;
use tokio::net::TcpListener;
use tokio::task::JoinHandle;

use super::client::{Client, open};

/// A server that can be ended and begun again.
pub(crate) struct Bench {
    folder: TempDir,
    limits: RelayLimits,
    pub(crate) store: Store,
    pub(crate) relay: Relay,
    pub(crate) address: SocketAddr,
    server: JoinHandle<()>,
}

/// An approved revision.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Approved {
    pub(crate) specification: String,
    pub(crate) revision: u64,
    pub(crate) sha256: String,
    pub(crate) content: String,
}

/// Times of signatures: nothing is ordered by them.
static CLOCK: AtomicI64 = AtomicI64::new(1_000);

impl Bench {
    /// With the limits of a real server, but for leases that end soon enough to wait for.
    pub(crate) async fn new() -> Self {
        Self::with(RelayLimits::default()).await
    }

    /// With these limits.
    pub(crate) async fn with(limits: RelayLimits) -> Self {
        Self::at(tempfile::tempdir().unwrap(), limits, StoreOptions::default()).await
    }

    /// With a store opened like this.
    pub(crate) async fn at(folder: TempDir, limits: RelayLimits, options: StoreOptions) -> Self {
        let store = Store::open(&Location::folder(folder.path()), options).await.unwrap();
        let relay = Relay::open(store.clone(), limits).await.unwrap();
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let router = router(relay.clone());
        let server = tokio::spawn(async move { axum::serve(listener, router).await.unwrap() });
        Self { folder, limits, store, relay, address, server }
    }

    /// Ends the server as a crash does, without a word to anybody, and begins another over the same files.
    pub(crate) async fn restart(self, options: StoreOptions) -> Self {
        self.server.abort();
        let _ = self.server.await;
        drop(self.relay);
        self.store.close().await;
        Self::at(self.folder, self.limits, options).await
    }

    /// The file of the database.
    pub(crate) fn database(&self) -> PathBuf {
        let files = std::fs::read_dir(self.folder.path()).unwrap().map(|file| file.unwrap().path());
        files
            .into_iter()
            .find(|file| file.extension().is_some_and(|it| it == "db" || it == "sqlite"))
            .unwrap()
    }

    /// Saves a specification of these words and approves it.
    pub(crate) async fn approve(&self, name: &str, words: &[&str]) -> Approved {
        let content = specification(name, words);
        let row = self.store.create(revision(name, &content)).await.unwrap();
        let approved = Approved { specification: row.id, revision: 1, sha256: row.sha256, content };
        self.sign(&approved, None).await;
        approved
    }

    /// Saves the next revision of a specification and approves it.
    pub(crate) async fn approve_next(&self, before: &Approved, name: &str, words: &[&str]) -> Approved {
        let content = specification(name, words);
        let new = revision(name, &content);
        let row = self.store.save(&before.specification, before.revision, new).await.unwrap();
        let approved = Approved { revision: row.number, sha256: row.sha256, content, ..before.clone() };
        self.sign(&approved, Some(before.revision)).await;
        approved
    }

    async fn sign(&self, what: &Approved, expected_approved: Option<u64>) {
        let new = NewApproval {
            revision: what.revision,
            sha256_seen: what.sha256.clone(),
            expected_approved,
            signature: signature(),
        };
        self.store.approve(&what.specification, new).await.unwrap();
        self.relay.approval_changed(&what.specification).await;
    }

    /// Takes an approval back.
    pub(crate) async fn revoke(&self, what: &Approved) {
        self.store.revoke(&what.specification, what.revision, signature()).await.unwrap();
        self.relay.approval_changed(&what.specification).await;
    }

    /// A connection of an executor that has said nothing yet.
    pub(crate) async fn connect(&self) -> Client {
        open(self.address, "/executor", Some(executor::SUBPROTOCOL)).await.unwrap()
    }

    /// An executor that was welcomed.
    pub(crate) async fn executor(&self, name: &str) -> Client {
        let mut client = self.connect().await;
        client.greet(name).await;
        client
    }

    /// An executor that has accepted what is approved, and the SHA-256 of that.
    pub(crate) async fn ready(&self, name: &str) -> (Client, String) {
        let mut client = self.executor(name).await;
        let sha256 = client.accept().await;
        (client, sha256)
    }

    /// A page that watches.
    pub(crate) async fn monitor(&self) -> Client {
        open(self.address, "/monitor", Some(monitor::SUBPROTOCOL)).await.unwrap()
    }
}

/// Limits with leases of this length.
pub(crate) fn leases_of(milliseconds: u64) -> RelayLimits {
    RelayLimits { lease: Duration::from_millis(milliseconds), ..RelayLimits::default() }
}

/// A specification file of words, each a list of names.
pub(crate) fn specification(name: &str, words: &[&str]) -> String {
    let words: Vec<Vec<String>> =
        words.iter().map(|word| word.split(' ').map(str::to_owned).collect()).collect();
    infer_words(name, Semantics::MaximumLikelihood, &words).to_json()
}

fn revision(name: &str, content: &str) -> NewRevision {
    NewRevision {
        name: name.to_owned(),
        content: content.to_owned(),
        positions: None,
        author: "Ada".to_owned(),
        message: String::new(),
        saved_at_ms: CLOCK.fetch_add(1, Ordering::Relaxed),
    }
}

fn signature() -> Signature {
    Signature {
        who: "Grace".to_owned(),
        token: None,
        meaning: "approved for the robot".to_owned(),
        comment: String::new(),
        at_ms: CLOCK.fetch_add(1, Ordering::Relaxed),
    }
}

#[derive(Deserialize)]
struct Asked {
    specification: Option<String>,
    token: Option<String>,
}

fn router(relay: Relay) -> Router {
    Router::new().route("/executor", get(of_executor)).route("/monitor", get(of_monitor)).with_state(relay)
}

async fn of_executor(
    State(relay): State<Relay>,
    Query(asked): Query<Asked>,
    upgrade: WebSocketUpgrade,
) -> Response {
    let caller = SocketCaller { token_id: asked.token, name: None };
    executor_socket(upgrade, relay, caller, asked.specification).await
}

async fn of_monitor(
    State(relay): State<Relay>,
    Query(asked): Query<Asked>,
    upgrade: WebSocketUpgrade,
) -> Response {
    monitor_socket(upgrade, relay, SocketCaller { token_id: asked.token, name: None })
}
