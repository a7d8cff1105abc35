//! The runs of the hub: begun, handed over, followed, forgotten.

use goalgraph::run::{EventError, RunEvent};

use super::hub::Hub;
use super::lease::Lease;
use super::relayed_run::RelayedRun;

impl Hub {
    /// Takes in a run, as it was read of the store.
    pub(super) fn take_in(&mut self, run: RelayedRun) {
        let (id, executor) = (run.origin.run.clone(), run.origin.executor.clone());
        if !run.run.phase.is_over() {
            self.executors.entry(executor.clone()).or_default().run.get_or_insert(id.clone());
        }
        self.mark_run(&id);
        self.mark_executor(&executor);
        self.runs.insert(id, run);
    }

    /// Gives a run that is known to the executor of `lease`.
    pub(super) fn grant(&mut self, id: &str, lease: Lease) {
        let Some(run) = self.runs.get_mut(id) else { return };
        let executor = lease.executor.clone();
        let before = std::mem::replace(&mut run.origin.executor, executor.clone());
        run.lease = Some(lease);
        if before != executor {
            self.leave(&before, id);
        }
        if let Some(known) = self.executors.get_mut(&executor) {
            known.run = Some(id.to_owned());
        }
        self.mark_run(id);
        self.mark_executor(&executor);
    }

    /// Whether the connection with this number holds the lease of a run.
    pub(super) fn is_held_by(&self, id: &str, link: u64) -> bool {
        let lease = self.runs.get(id).and_then(|run| run.lease.as_ref());
        lease.is_some_and(|lease| lease.link == link)
    }

    /// Takes an event into account that is stored.
    ///
    /// # Errors
    ///
    /// When it cannot be the next of the run.
    pub(super) fn follow(
        &mut self,
        id: &str,
        number: u64,
        event: &RunEvent,
        at_ms: i64,
    ) -> Result<(), EventError> {
        let Some(run) = self.runs.get_mut(id) else { return Ok(()) };
        run.apply(number, event, at_ms)?;
        if run.run.phase.is_over() {
            let executor = run.origin.executor.clone();
            self.leave(&executor, id);
        }
        self.mark_run(id);
        Ok(())
    }

    /// The executor is no longer in the run, but in the newest other one that it holds.
    fn leave(&mut self, executor: &str, run: &str) {
        let other = self.newest_held(executor, run);
        if let Some(known) = self.executors.get_mut(executor)
            && known.run.as_deref() == Some(run)
        {
            known.run = other;
            self.mark_executor(executor);
            self.forget_idle(executor);
        }
    }

    fn newest_held(&self, executor: &str, except: &str) -> Option<String> {
        let link = self.executors.get(executor)?.link.as_ref()?.number;
        let held = self.runs.values().filter(|run| {
            let is_held = run.lease.as_ref().is_some_and(|lease| lease.link == link);
            is_held && !run.run.phase.is_over() && run.origin.run != except
        });
        held.max_by_key(|run| run.sequence).map(|run| run.origin.run.clone())
    }

    /// Forgets runs beyond `idle` that are not over and that nobody works on, and beyond `finished` that are over: the
    /// oldest first. The store still has them.
    pub(super) fn forget_runs(&mut self, idle: usize, finished: usize, lasting: std::time::Duration) {
        let is_worked_on =
            |run: &RelayedRun| run.lease.as_ref().is_some_and(|lease| lease.presence.is_live(lasting));
        let over = self.beyond(finished, |run| run.closed);
        let left = self.beyond(idle, |run| !run.run.phase.is_over() && !is_worked_on(run));
        for id in over.into_iter().chain(left) {
            if let Some(run) = self.runs.remove(&id) {
                self.leave(&run.origin.executor, &id);
            }
        }
    }

    fn beyond(&self, kept: usize, is_meant: impl Fn(&RelayedRun) -> bool) -> Vec<String> {
        let meant = self.runs.values().filter(|run| is_meant(run));
        let mut newest: Vec<(u64, &String)> = meant.map(|run| (run.sequence, &run.origin.run)).collect();
        newest.sort_unstable_by_key(|&(sequence, _)| std::cmp::Reverse(sequence));
        newest.into_iter().skip(kept).map(|(_, id)| id.clone()).collect()
    }
}
