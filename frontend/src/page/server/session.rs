//! Who asks.

use gloo_net::http::Request;
use goalgraph::protocol::api::{Login, Session};

use super::ROOT;
use super::answer::{Failure, ask, read, send};

/// Who asks, as the server sees it; none when nothing there answers like Goalgraph.
///
/// # Errors
///
/// When it does not answer at all, or asks for a token.
pub(crate) async fn session() -> Result<Option<Session>, Failure> {
    match ask(Request::get(&format!("{ROOT}/session"))).await {
        Ok(response) => Ok(read(response).await.ok().map(|it| it.value)),
        // Somebody who only hands out files knows no such address.
        Err(Failure::Strange(_)) => Ok(None),
        Err(Failure::Refused(problem)) if problem.status == 404 => Ok(None),
        Err(failure) => Err(failure),
    }
}

/// Shows the server a token. The browser keeps what it answers where no script can read it.
///
/// # Errors
///
/// When the server does not know it.
pub(crate) async fn log_in(token: String) -> Result<(), Failure> {
    send(Request::post(&format!("{ROOT}/session")).json(&Login { token })).await.map(drop)
}
