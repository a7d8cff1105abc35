//! One executor's connection, from welcome to close.

use std::sync::Arc;

use axum::extract::ws::Message;
use goalgraph::protocol::executor::{Command, Refusal, ToExecutor};
use governor::{DefaultDirectRateLimiter, Quota, RateLimiter};
use tokio::sync::{mpsc, watch};
use tokio::time::{Interval, MissedTickBehavior, interval, sleep_until, timeout};

use super::Inner;
use super::lease::Presence;
use super::offer::Offered;
use super::outgoing::{Ending, Line, text_of};

/// An executor that has said hello.
pub(super) struct Connection {
    pub(super) relay: Arc<Inner>,
    pub(super) executor: String,
    /// Its number: a later connection of the same executor has another.
    pub(super) link: u64,
    pub(super) line: Line,
    pub(super) presence: Arc<Presence>,
    pub(super) rate: DefaultDirectRateLimiter,
    pub(super) strikes: u32,
    pub(super) offers: watch::Receiver<Offered>,
    commands: watch::Receiver<Option<Command>>,
    pub(super) replies: mpsc::Sender<ToExecutor>,
    answers: mpsc::Receiver<ToExecutor>,
    /// How many jobs have no answer yet.
    pub(super) in_flight: usize,
    /// SHA-256 of the specifications sent before the present one, the last ones.
    pub(super) sent_before: Vec<String>,
    pings: Interval,
}

/// What a connection waits for.
enum Turn {
    Ended(Ending),
    Offer,
    Command,
    Answer(ToExecutor),
    Said(Message),
    Ping,
}

impl Connection {
    /// A connection that has said nothing yet.
    pub(super) fn new(
        relay: Arc<Inner>,
        executor: String,
        link: u64,
        line: Line,
        presence: Arc<Presence>,
        offers: watch::Receiver<Offered>,
        commands: watch::Receiver<Option<Command>>,
    ) -> Self {
        let quota = Quota::per_second(relay.limits.messages_per_second).allow_burst(relay.limits.burst);
        let (replies, answers) = mpsc::channel(relay.limits.in_flight.max(1));
        let mut pings = interval(relay.limits.heartbeat);
        pings.set_missed_tick_behavior(MissedTickBehavior::Delay);
        pings.reset();
        Self {
            relay,
            executor,
            link,
            line,
            presence,
            rate: RateLimiter::direct(quota),
            strikes: 0,
            offers,
            commands,
            replies,
            answers,
            in_flight: 0,
            sent_before: Vec::new(),
            pings,
        }
    }

    /// Talks until the connection ends, and returns how.
    pub(super) async fn talk(&mut self) -> Ending {
        match self.try_to_talk().await {
            Ok(never) => match never {},
            Err(ending) => ending,
        }
    }

    async fn try_to_talk(&mut self) -> Result<std::convert::Infallible, Ending> {
        let limits = self.relay.limits;
        self.send(&ToExecutor::Welcome {
            heartbeat_ms: limits.heartbeat.as_millis() as u64,
            lease_ms: limits.lease.as_millis() as u64,
            max_message_bytes: limits.message_bytes as u64,
        })
        .await?;
        self.send_offer().await?;
        loop {
            match self.next().await {
                Turn::Ended(ending) => return Err(ending),
                Turn::Offer => self.send_offer().await?,
                Turn::Command => self.send_command().await?,
                Turn::Answer(answer) => self.send_answers(answer).await?,
                Turn::Said(message) => self.hear(message).await?,
                Turn::Ping => self.line.send(Message::Ping(Vec::new().into())).await?,
            }
        }
    }

    /// What happens next. While as many jobs are under way as may be, nothing is read and nobody is silent.
    async fn next(&mut self) -> Turn {
        let listens = self.in_flight < self.relay.limits.in_flight.max(1);
        let silent_at = self.presence.heard_at() + self.relay.limits.lease;
        let line = &mut self.line;
        let hear = async { if listens { line.receive().await } else { Err(line.stopped().await) } };
        tokio::select! {
            biased;
            Ok(()) = self.offers.changed() => Turn::Offer,
            Ok(()) = self.commands.changed() => Turn::Command,
            Some(answer) = self.answers.recv() => Turn::Answer(answer),
            said = hear => said.map_or_else(Turn::Ended, Turn::Said),
            _ = self.pings.tick() => Turn::Ping,
            () = sleep_until(silent_at), if listens => Turn::Ended(Ending::silent()),
        }
    }

    /// Sends a message.
    ///
    /// # Errors
    ///
    /// When the connection ends instead.
    pub(super) async fn send(&mut self, message: &ToExecutor) -> Result<(), Ending> {
        self.line.send(Message::Text(text_of(message))).await
    }

    /// Sends what is approved now.
    async fn send_offer(&mut self) -> Result<(), Ending> {
        let offered = self.offers.borrow_and_update().clone();
        let held = offered.as_ref().map(|offer| offer.held());
        self.remember_sent();
        self.relay.hub().hold(&self.executor, self.link, held);
        match offered {
            Some(offer) => self.line.send(Message::Text(offer.message.clone())).await,
            None => self.send(&ToExecutor::Withdrawn).await,
        }
    }

    async fn send_command(&mut self) -> Result<(), Ending> {
        let command = *self.commands.borrow_and_update();
        match command {
            Some(command) => self.send(&ToExecutor::Command { command }).await,
            None => Ok(()),
        }
    }

    /// Sends the answer and those that wait behind it; of acknowledgments of a run in a row, the last.
    async fn send_answers(&mut self, first: ToExecutor) -> Result<(), Ending> {
        let mut present = first;
        self.answered();
        while let Ok(next) = self.answers.try_recv() {
            self.answered();
            if !says_more(&next, &present) {
                self.send(&present).await?;
            }
            present = next;
        }
        self.send(&present).await
    }

    fn answered(&mut self) {
        if self.in_flight >= self.relay.limits.in_flight.max(1) {
            // It was not listened to: what it said meanwhile was not heard.
            self.presence.hear();
        }
        self.in_flight -= 1;
    }

    /// Waits for the answers of the jobs under way and sends them, because what was stored should be known to be.
    pub(super) async fn settle(&mut self) {
        let patience = self.relay.limits.send;
        let settling = async {
            while self.in_flight > 0 {
                let Some(answer) = self.answers.recv().await else { return };
                self.in_flight -= 1;
                if self.line.send_last(Message::Text(text_of(&answer))).await.is_err() {
                    return;
                }
            }
        };
        // Whoever does not read is told again after connecting again.
        let _ = timeout(patience, settling).await;
    }
}

/// Whether `next` acknowledges everything that `present` does, or says the same.
fn says_more(next: &ToExecutor, present: &ToExecutor) -> bool {
    match (next, present) {
        (ToExecutor::Acknowledged { run, number }, ToExecutor::Acknowledged { run: of, number: before }) => {
            run == of && number >= before
        }
        (ToExecutor::Refused { reason: Refusal::Unavailable, .. }, _) => next == present,
        _ => false,
    }
}
