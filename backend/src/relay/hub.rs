//! Everything the relay knows at a moment: who is connected, which runs there are, who watches.
//!
//! It lives behind one lock that is never held while anything waits.

use std::collections::BTreeMap;
use std::sync::Arc;

use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::{Answer, ApprovedView, ExecutorView, Held};
use tokio::sync::watch;

use super::inbox::Inbox;
use super::lease::Presence;
use super::outgoing::Ending;
use super::relayed_run::RelayedRun;

/// The present state.
#[derive(Debug, Default)]
pub(super) struct Hub {
    /// Executors that are connected, or are in a run that is not over; by name.
    pub(super) executors: BTreeMap<String, Executor>,
    /// Runs that are not over, and the last that are; by id.
    pub(super) runs: BTreeMap<String, RelayedRun>,
    /// Specifications of which a revision is or was approved; by id.
    pub(super) approved: BTreeMap<String, ApprovedView>,
    /// Who watches; by number.
    pub(super) monitors: BTreeMap<u64, Arc<Inbox>>,
    links: u64,
}

/// An executor.
#[derive(Debug, Default)]
pub(super) struct Executor {
    /// What software it is.
    pub(super) software: Option<String>,
    /// Its connection, while there is one.
    pub(super) link: Option<Link>,
    /// Id of the token that it showed last.
    pub(super) token: Option<String>,
    /// Whether its last connection lives.
    pub(super) presence: Option<Arc<Presence>>,
    /// What it was sent last.
    pub(super) holds: Option<Held>,
    /// The run that it is in.
    pub(super) run: Option<String>,
}

/// How a connection is reached.
#[derive(Debug)]
pub(super) struct Link {
    /// Its number.
    pub(super) number: u64,
    /// Ends it.
    pub(super) stop: watch::Sender<Option<Ending>>,
    /// What a person wants of it; the last counts.
    pub(super) commands: watch::Sender<Option<Command>>,
}

/// Who says hello.
#[derive(Debug, Clone)]
pub(super) struct Caller {
    /// Name of the executor.
    pub(super) executor: String,
    /// What software it is.
    pub(super) software: Option<String>,
    /// Id of the token that it showed.
    pub(super) token: Option<String>,
}

impl Hub {
    /// A number that nothing else has.
    pub(super) fn next_number(&mut self) -> u64 {
        self.links += 1;
        self.links
    }

    /// Whether `token` may not speak for the executor, because another one does.
    pub(super) fn is_taken(&self, executor: &str, token: Option<&str>, lasting: std::time::Duration) -> bool {
        self.executors.get(executor).is_some_and(|known| {
            let is_live = known.presence.as_ref().is_some_and(|presence| presence.is_live(lasting));
            is_live && known.token.as_deref() != token
        })
    }

    /// Puts the connection of an executor in the place of the one before, which ends.
    pub(super) fn connect(&mut self, caller: Caller, presence: Arc<Presence>, link: Link) {
        let executor = self.executors.entry(caller.executor.clone()).or_default();
        if let Some(before) = executor.link.replace(link) {
            before.stop.send_replace(Some(Ending::replaced()));
        }
        executor.software = caller.software;
        executor.token = caller.token;
        executor.presence = Some(presence);
        executor.holds = None;
        self.mark_executor(&caller.executor);
    }

    /// Takes note that a connection is gone, unless another has taken its place.
    pub(super) fn disconnect(&mut self, name: &str, link: u64) {
        if let Some(executor) = self.linked(name, link) {
            executor.link = None;
            executor.holds = None;
            self.mark_executor(name);
            self.forget_idle(name);
        }
    }

    /// The executor, if this is its connection.
    pub(super) fn linked(&mut self, name: &str, link: u64) -> Option<&mut Executor> {
        let executor = self.executors.get_mut(name)?;
        let is_current = executor.link.as_ref().is_some_and(|current| current.number == link);
        is_current.then_some(executor)
    }

    /// Takes note of what was sent to an executor.
    pub(super) fn hold(&mut self, name: &str, link: u64, holds: Option<Held>) {
        if let Some(executor) = self.linked(name, link) {
            executor.holds = holds;
            self.mark_executor(name);
        }
    }

    /// Takes note of what an executor answered to what it was sent last; false when that was something else.
    pub(super) fn answer(&mut self, name: &str, link: u64, sha256: &str, answer: Answer) -> bool {
        let held = self.linked(name, link).and_then(|executor| executor.holds.as_mut());
        let Some(held) = held.filter(|held| held.sha256 == sha256) else { return false };
        held.answer = answer;
        self.mark_executor(name);
        true
    }

    /// Whether the executor said that it will follow the specification with this SHA-256.
    pub(super) fn has_accepted(&self, name: &str, sha256: &str) -> bool {
        let held = self.executors.get(name).and_then(|executor| executor.holds.as_ref());
        held.is_some_and(|held| held.sha256 == sha256 && held.answer == Answer::Accepted)
    }

    /// How many runs that are not over the connection holds, `except` not counted.
    pub(super) fn leases_of(&self, link: u64, except: &str) -> usize {
        let holds = |run: &&RelayedRun| {
            let lease = run.lease.as_ref().is_some_and(|lease| lease.link == link);
            lease && !run.run.phase.is_over() && run.origin.run != except
        };
        self.runs.values().filter(holds).count()
    }

    /// An executor as it is now; one that is unknown is one that is gone.
    pub(super) fn executor_view(&self, name: &str) -> ExecutorView {
        let known = self.executors.get(name);
        ExecutorView {
            executor: name.to_owned(),
            software: known.and_then(|it| it.software.clone()),
            connected: known.is_some_and(|it| it.link.is_some()),
            holds: known.and_then(|it| it.holds.clone()),
            run: known.and_then(|it| it.run.clone()),
        }
    }

    /// Forgets an executor that is neither connected nor in a run.
    pub(super) fn forget_idle(&mut self, name: &str) {
        let is_idle = |it: &Executor| it.link.is_none() && it.run.is_none();
        if self.executors.get(name).is_some_and(is_idle) {
            self.executors.remove(name);
        }
    }

    /// Tells everybody who watches that an executor has changed.
    pub(super) fn mark_executor(&self, name: &str) {
        self.monitors.values().for_each(|inbox| inbox.mark_executor(name));
    }

    /// Tells everybody who watches that a run has changed.
    pub(super) fn mark_run(&self, run: &str) {
        self.monitors.values().for_each(|inbox| inbox.mark_run(run));
    }

    /// Tells everybody who watches what is approved of a specification now.
    pub(super) fn mark_approved(&mut self, view: ApprovedView) {
        let specification = view.specification.clone();
        self.approved.insert(specification.clone(), view);
        self.monitors.values().for_each(|inbox| inbox.mark_approved(&specification));
    }
}
