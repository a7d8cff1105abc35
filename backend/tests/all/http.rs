//! The server on a free port of this computer, and a plain client.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;

use goalgraph_server::access::{Access, AccessSettings};
use goalgraph_server::api::Api;
use goalgraph_server::relay::{Relay, RelayLimits};
use goalgraph_server::server::{Assets, app};
use goalgraph_server::store::{Location, NewToken, Store, StoreOptions};
use goalgraph_server::token::Token;
use serde::de::DeserializeOwned;
use serde_json::Value;
use tempfile::TempDir;
use tokio::runtime::Runtime;

/// A server with a store of its own; it ends with the test.
pub(crate) struct Server {
    /// Where it listens.
    pub(crate) address: SocketAddr,
    /// What it keeps.
    pub(crate) store: Store,
    runtime: Runtime,
    _folder: TempDir,
}

/// An answer to a request.
#[derive(Debug)]
pub(crate) struct Answer {
    /// HTTP status.
    pub(crate) status: u16,
    headers: Vec<(String, String)>,
    /// The body, not decompressed.
    pub(crate) bytes: Vec<u8>,
}

impl Server {
    /// A server without files that needs no tokens.
    pub(crate) fn start() -> Self {
        Self::with(|_| None, AccessSettings::default(), StoreOptions::default())
    }

    /// A server without files that needs tokens.
    pub(crate) fn with_tokens() -> Self {
        let settings = AccessSettings { tokens_needed: true, ..AccessSettings::default() };
        Self::with(|_| None, settings, StoreOptions::default())
    }

    /// A server.
    pub(crate) fn with(assets: Assets, settings: AccessSettings, options: StoreOptions) -> Self {
        let runtime = Runtime::new().unwrap();
        let folder = tempfile::tempdir().unwrap();
        let location = Location::folder(folder.path());
        let (address, store) = runtime.block_on(async {
            let store = Store::open(&location, options).await.unwrap();
            let relay = Relay::open(store.clone(), RelayLimits::default()).await.unwrap();
            let access = Arc::new(Access::new(settings, store.clone()));
            let app = app(assets, Api { store: store.clone(), relay, access });
            let listener = TcpListener::bind("127.0.0.1:0").unwrap();
            listener.set_nonblocking(true).unwrap();
            let address = listener.local_addr().unwrap();
            let listener = tokio::net::TcpListener::from_std(listener).unwrap();
            let service = app.into_make_service_with_connect_info::<SocketAddr>();
            tokio::spawn(async move { axum::serve(listener, service).await });
            (address, store)
        });
        Self { address, store, runtime, _folder: folder }
    }

    /// Waits for what the store does.
    pub(crate) fn wait<T>(&self, task: impl Future<Output = T>) -> T {
        self.runtime.block_on(task)
    }

    /// A new token of this server, as its owner holds it.
    pub(crate) fn token(&self, name: &str, role: &str) -> String {
        let token = Token::generate().unwrap();
        let new = NewToken {
            id: token.id().to_owned(),
            name: name.to_owned(),
            role: role.to_owned(),
            hash: token.hash().unwrap(),
            created_at_ms: 0,
        };
        self.wait(self.store.create_token(new)).unwrap();
        token.reveal()
    }

    /// Sends a request without a body.
    pub(crate) fn request(&self, method: &str, path: &str, headers: &[(&str, &str)]) -> Answer {
        send(self.address, method, path, headers, b"")
    }

    /// Reads what is at a path.
    pub(crate) fn get(&self, path: &str) -> Answer {
        self.request("GET", path, &[])
    }

    /// Sends a JSON body.
    pub(crate) fn send_json(
        &self,
        method: &str,
        path: &str,
        headers: &[(&str, &str)],
        body: &Value,
    ) -> Answer {
        let headers = [&[("content-type", "application/json")], headers].concat();
        send(self.address, method, path, &headers, body.to_string().as_bytes())
    }
}

impl Answer {
    /// The value of a header, empty without it.
    pub(crate) fn header(&self, name: &str) -> &str {
        let found = self.headers.iter().find(|(header, _)| header == name);
        found.map_or("", |(_, value)| value)
    }

    /// The body as text.
    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.bytes).into_owned()
    }

    /// The body as JSON.
    pub(crate) fn json<T: DeserializeOwned>(&self) -> T {
        serde_json::from_slice(&self.bytes).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }

    /// The answer, which must have this status.
    pub(crate) fn expect(self, status: u16) -> Self {
        assert_eq!(self.status, status, "{}", self.text());
        self
    }

    /// The one sentence of a problem, which must have this status.
    pub(crate) fn detail(self, status: u16) -> String {
        let answer = self.expect(status);
        assert_eq!(answer.header("content-type"), "application/problem+json");
        let problem: goalgraph::protocol::api::Problem = answer.json();
        assert_eq!(problem.status, status);
        problem.detail
    }
}

/// Sends a request and reads the answer to the end of the connection.
pub(crate) fn send(
    address: SocketAddr,
    method: &str,
    path: &str,
    headers: &[(&str, &str)],
    body: &[u8],
) -> Answer {
    try_send(address, method, path, headers, body).expect("an answer")
}

/// As [`send`]; none when the server ends before it has answered.
pub(crate) fn try_send(
    address: SocketAddr,
    method: &str,
    path: &str,
    headers: &[(&str, &str)],
    body: &[u8],
) -> Option<Answer> {
    let mut stream = TcpStream::connect(address).ok()?;
    let mut head = format!("{method} {path} HTTP/1.1\r\nconnection: close\r\n");
    if !headers.iter().any(|(name, _)| *name == "host") {
        head.extend(["host: ", &address.to_string(), "\r\n"]);
    }
    for (name, value) in headers {
        head.extend([*name, ": ", *value, "\r\n"]);
    }
    if !headers.iter().any(|(name, _)| *name == "content-length") && !body.is_empty() {
        head.extend(["content-length: ", &body.len().to_string(), "\r\n"]);
    }
    stream.write_all((head + "\r\n").as_bytes()).ok()?;
    // A server that refuses a body may not read it.
    let _ = stream.write_all(body);
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).ok()?;
    parse(&answer, method == "HEAD")
}

/// The answer, if it is whole.
fn parse(answer: &[u8], is_head: bool) -> Option<Answer> {
    let end = answer.windows(4).position(|window| window == b"\r\n\r\n")?;
    let head = std::str::from_utf8(&answer[..end]).unwrap();
    let mut lines = head.lines();
    let status = lines.next().unwrap().split(' ').nth(1).unwrap().parse().unwrap();
    let header = |line: &str| {
        let (name, value) = line.split_once(": ").unwrap_or((line, ""));
        (name.to_owned(), value.to_owned())
    };
    let headers: Vec<(String, String)> = lines.map(header).collect();
    let is_chunked = headers.iter().any(|(name, value)| name == "transfer-encoding" && value == "chunked");
    let body = &answer[end + 4..];
    let promised = headers.iter().find(|(name, _)| name == "content-length");
    let promised = promised.map_or(0, |(_, length)| length.parse::<usize>().unwrap());
    if !is_head && promised > body.len() {
        return None;
    }
    Some(Answer { status, headers, bytes: if is_chunked { joined(body) } else { body.to_vec() } })
}

/// The chunks of a body as one.
fn joined(mut body: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    while let Some(end) = body.windows(2).position(|window| window == b"\r\n") {
        let length = usize::from_str_radix(std::str::from_utf8(&body[..end]).unwrap(), 16).unwrap();
        bytes.extend_from_slice(&body[end + 2..end + 2 + length]);
        body = &body[end + 2 + length + 2..];
        if length == 0 {
            break;
        }
    }
    bytes
}
