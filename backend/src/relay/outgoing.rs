//! How messages leave, and how connections end.

use std::time::Duration;

use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, close_code};
use goalgraph::protocol::executor::close;
use serde::Serialize;
use tokio::sync::watch;
use tokio::time::timeout;

/// How long the other end has to answer a close frame.
const FAREWELL: Duration = Duration::from_secs(1);

/// Why and how a connection ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ending {
    /// It is broken, or the other end has closed it.
    Gone,
    /// The other end does not read: nothing more can be sent.
    Slow,
    /// With a close frame.
    Close {
        /// Its code.
        code: u16,
        /// Its reason, at most 123 bytes.
        reason: &'static str,
    },
}

impl Ending {
    /// The program ends.
    pub(super) fn closing() -> Self {
        Self::Close { code: close_code::AWAY, reason: "the server is shutting down" }
    }

    /// Another connection took its place.
    pub(super) fn replaced() -> Self {
        Self::Close { code: close::REPLACED, reason: "another connection of this executor took its place" }
    }

    /// The token was revoked.
    pub(super) fn revoked() -> Self {
        Self::Close { code: close::REVOKED, reason: "the token was revoked" }
    }

    /// Nothing was heard.
    pub(super) fn silent() -> Self {
        Self::Close { code: close::SILENT, reason: "nothing was heard for longer than a lease lasts" }
    }

    /// A message was none, or came out of turn.
    pub(super) fn protocol() -> Self {
        Self::Close { code: close::PROTOCOL, reason: "a message was not understood or came out of turn" }
    }

    /// Too much was said.
    pub(super) fn flood() -> Self {
        Self::Close { code: close_code::POLICY, reason: "more messages than the server takes" }
    }

    /// Another token speaks for the executor.
    pub(super) fn taken() -> Self {
        Self::Close {
            code: close_code::POLICY,
            reason: "an executor of this name is connected with another token",
        }
    }

    /// The server cannot read what it needs.
    pub(super) fn unavailable() -> Self {
        Self::Close { code: close_code::AGAIN, reason: "the server cannot read its store; try again later" }
    }
}

/// A message as text.
pub(super) fn text_of(message: &impl Serialize) -> Utf8Bytes {
    // The messages hold nothing that JSON cannot: keys are text, numbers finite.
    serde_json::to_string(message).unwrap_or_default().into()
}

/// One end of a connection that is told when to end.
#[derive(Debug)]
pub(super) struct Line {
    socket: WebSocket,
    stop: watch::Receiver<Option<Ending>>,
    patience: Duration,
}

impl Line {
    /// A line that waits for `patience` until one message has gone out.
    pub(super) fn new(socket: WebSocket, stop: watch::Receiver<Option<Ending>>, patience: Duration) -> Self {
        Self { socket, stop, patience }
    }

    /// Sends one message.
    ///
    /// # Errors
    ///
    /// When the connection ends instead.
    pub(super) async fn send(&mut self, message: Message) -> Result<(), Ending> {
        tokio::select! {
            biased;
            sent = timeout(self.patience, self.socket.send(message)) => match sent {
                Ok(Ok(())) => Ok(()),
                Ok(Err(_)) => Err(Ending::Gone),
                Err(_) => Err(Ending::Slow),
            },
            ending = stopped(&mut self.stop) => Err(ending),
        }
    }

    /// Sends one message, although the connection was told to end.
    ///
    /// # Errors
    ///
    /// When it cannot be sent.
    pub(super) async fn send_last(&mut self, message: Message) -> Result<(), Ending> {
        self.socket.send(message).await.map_err(|_| Ending::Gone)
    }

    /// What is said next.
    ///
    /// # Errors
    ///
    /// When the connection ends instead. What cannot be read as a message of a WebSocket breaks the protocol.
    pub(super) async fn receive(&mut self) -> Result<Message, Ending> {
        tokio::select! {
            biased;
            ending = stopped(&mut self.stop) => Err(ending),
            said = self.socket.recv() => match said {
                Some(Ok(message)) => Ok(message),
                Some(Err(error)) if is_broken(&error) => Err(Ending::Gone),
                Some(Err(_)) => Err(Ending::protocol()),
                None => Err(Ending::Gone),
            },
        }
    }

    /// Waits until the connection is told to end.
    pub(super) async fn stopped(&mut self) -> Ending {
        stopped(&mut self.stop).await
    }

    /// Ends the connection: says why, and waits a moment for the other end to do the same, so that what was sent last
    /// arrives.
    pub(super) async fn end(mut self, ending: Ending) {
        let Ending::Close { code, reason } = ending else { return };
        let frame = CloseFrame { code, reason: Utf8Bytes::from_static(reason) };
        let farewell = async {
            if self.socket.send(Message::Close(Some(frame))).await.is_ok() {
                while let Some(Ok(_)) = self.socket.recv().await {}
            }
        };
        // Whoever does not answer is left all the same.
        let _ = timeout(FAREWELL, farewell).await;
    }
}

async fn stopped(stop: &mut watch::Receiver<Option<Ending>>) -> Ending {
    match stop.wait_for(Option::is_some).await {
        Ok(ending) => ending.unwrap_or(Ending::Gone),
        Err(_) => Ending::Gone,
    }
}

/// Whether the connection itself failed, rather than what came over it.
fn is_broken(error: &axum::Error) -> bool {
    let mut cause: Option<&(dyn std::error::Error + 'static)> = Some(error);
    while let Some(present) = cause {
        if present.is::<std::io::Error>() {
            return true;
        }
        cause = present.source();
    }
    false
}
