//! What the robot does about each message of the server.

use std::time::Duration;

use goalgraph::protocol::executor::{Command, Denial, FromExecutor, Refusal, ToExecutor};

use super::Session;
use super::specification::{Offer, examine};

impl Session {
    /// A message of the server was read.
    pub fn heard(&mut self, message: ToExecutor) {
        self.silence = Duration::ZERO;
        match message {
            ToExecutor::Welcome { heartbeat_ms, lease_ms, .. } => self.welcome(heartbeat_ms, lease_ms),
            ToExecutor::Specification { specification, revision, approval, sha256, content } => {
                let (sha256, content) = (&sha256, &content);
                self.consider(&Offer { specification: &specification, revision, approval, sha256, content });
            }
            ToExecutor::Withdrawn => {
                self.held = None;
                self.lines.push("nothing is approved: no run may begin".to_owned());
            }
            ToExecutor::Granted { run, stored } => self.granted(&run, stored),
            ToExecutor::Denied { run, reason, message } => self.denied(&run, reason, &message),
            ToExecutor::Acknowledged { run, number } => self.acknowledged(&run, number),
            ToExecutor::Command { command } => self.obey(command),
            ToExecutor::Heartbeat => self.send_again(),
            ToExecutor::Refused { reason, message, run, expected } => {
                self.refused(reason, &message, run.as_deref(), expected);
            }
        }
    }

    fn welcome(&mut self, heartbeat_ms: u64, lease_ms: u64) {
        self.welcomed = true;
        self.heartbeat = Duration::from_millis(heartbeat_ms);
        self.lease = Duration::from_millis(lease_ms);
        self.lines.push(format!("welcomed as {:?}", self.settings.name));
        // Whatever is approved by now: a run that has begun goes on.
        self.ask_again();
    }

    fn ask_again(&mut self) {
        if let Some(work) = &self.work {
            let (run, sha256) = (work.id.clone(), work.sha256.clone());
            self.messages.push(FromExecutor::Begin { run, sha256 });
        }
    }

    fn consider(&mut self, offer: &Offer) {
        let last = self.approvals.get(offer.specification).copied().unwrap_or(0);
        match examine(offer, last) {
            Ok(held) => {
                self.lines.push(format!("accepted {}", held.name()));
                self.messages.push(FromExecutor::Accepted { sha256: held.sha256.clone() });
                self.fresh |= offer.approval != self.accepted_last;
                self.accepted_last = offer.approval;
                self.approvals.insert(offer.specification.to_owned(), offer.approval);
                self.held = Some(held);
                self.begin_by_itself();
            }
            Err(reason) => {
                self.held = None;
                self.lines.push(format!("rejected r{}: {reason}", offer.revision));
                self.messages.push(FromExecutor::Rejected { sha256: offer.sha256.to_owned(), reason });
            }
        }
    }

    fn granted(&mut self, run: &str, stored: u64) {
        let Some(work) = self.work.as_mut().filter(|work| work.id == run) else {
            return;
        };
        match work.grant(stored, self.at_ms) {
            Ok(first) => {
                let kept = work.messages_from(stored + 1);
                if first.is_empty() {
                    self.lines.push(format!("run {run} goes on, {} events are sent again", kept.len()));
                    self.messages.extend(kept);
                }
                self.report(&first);
                self.settle();
            }
            Err(why) => self.give_up(&why),
        }
    }

    fn denied(&mut self, run: &str, reason: Denial, message: &str) {
        let Some(work) = self.work.as_ref().filter(|work| work.id == run) else {
            return;
        };
        // All is stored, only the acknowledgement was lost.
        let told_before = reason == Denial::Over && work.phase().is_over();
        self.give_up(if told_before { "it is over and stored" } else { message });
    }

    fn acknowledged(&mut self, run: &str, number: u64) {
        if let Some(work) = self.work.as_mut().filter(|work| work.id == run) {
            work.stored(number);
            self.settle();
        }
    }

    fn refused(&mut self, reason: Refusal, message: &str, run: Option<&str>, expected: Option<u64>) {
        self.lines.push(format!("refused: {message}"));
        if self.work.as_ref().is_none_or(|work| run.is_some_and(|run| run != work.id)) {
            return;
        }
        match reason {
            Refusal::Gap => self.send_from(expected.unwrap_or(1)),
            Refusal::NoLease => self.ask_again(),
            Refusal::TooMany | Refusal::Unavailable => self.put_off(),
            Refusal::Conflict | Refusal::Over => self.give_up(message),
            Refusal::Malformed | Refusal::OutOfTurn | Refusal::UnknownSpecification => {}
        }
    }

    fn put_off(&mut self) {
        if let Some(work) = &mut self.work {
            work.put_off = true;
        }
    }

    /// What the server could not take before a heartbeat, it may take now.
    fn send_again(&mut self) {
        if self.work.as_mut().is_some_and(|work| std::mem::take(&mut work.put_off)) {
            if self.work.as_ref().is_some_and(|work| work.granted) {
                self.send_from(1);
            } else {
                self.ask_again();
            }
        }
    }

    fn send_from(&mut self, number: u64) {
        if let Some(work) = self.work.as_ref().filter(|work| work.granted) {
            self.messages.extend(work.messages_from(number));
        }
    }
}

/// The command in a word.
pub(super) fn word(command: Command) -> &'static str {
    match command {
        Command::Start => "start",
        Command::Pause => "pause",
        Command::Resume => "resume",
        Command::Stop => "stop",
    }
}
