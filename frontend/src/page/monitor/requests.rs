//! What is asked of the server about runs, and of executors through it.

use gloo_net::http::{Request, Response};
use goalgraph::protocol::api::{CommandRequest, Page, Problem, StoredEvent};
use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::RunView;
use serde::de::DeserializeOwned;
use thiserror::Error;

/// How many events or runs are asked for at once.
const LIMIT: usize = 500;

/// Why there is no answer.
#[derive(Debug, Error)]
pub(crate) enum RequestError {
    /// The server cannot be reached.
    #[error("the server does not answer")]
    Unreachable,
    /// It says no.
    #[error("{0}")]
    Refused(String),
    /// It says something else than was expected.
    #[error("the server's answer cannot be read: {0}")]
    Unreadable(String),
}

/// The events of a run after that with the number `after`.
pub(crate) async fn events(run: &str, after: u64) -> Result<Page<StoredEvent>, RequestError> {
    read(&format!("/api/v1/runs/{}/events?after={after}&limit={LIMIT}", escaped(run))).await
}

/// Runs, newest first, from where an earlier answer ended.
pub(crate) async fn runs(after: Option<&str>) -> Result<Page<RunView>, RequestError> {
    let after = after.map(|after| format!("&after={}", escaped(after))).unwrap_or_default();
    read(&format!("/api/v1/runs?limit=50{after}")).await
}

/// The file of a revision.
pub(crate) async fn revision(specification: &str, number: u64) -> Result<String, RequestError> {
    let address =
        format!("/api/v1/specifications/{}/revisions/{number}/specification", escaped(specification));
    let response = Request::get(&address).send().await.map_err(|_| RequestError::Unreachable)?;
    accepted(response).await?.text().await.map_err(|error| RequestError::Unreadable(error.to_string()))
}

/// Tells an executor what to do.
pub(crate) async fn order(executor: &str, command: Command) -> Result<(), RequestError> {
    let address = format!("/api/v1/executors/{}/commands", escaped(executor));
    let request = Request::post(&address).json(&CommandRequest { command });
    let request = request.map_err(|error| RequestError::Unreadable(error.to_string()))?;
    accepted(request.send().await.map_err(|_| RequestError::Unreachable)?).await.map(|_| ())
}

async fn read<T: DeserializeOwned>(address: &str) -> Result<T, RequestError> {
    let response = Request::get(address).send().await.map_err(|_| RequestError::Unreachable)?;
    accepted(response).await?.json().await.map_err(|error| RequestError::Unreadable(error.to_string()))
}

async fn accepted(response: Response) -> Result<Response, RequestError> {
    if response.ok() {
        return Ok(response);
    }
    let status = response.status();
    let problem = response.json::<Problem>().await;
    Err(RequestError::Refused(problem.map_or_else(|_| format!("status {status}"), |problem| problem.detail)))
}

fn escaped(text: &str) -> String {
    js_sys::encode_uri_component(text).into()
}
