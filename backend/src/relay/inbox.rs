//! What a monitor has not been told yet: names, never contents, so it is bounded by what exists.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

use goalgraph::protocol::monitor::{ApprovedView, RunView, ToMonitor};
use tokio::sync::Notify;

use super::hub::Hub;
use super::relayed_run::RelayedRun;

/// What has changed since a monitor was told last.
#[derive(Debug, Default)]
pub(super) struct Inbox {
    changed: Mutex<Changed>,
    bell: Notify,
}

#[derive(Debug, Default)]
struct Changed {
    executors: BTreeSet<String>,
    runs: BTreeSet<String>,
    approved: BTreeSet<String>,
}

impl Changed {
    fn is_empty(&self) -> bool {
        self.executors.is_empty() && self.runs.is_empty() && self.approved.is_empty()
    }
}

impl Inbox {
    /// An executor has changed.
    pub(super) fn mark_executor(&self, name: &str) {
        self.mark(|changed| &mut changed.executors, name);
    }

    /// A run has changed.
    pub(super) fn mark_run(&self, id: &str) {
        self.mark(|changed| &mut changed.runs, id);
    }

    /// What is approved of a specification has changed.
    pub(super) fn mark_approved(&self, specification: &str) {
        self.mark(|changed| &mut changed.approved, specification);
    }

    fn mark(&self, of: impl Fn(&mut Changed) -> &mut BTreeSet<String>, key: &str) {
        let mut changed = self.changed.lock().unwrap_or_else(PoisonError::into_inner);
        let keys = of(&mut changed);
        if !keys.contains(key) {
            keys.insert(key.to_owned());
            self.bell.notify_one();
        }
    }

    /// Waits until something has changed.
    pub(super) async fn changed(&self) {
        self.bell.notified().await;
    }

    fn take(&self) -> Changed {
        std::mem::take(&mut *self.changed.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Hub {
    /// What has changed for a monitor, as it is now; none when nothing has. It is not told again.
    pub(super) fn changes(&self, inbox: &Inbox) -> Option<ToMonitor> {
        let changed = inbox.take();
        (!changed.is_empty()).then(|| ToMonitor::Changes {
            executors: changed.executors.iter().map(|name| self.executor_view(name)).collect(),
            runs: newest_first(changed.runs.iter().filter_map(|id| self.runs.get(id))),
            approved: changed.approved.iter().filter_map(|id| self.approved.get(id)).cloned().collect(),
        })
    }

    /// Everything as it is now.
    pub(super) fn snapshot(&self) -> ToMonitor {
        let is_approved = |view: &&ApprovedView| view.revision.is_some();
        ToMonitor::Snapshot {
            executors: self.executors.keys().map(|name| self.executor_view(name)).collect(),
            runs: newest_first(self.runs.values()),
            approved: self.approved.values().filter(is_approved).cloned().collect(),
        }
    }
}

fn newest_first<'a>(runs: impl Iterator<Item = &'a RelayedRun>) -> Vec<RunView> {
    let mut runs: Vec<_> = runs.collect();
    runs.sort_unstable_by_key(|run| std::cmp::Reverse(run.sequence));
    runs.into_iter().map(RelayedRun::view).collect()
}
