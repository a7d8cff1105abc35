//! Runs, what was reported of them, and what executors are told.

use gloo_net::http::Request;
use goalgraph::protocol::api::{CommandRequest, Page, StoredEvent};
use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::RunView;

use super::ROOT;
use super::answer::{Failure, ask, escaped, read, send};

/// How many events are asked for at once.
const EVENTS: usize = 500;
/// How many runs are asked for at once.
const RUNS: usize = 50;

/// The events of a run after that with the number `after`, or the first of them.
pub(crate) async fn events(run: &str, after: u64) -> Result<Page<StoredEvent>, Failure> {
    let address = format!("{ROOT}/runs/{}/events?after={after}&limit={EVENTS}", escaped(run));
    Ok(read(ask(Request::get(&address)).await?).await?.value)
}

/// Runs, newest first, from where an earlier answer ended.
pub(crate) async fn runs(after: Option<&str>) -> Result<Page<RunView>, Failure> {
    let after = after.map(|after| format!("&after={}", escaped(after))).unwrap_or_default();
    Ok(read(ask(Request::get(&format!("{ROOT}/runs?limit={RUNS}{after}"))).await?).await?.value)
}

/// Tells an executor what to do. It answers by what it then reports.
pub(crate) async fn order(executor: &str, command: Command) -> Result<(), Failure> {
    let address = format!("{ROOT}/executors/{}/commands", escaped(executor));
    send(Request::post(&address).json(&CommandRequest { command })).await.map(drop)
}
