//! What is done again and again: whatever the store could not do is tried again, and old runs leave the memory.

use std::sync::Weak;
use std::time::Duration;

use goalgraph::protocol::monitor::ApprovedView;
use goalgraph::run::Phase;
use tokio::time::sleep;

use super::Inner;
use super::relayed_run::now_ms;
use crate::store::RunChange;

/// The time between two rounds.
const PAUSE: Duration = Duration::from_secs(1);

/// Works until the relay is gone.
pub(super) async fn keep_up(relay: Weak<Inner>) {
    loop {
        sleep(PAUSE).await;
        let Some(relay) = relay.upgrade() else { return };
        for specification in relay.offers.behind().await {
            relay.refresh(&specification).await;
        }
        relay.close_runs().await;
        let limits = &relay.limits;
        relay.hub().forget_runs(limits.idle_runs, limits.finished_runs, limits.lease);
    }
}

impl Inner {
    /// Tells followers and monitors what is approved of a specification now.
    pub(super) async fn refresh(&self, specification: &str) {
        match self.offers.refresh(&self.store, specification).await {
            Ok(approved) => {
                let mut hub = self.hub();
                let known = hub.approved.get(specification).map(|view| view.name.clone());
                if known.is_none() && approved.is_none() {
                    return;
                }
                let revision = approved.as_ref().map(|row| row.revision);
                let name = approved.map(|row| row.name).or(known).unwrap_or_default();
                hub.mark_approved(ApprovedView { specification: specification.to_owned(), name, revision });
            }
            Err(error) => {
                tracing::warn!(specification, %error, "what is approved cannot be read; trying again");
            }
        }
    }

    async fn close_runs(&self) {
        let unclosed: Vec<String> = {
            let hub = self.hub();
            let runs = hub.runs.values().filter(|run| run.run.phase.is_over() && !run.closed);
            runs.map(|run| run.origin.run.clone()).collect()
        };
        for id in unclosed {
            self.close_run(&id).await;
        }
    }

    /// Notes in the store that a run is over, with how it went, so that it need not be read event by event.
    pub(super) async fn close_run(&self, id: &str) {
        let Some(view) = self.known_view(id) else { return };
        let change = RunChange {
            state: name_of(view.phase).to_owned(),
            is_open: false,
            at_ms: now_ms(),
            summary: serde_json::to_string(&view).ok(),
        };
        match self.store.set_run_state(id, change).await {
            Ok(_) => {
                if let Some(run) = self.hub().runs.get_mut(id) {
                    run.closed = true;
                }
            }
            Err(error) => tracing::warn!(run = id, %error, "the end of a run cannot be noted; trying again"),
        }
    }
}

fn name_of(phase: Phase) -> &'static str {
    match phase {
        Phase::Running => "running",
        Phase::Waiting => "waiting",
        Phase::Paused => "paused",
        Phase::Finished => "finished",
        Phase::Failed => "failed",
        Phase::Stopped => "stopped",
    }
}
