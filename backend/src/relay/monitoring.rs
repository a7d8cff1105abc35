//! One monitor's connection: the snapshot, then what has changed since it was told last.

use std::sync::Arc;

use axum::extract::ws::{Message, WebSocket};
use tokio::sync::watch;
use tokio::time::{Instant, MissedTickBehavior, interval, sleep};

use super::Inner;
use super::inbox::Inbox;
use super::outgoing::{Ending, Line, text_of};

/// How many pings may go unanswered before the connection is given up.
const PINGS: u32 = 4;

/// Serves a monitor until its connection ends.
pub(super) async fn serve(relay: Arc<Inner>, socket: WebSocket, token: Option<String>) {
    let (stop, stopped) = watch::channel(None);
    let _listed = relay.lines.list(token, stop);
    let mut line = Line::new(socket, stopped, relay.limits.send);
    let watching = Watching::begin(&relay);
    let ending = match watching.tell(&mut line).await {
        Ok(never) => match never {},
        Err(ending) => ending,
    };
    drop(watching);
    line.end(ending).await;
}

/// A monitor's place in the hub, until it is dropped.
struct Watching {
    relay: Arc<Inner>,
    inbox: Arc<Inbox>,
    number: u64,
}

impl Drop for Watching {
    fn drop(&mut self) {
        self.relay.hub().monitors.remove(&self.number);
    }
}

impl Watching {
    fn begin(relay: &Arc<Inner>) -> Self {
        let inbox = Arc::new(Inbox::default());
        let mut hub = relay.hub();
        let number = hub.next_number();
        hub.monitors.insert(number, inbox.clone());
        drop(hub);
        Self { relay: relay.clone(), inbox, number }
    }

    /// Tells everything, then changes, until the connection ends.
    async fn tell(&self, line: &mut Line) -> Result<std::convert::Infallible, Ending> {
        let limits = &self.relay.limits;
        // What changes from here on is in the snapshot, in the inbox or in both.
        let snapshot = self.relay.hub().snapshot();
        line.send(Message::Text(text_of(&snapshot))).await?;
        let mut pings = interval(limits.heartbeat);
        pings.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut heard = Instant::now();
        loop {
            tokio::select! {
                biased;
                said = line.receive() => {
                    hear(&said?)?;
                    heard = Instant::now();
                }
                _ = pings.tick() => {
                    if heard.elapsed() > limits.heartbeat * PINGS {
                        return Err(Ending::Gone);
                    }
                    line.send(Message::Ping(Vec::new().into())).await?;
                }
                () = self.inbox.changed() => {
                    let changes = self.relay.hub().changes(&self.inbox);
                    if let Some(changes) = changes {
                        line.send(Message::Text(text_of(&changes))).await?;
                        // What changes meanwhile is told together.
                        sleep(limits.monitor_pause).await;
                    }
                }
            }
        }
    }
}

/// A monitor has nothing to say.
fn hear(message: &Message) -> Result<(), Ending> {
    match message {
        Message::Ping(_) | Message::Pong(_) => Ok(()),
        Message::Close(_) => Err(Ending::Gone),
        Message::Text(_) | Message::Binary(_) => Err(Ending::protocol()),
    }
}
