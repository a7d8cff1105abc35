//! Who gets the lease of a run.

use std::sync::Arc;

use goalgraph::protocol::executor::{Denial, Refusal, ToExecutor};

use super::lease::Lease;
use super::offer::Offer;
use super::refusal::{denied, is_id, refused_in, unavailable};
use super::relayed_run::now_ms;
use super::writer::Begin;
use super::{Inner, RelayError, archive};
use crate::store::{NewRun, StoreError};

/// Gives the lease of a run, or says why not.
///
/// A new run begins with the approved revision, which the executor has accepted. A run that exists goes on with its own
/// revision, even when another was approved meanwhile, with the executor that holds it; with another once the lease has
/// ended.
pub(super) async fn begin(relay: &Arc<Inner>, asked: &Begin) -> ToExecutor {
    if !is_id(&asked.run) {
        return denied(&asked.run, Denial::BadId);
    }
    let result = match is_known(relay, &asked.run).await {
        Ok(true) => go_on(relay, asked).await,
        Ok(false) => start(relay, asked).await,
        // There is such a run, but its specification was deleted.
        Err(RelayError::Store(StoreError::NotFound { .. })) => Ok(denied(&asked.run, Denial::Stale)),
        Err(error) => Err(error),
    };
    result.unwrap_or_else(|error| {
        relay.counts.refuse();
        tracing::warn!(run = asked.run, %error, "a run could not be begun");
        unavailable(&asked.run, None)
    })
}

/// Whether there is such a run; reads it of the store when it is not in memory.
async fn is_known(relay: &Inner, id: &str) -> Result<bool, RelayError> {
    if relay.hub().runs.contains_key(id) {
        return Ok(true);
    }
    let row = match relay.store.run(id).await {
        Err(StoreError::NotFound { .. }) => return Ok(false),
        row => row?,
    };
    let (_, automaton) = archive::revision(&relay.store, &row.specification, row.revision).await?;
    let run = archive::follow(&relay.store, row, automaton).await?;
    relay.hub().take_in(run);
    Ok(true)
}

async fn go_on(relay: &Inner, asked: &Begin) -> Result<ToExecutor, RelayError> {
    let Some((holder, stored)) = (match may_go_on(relay, asked) {
        Ok(standing) => standing,
        Err(reply) => return Ok(reply),
    }) else {
        return Ok(unavailable(&asked.run, None));
    };
    if holder != asked.asker.executor {
        relay.store.hand_over_run(&asked.run, &asked.asker.executor).await?;
    }
    Ok(grant(relay, asked, stored))
}

/// Who held the run and how many events it has, unless the lease is not to be had.
fn may_go_on(relay: &Inner, asked: &Begin) -> Result<Option<(String, u64)>, ToExecutor> {
    let hub = relay.hub();
    let Some(run) = hub.runs.get(&asked.run) else { return Ok(None) };
    if run.origin.sha256 != asked.sha256 {
        return Err(denied(&asked.run, Denial::OtherSpecification));
    }
    if run.run.phase.is_over() {
        return Err(denied(&asked.run, Denial::Over));
    }
    // An executor counts from when it last heard, which may be as much later as an answer took.
    let lasting = relay.limits.lease * 2;
    let is_held = match &run.lease {
        Some(lease) => lease.executor != asked.asker.executor && lease.presence.is_live(lasting),
        // Whoever held it before the server was started again may still be at work.
        None => run.origin.executor != asked.asker.executor && relay.since.elapsed() < lasting,
    };
    if is_held {
        return Err(denied(&asked.run, Denial::Held));
    }
    if hub.leases_of(asked.asker.link, &asked.run) >= relay.limits.leases {
        return Err(too_many(relay, &asked.run));
    }
    Ok(Some((run.origin.executor.clone(), run.run.events)))
}

async fn start(relay: &Inner, asked: &Begin) -> Result<ToExecutor, RelayError> {
    let offer = asked.offers.borrow().clone().filter(|offer| offer.row.sha256 == asked.sha256);
    let Some(offer) = offer else { return Ok(denied(&asked.run, Denial::Stale)) };
    if !relay.hub().has_accepted(&asked.asker.executor, &asked.sha256) {
        return Ok(denied(&asked.run, Denial::NotAccepted));
    }
    if relay.hub().leases_of(asked.asker.link, &asked.run) >= relay.limits.leases {
        return Ok(too_many(relay, &asked.run));
    }
    let row = match relay.store.begin_run(new_run(asked, &offer)).await {
        // Deleted since it was offered.
        Err(StoreError::NotFound { .. }) => return Ok(denied(&asked.run, Denial::Stale)),
        row => row?,
    };
    relay.hub().take_in(archive::begin(row, offer.automaton.clone()));
    Ok(grant(relay, asked, 0))
}

fn new_run(asked: &Begin, offer: &Offer) -> NewRun {
    NewRun {
        id: asked.run.clone(),
        executor: asked.asker.executor.clone(),
        specification: offer.row.specification.clone(),
        revision: offer.row.revision,
        sha256: offer.row.sha256.clone(),
        at_ms: now_ms(),
    }
}

/// Gives the lease to the connection that asked, if it is still the one of its executor.
fn grant(relay: &Inner, asked: &Begin, stored: u64) -> ToExecutor {
    let asker = &asked.asker;
    let mut hub = relay.hub();
    let presence = hub.linked(&asker.executor, asker.link).and_then(|executor| executor.presence.clone());
    if let Some(presence) = presence {
        let lease = Lease { executor: asker.executor.clone(), link: asker.link, presence };
        hub.grant(&asked.run, lease);
    }
    ToExecutor::Granted { run: asked.run.clone(), stored }
}

fn too_many(relay: &Inner, run: &str) -> ToExecutor {
    relay.counts.refuse();
    let limit = relay.limits.leases;
    let message =
        format!("run {run}: the executor is in {limit} runs, the most that are taken; end one first");
    refused_in(run, Refusal::TooMany, message, None)
}
