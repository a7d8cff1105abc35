//! What an executor says, and what comes of it.

use axum::extract::ws::Message;
use goalgraph::protocol::executor::{FromExecutor, Refusal, ToExecutor};
use goalgraph::protocol::monitor::Answer;

use super::connection::Connection;
use super::outgoing::Ending;
use super::refusal::{refused, refused_in};
use super::writer::{Asker, Begin, Event, Job};

/// Longest reason of a rejection that is kept, in characters.
const MAX_REASON: usize = 1000;

/// How many of the specifications sent before the present one an executor may still answer.
const SENT_BEFORE: usize = 16;

/// The least memory that a job is counted as, in bytes.
const SMALLEST_JOB: usize = 512;

/// A message of the protocol, or what its sender is told.
///
/// # Errors
///
/// When it is too long or no message of the protocol.
pub(super) fn parse(text: &str, limit: usize) -> Result<FromExecutor, ToExecutor> {
    if text.len() > limit {
        let message = format!("the message has {} bytes; {limit} are taken", text.len());
        return Err(refused(Refusal::Malformed, message));
    }
    serde_json::from_str(text).map_err(|error| {
        // The error may repeat what it found.
        let error: String = error.to_string().chars().take(MAX_REASON).collect();
        refused(Refusal::Malformed, format!("this is no message of the protocol: {error}"))
    })
}

/// What is said to a message that is not text.
pub(super) fn binary() -> ToExecutor {
    refused(Refusal::Malformed, "a message must be text, and this one is binary")
}

impl Connection {
    /// Does what a message asks for.
    ///
    /// # Errors
    ///
    /// When the connection ends for it.
    pub(super) async fn hear(&mut self, message: Message) -> Result<(), Ending> {
        let text = match message {
            Message::Text(text) => text,
            Message::Binary(_) => return self.break_off(binary()).await,
            Message::Close(_) => return Err(Ending::Gone),
            Message::Ping(_) | Message::Pong(_) => return Ok(()),
        };
        self.presence.hear();
        let said = match parse(&text, self.relay.limits.message_bytes) {
            Ok(said) => said,
            Err(reply) => return self.break_off(reply).await,
        };
        if self.rate.check().is_err() {
            return self.strike(&said).await;
        }
        match said {
            FromExecutor::Hello { .. } => {
                let message = "the hello came twice; it is the first message and no other";
                self.break_off(refused(Refusal::OutOfTurn, message)).await
            }
            FromExecutor::Heartbeat => self.send(&ToExecutor::Heartbeat).await,
            FromExecutor::Accepted { sha256 } => self.answer(&sha256, Answer::Accepted).await,
            FromExecutor::Rejected { sha256, reason } => {
                let reason = reason.chars().take(MAX_REASON).collect();
                self.answer(&sha256, Answer::Rejected { reason }).await
            }
            FromExecutor::Begin { run, sha256 } => {
                let asker = self.asker(text.len()).await?;
                let offers = self.offers.clone();
                self.give(Job::Begin(Begin { asker, run, sha256, offers })).await
            }
            FromExecutor::Event { run, number, at_ms, happened } => {
                let asker = self.asker(text.len()).await?;
                self.give(Job::Event(Event { asker, run, number, at_ms, happened })).await
            }
        }
    }

    /// Says what is wrong, and ends.
    async fn break_off(&mut self, reply: ToExecutor) -> Result<(), Ending> {
        self.refuse(&reply).await?;
        Err(Ending::protocol())
    }

    /// Refuses a message because there are too many; ends when that does not help.
    async fn strike(&mut self, said: &FromExecutor) -> Result<(), Ending> {
        let message = "more messages than the server takes in a second; send this one again later";
        let reply = match said {
            FromExecutor::Event { run, .. } | FromExecutor::Begin { run, .. } => {
                refused_in(run, Refusal::TooMany, message, None)
            }
            _ => refused(Refusal::TooMany, message),
        };
        self.strikes += 1;
        self.refuse(&reply).await?;
        if self.strikes > self.relay.limits.strikes { Err(Ending::flood()) } else { Ok(()) }
    }

    async fn refuse(&mut self, reply: &ToExecutor) -> Result<(), Ending> {
        self.relay.counts.refuse();
        self.send(reply).await
    }

    async fn answer(&mut self, sha256: &str, answer: Answer) -> Result<(), Ending> {
        let is_present = self.relay.hub().answer(&self.executor, self.link, sha256, answer);
        // The answer to one that another has replaced meanwhile is late, not wrong.
        if is_present || self.sent_before.iter().any(|before| before == sha256) {
            return Ok(());
        }
        let message = "no specification with this SHA-256 was sent on this connection";
        self.refuse(&refused(Refusal::UnknownSpecification, message)).await
    }

    /// Keeps in mind what was sent until now, before something else is.
    pub(super) fn remember_sent(&mut self) {
        let mut hub = self.relay.hub();
        let held = hub.linked(&self.executor, self.link).and_then(|it| it.holds.as_ref());
        if let Some(held) = held {
            self.sent_before.push(held.sha256.clone());
        }
        drop(hub);
        let too_many = self.sent_before.len().saturating_sub(SENT_BEFORE);
        self.sent_before.drain(..too_many);
    }

    /// Waits until there is memory for a job of this size.
    async fn asker(&mut self, bytes: usize) -> Result<Asker, Ending> {
        let rooms = self.relay.rooms.clone();
        let size = bytes.max(SMALLEST_JOB).min(self.relay.limits.queue_bytes) as u32;
        let room = tokio::select! {
            room = rooms.acquire_many_owned(size) => room.map_err(|_| Ending::closing())?,
            ending = self.line.stopped() => return Err(ending),
        };
        Ok(Asker {
            executor: self.executor.clone(),
            link: self.link,
            replies: self.replies.clone(),
            _room: room,
        })
    }

    /// Hands a job over, which will be answered.
    async fn give(&mut self, job: Job) -> Result<(), Ending> {
        let jobs = self.relay.jobs.clone();
        tokio::select! {
            given = jobs.send(job) => given.map_err(|_| Ending::closing())?,
            ending = self.line.stopped() => return Err(ending),
        }
        self.in_flight += 1;
        Ok(())
    }
}
