//! Events: checked, stored together, taken into account, acknowledged; in this order.

use std::collections::BTreeMap;

use goalgraph::protocol::executor::ToExecutor;

use super::refusal::{conflict, gap, no_lease, over, too_long, unavailable};
use super::relayed_run::{ends_run, now_ms};
use super::writer::Event;
use super::{Inner, RelayLimits};
use crate::store::{Appended, NewEvent, RunEvents};

/// Events of one run that may be stored, in their order.
struct Accepted {
    run: String,
    /// How many events the run has already.
    stored: u64,
    events: Vec<Event>,
}

/// Where a run will stand once what was accepted is stored: what decides whether the next event may come.
struct Ahead {
    events: u64,
    over: bool,
}

/// Stores the events, by run and in their order, and answers each.
pub(super) async fn store(relay: &Inner, events: BTreeMap<String, Vec<Event>>) {
    let accepted: Vec<Accepted> =
        events.into_iter().filter_map(|(run, events)| accept(relay, run, events)).collect();
    if accepted.is_empty() {
        return;
    }
    let at_ms = now_ms();
    let parts: Vec<RunEvents> = accepted.iter().map(|part| part.to_store(at_ms)).collect();
    match relay.store.append_to_runs(&parts).await {
        Ok(outcomes) => {
            for (part, outcomes) in accepted.into_iter().zip(outcomes) {
                take_into_account(relay, part, &outcomes, at_ms).await;
            }
        }
        Err(error) => {
            tracing::warn!(%error, "events could not be stored");
            for part in &accepted {
                part.events
                    .iter()
                    .for_each(|event| refuse(relay, event, unavailable(&part.run, Some(part.next()))));
            }
        }
    }
}

impl Accepted {
    fn next(&self) -> u64 {
        self.stored + 1
    }

    fn to_store(&self, received_at_ms: i64) -> RunEvents {
        let events = self.events.iter().map(|event| NewEvent {
            number: event.number,
            // A run event holds nothing that JSON cannot.
            event: serde_json::to_string(&event.happened).unwrap_or_default(),
            robot_at_ms: event.at_ms,
            received_at_ms,
        });
        RunEvents { run: self.run.clone(), events: events.collect() }
    }
}

/// The events of a run that may be stored; the others are refused.
fn accept(relay: &Inner, run: String, events: Vec<Event>) -> Option<Accepted> {
    let (link, mut ahead) = match relay.hub().runs.get(&run) {
        Some(known) => {
            let ahead = Ahead { events: known.run.events, over: known.run.phase.is_over() };
            (known.lease.as_ref().map(|lease| lease.link), ahead)
        }
        None => (None, Ahead { events: 0, over: false }),
    };
    let mut accepted = Accepted { run, stored: ahead.events, events: Vec::new() };
    for event in events {
        let fault = if link == Some(event.asker.link) {
            ahead.take(&event, &relay.limits)
        } else {
            Some(no_lease(&event.run))
        };
        match fault {
            None => accepted.events.push(event),
            Some(reply) => refuse(relay, &event, reply),
        }
    }
    (!accepted.events.is_empty()).then_some(accepted)
}

impl Ahead {
    /// Counts the event in, or says why it may not come. One whose number is known may: the store compares it.
    fn take(&mut self, event: &Event, limits: &RelayLimits) -> Option<ToExecutor> {
        let expected = self.events + 1;
        if (1..expected).contains(&event.number) {
            return None;
        }
        if event.number != expected {
            return Some(gap(&event.run, event.number, expected));
        }
        if self.over {
            return Some(over(&event.run, self.events));
        }
        let ends = ends_run(&event.happened);
        if self.events >= limits.events_per_run && !ends {
            return Some(too_long(&event.run, limits.events_per_run, expected));
        }
        self.events = expected;
        self.over = ends;
        None
    }
}

/// Follows the run through what is stored now, and answers each event.
async fn take_into_account(relay: &Inner, part: Accepted, outcomes: &[Appended], at_ms: i64) {
    let mut ended = false;
    for (event, outcome) in part.events.iter().zip(outcomes) {
        let reply = match outcome {
            Appended::Stored => {
                relay.counts.store();
                ended |= ends_run(&event.happened);
                follow(relay, event, at_ms)
            }
            // Stored, but the store could not say so: it counts now.
            Appended::Known if event.number == next_of(relay, &part.run) => {
                ended |= ends_run(&event.happened);
                follow(relay, event, at_ms)
            }
            Appended::Known => acknowledged(event),
            Appended::Different => conflict(&part.run, event.number, next_of(relay, &part.run)),
            Appended::Gap { expected } => gap(&part.run, event.number, *expected),
        };
        if !matches!(reply, ToExecutor::Acknowledged { .. }) {
            relay.counts.refuse();
        }
        event.asker.tell(reply);
    }
    if ended {
        relay.close_run(&part.run).await;
    }
}

fn next_of(relay: &Inner, run: &str) -> u64 {
    relay.hub().runs.get(run).map_or(1, |run| run.run.events + 1)
}

fn follow(relay: &Inner, event: &Event, at_ms: i64) -> ToExecutor {
    let mut hub = relay.hub();
    if let Err(error) = hub.follow(&event.run, event.number, &event.happened, at_ms) {
        // Somebody else wrote to the store. It is read again when the run goes on.
        tracing::error!(run = event.run, %error, "a run is not what the store has");
        hub.runs.remove(&event.run);
    }
    acknowledged(event)
}

fn acknowledged(event: &Event) -> ToExecutor {
    ToExecutor::Acknowledged { run: event.run.clone(), number: event.number }
}

fn refuse(relay: &Inner, event: &Event, reply: ToExecutor) {
    relay.counts.refuse();
    event.asker.tell(reply);
}
