//! stub
#![allow(missing_docs, clippy::unused_async, clippy::missing_errors_doc)]
use crate::store::{RunRow, Store, StoreError};
use axum::extract::ws::WebSocketUpgrade;
use axum::response::Response;
use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::{ExecutorView, RunView};
#[derive(Clone)]
pub struct Relay;
#[derive(Default)]
pub struct RelayLimits;
pub struct SocketCaller {
    pub token_id: Option<String>,
    pub name: Option<String>,
}
pub struct Counts {
    pub executors: usize,
    pub monitors: usize,
    pub events_stored: u64,
    pub messages_refused: u64,
}
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    #[error("x")]
    NotConnected { executor: String },
    #[error("y")]
    Other,
}
impl Relay {
    pub async fn open(_: Store, _: RelayLimits) -> Result<Self, StoreError> {
        Ok(Self)
    }
    pub async fn shutdown(&self) {}
    pub async fn approval_changed(&self, _: &str) {}
    pub fn executors(&self) -> Vec<ExecutorView> {
        Vec::new()
    }
    pub fn command(&self, _: &str, _: Command) -> Result<(), CommandError> {
        Ok(())
    }
    pub async fn view(&self, _: &RunRow) -> Result<RunView, StoreError> {
        Err(StoreError::Busy)
    }
    pub fn counts(&self) -> Counts {
        Counts { executors: 0, monitors: 0, events_stored: 0, messages_refused: 0 }
    }
}
pub async fn executor_socket(_: WebSocketUpgrade, _: Relay, _: SocketCaller, _: Option<String>) -> Response {
    todo!()
}
pub async fn monitor_socket(_: WebSocketUpgrade, _: Relay, _: SocketCaller) -> Response {
    todo!()
}
