//! How an executor becomes known: the hello, and the place that it takes until its connection ends.

use std::sync::Arc;

use axum::extract::ws::{Message, WebSocket};
use goalgraph::protocol::executor::{Command, FromExecutor, MAX_ID, Refusal};
use tokio::sync::watch;
use tokio::time::timeout;

use super::Inner;
use super::connection::Connection;
use super::hub::{Caller, Link};
use super::incoming::{binary, parse};
use super::lease::Presence;
use super::offer::{Follow, Offered};
use super::outgoing::{Ending, Line, text_of};
use super::refusal::{is_id, refused};

/// Longest name of an executor's software that is kept, in characters.
const MAX_SOFTWARE: usize = 200;

/// Serves an executor until its connection ends.
pub(super) async fn serve(relay: Arc<Inner>, socket: WebSocket, token: Option<String>, follow: Follow) {
    let (stop, stopped) = watch::channel(None);
    let _listed = relay.lines.list(token.clone(), stop.clone());
    let mut line = Line::new(socket, stopped, relay.limits.send);
    let ending = match greet(&relay, &mut line, token).await {
        Err(ending) => ending,
        Ok(caller) => match relay.offers.follow(&relay.store, follow).await {
            Err(_) => Ending::unavailable(),
            Ok(offers) => return run(relay, line, caller, stop, offers).await,
        },
    };
    line.end(ending).await;
}

/// Waits for the hello.
async fn greet(relay: &Inner, line: &mut Line, token: Option<String>) -> Result<Caller, Ending> {
    let hello = async {
        loop {
            match line.receive().await? {
                Message::Text(text) => return Ok(parse(&text, relay.limits.message_bytes)),
                Message::Binary(_) => return Ok(Err(binary())),
                Message::Close(_) => return Err(Ending::Gone),
                Message::Ping(_) | Message::Pong(_) => {}
            }
        }
    };
    let first = timeout(relay.limits.lease, hello).await.map_err(|_| Ending::silent())??;
    let reply = match first {
        Ok(FromExecutor::Hello { executor, software }) if is_id(&executor) => {
            let software = software.map(|it| it.chars().take(MAX_SOFTWARE).collect());
            return Ok(Caller { executor, software, token });
        }
        Ok(FromExecutor::Hello { .. }) => refused(
            Refusal::Malformed,
            format!("the name of an executor has 1 to {MAX_ID} characters, none of them a control character"),
        ),
        Ok(_) => refused(Refusal::OutOfTurn, "the first message must be the hello"),
        Err(reply) => reply,
    };
    relay.counts.refuse();
    line.send(Message::Text(text_of(&reply))).await?;
    Err(Ending::protocol())
}

/// Serves an executor that has said hello.
async fn run(
    relay: Arc<Inner>,
    line: Line,
    caller: Caller,
    stop: watch::Sender<Option<Ending>>,
    offers: watch::Receiver<Offered>,
) {
    let executor = caller.executor.clone();
    let presence = Presence::begin();
    let Some((link, commands)) = register(&relay, caller, &presence, stop) else {
        return line.end(Ending::taken()).await;
    };
    let mut connection =
        Connection::new(relay.clone(), executor.clone(), link, line, presence.clone(), offers, commands);
    let present = Present { relay, executor, link, presence };
    let ending = connection.talk().await;
    if ending == Ending::closing() {
        connection.settle().await;
    }
    drop(present);
    connection.line.end(ending).await;
}

/// An executor is connected until this is dropped, however that comes about.
struct Present {
    relay: Arc<Inner>,
    executor: String,
    link: u64,
    presence: Arc<Presence>,
}

impl Drop for Present {
    fn drop(&mut self) {
        self.presence.end();
        self.relay.hub().disconnect(&self.executor, self.link);
    }
}

/// Takes the place of the executor's connection before, unless another token speaks for it.
fn register(
    relay: &Inner,
    caller: Caller,
    presence: &Arc<Presence>,
    stop: watch::Sender<Option<Ending>>,
) -> Option<(u64, watch::Receiver<Option<Command>>)> {
    let mut hub = relay.hub();
    if hub.is_taken(&caller.executor, caller.token.as_deref(), relay.limits.lease) {
        return None;
    }
    let number = hub.next_number();
    let (commands, received) = watch::channel(None);
    hub.connect(caller, presence.clone(), Link { number, stop, commands });
    Some((number, received))
}
