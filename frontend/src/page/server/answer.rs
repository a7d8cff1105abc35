//! What the server answers, and how it says no.

use gloo_net::http::{Request, RequestBuilder, Response};
use goalgraph::protocol::api::{Page, Problem};
use serde::de::DeserializeOwned;
use thiserror::Error;

/// Why there is no answer that can be used.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum Failure {
    /// The server does not answer.
    #[error("the server does not answer")]
    Unreachable,
    /// It asks for a token.
    #[error("the server asks for a token")]
    Locked,
    /// It says no.
    #[error("{}", .0.detail)]
    Refused(Box<Problem>),
    /// It answers something that this page does not understand.
    #[error("the server answers what this page does not understand: {0}")]
    Strange(String),
}

/// An answer with its entity tag.
pub(crate) struct Tagged<T> {
    /// The answer.
    pub(crate) value: T,
    /// The tag; empty when there is none.
    pub(crate) etag: String,
}

/// Sends a request without a body.
pub(super) async fn ask(request: RequestBuilder) -> Result<Response, Failure> {
    send(request.build()).await
}

/// Sends a request.
pub(super) async fn send(request: Result<Request, gloo_net::Error>) -> Result<Response, Failure> {
    let request = request.map_err(|error| Failure::Strange(error.to_string()))?;
    let response = request.send().await.map_err(|_| Failure::Unreachable)?;
    match response.status() {
        200..=299 => Ok(response),
        401 => Err(Failure::Locked),
        // Something in between, or the server itself, has no time at the moment.
        502..=504 => Err(Failure::Unreachable),
        status => Err(match response.json::<Problem>().await {
            Ok(problem) => Failure::Refused(Box::new(problem)),
            Err(_) => Failure::Strange(format!("status {status}")),
        }),
    }
}

/// The JSON of an answer, with its tag.
pub(super) async fn read<T: DeserializeOwned>(response: Response) -> Result<Tagged<T>, Failure> {
    let etag = response.headers().get("etag").unwrap_or_default();
    let value = response.json().await.map_err(|error| Failure::Strange(error.to_string()))?;
    Ok(Tagged { value, etag })
}

/// How many parts of a list are asked for at most, and how long they are.
const PARTS: usize = 10;
const PART: usize = 100;

/// All of a list, up to a thousand entries.
pub(super) async fn all<T: DeserializeOwned>(address: &str) -> Result<Vec<T>, Failure> {
    let mut items = Vec::new();
    let mut after = String::new();
    for _ in 0..PARTS {
        let page: Page<T> =
            read(ask(Request::get(&format!("{address}?limit={PART}{after}"))).await?).await?.value;
        items.extend(page.items);
        match page.next {
            Some(next) => after = format!("&after={}", escaped(&next)),
            None => break,
        }
    }
    Ok(items)
}

/// A text as a part of an address.
pub(super) fn escaped(text: &str) -> String {
    js_sys::encode_uri_component(text).into()
}
