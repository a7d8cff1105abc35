//! Executors, runs and approvals as the server last told them.

use std::collections::BTreeMap;

use goalgraph::protocol::monitor::{ApprovedView, ExecutorView, RunView, ToMonitor};

/// An executor, and since when it is connected or not.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SeenExecutor {
    /// The executor.
    pub(crate) view: ExecutorView,
    /// When it came or went, in milliseconds since 1970; none when that was before this page looked.
    pub(crate) since_ms: Option<f64>,
}

/// All that was told.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Heard {
    /// The executors by name.
    pub(crate) executors: BTreeMap<String, SeenExecutor>,
    /// The runs, newest first.
    pub(crate) runs: Vec<RunView>,
    /// What is approved, by specification.
    pub(crate) approved: BTreeMap<String, ApprovedView>,
}

impl Heard {
    /// Takes a message into account that came at `now_ms`, in milliseconds since 1970.
    pub(crate) fn take(&mut self, message: ToMonitor, now_ms: f64) {
        match message {
            ToMonitor::Snapshot { executors, runs, approved } => {
                let before = std::mem::take(&mut self.executors);
                for view in executors {
                    let earlier = before.get(&view.executor).filter(|it| it.view.connected == view.connected);
                    let since_ms = earlier.and_then(|it| it.since_ms);
                    self.executors.insert(view.executor.clone(), SeenExecutor { view, since_ms });
                }
                self.approved.clear();
                self.take_approved(approved);
                let before = std::mem::replace(&mut self.runs, runs);
                // What is over stays as it was; what was not over and is not told any more is not known.
                self.take_older(before.into_iter().filter(|run| run.phase.is_over()).collect());
            }
            ToMonitor::Changes { executors, runs, approved } => {
                for view in executors {
                    self.take_executor(view, now_ms);
                }
                // The newest comes first, and so it is put before the others last.
                for run in runs.into_iter().rev() {
                    self.take_run(run);
                }
                self.take_approved(approved);
            }
        }
    }

    /// Adds runs from before those that are known, newest first; what is known stays as it is.
    pub(crate) fn take_older(&mut self, runs: Vec<RunView>) {
        for run in runs {
            if self.run(&run.run).is_none() {
                self.runs.push(run);
            }
        }
    }

    /// The run with this id.
    pub(crate) fn run(&self, id: &str) -> Option<&RunView> {
        self.runs.iter().find(|run| run.run == id)
    }

    /// The newest run that is not over, or else the newest.
    pub(crate) fn newest(&self) -> Option<&RunView> {
        self.runs.iter().find(|run| !run.phase.is_over()).or(self.runs.first())
    }

    /// Whether a robot is there, or at work.
    pub(crate) fn is_busy(&self) -> bool {
        self.executors.values().any(|it| it.view.connected) || self.runs.iter().any(|it| !it.phase.is_over())
    }

    fn take_executor(&mut self, view: ExecutorView, now_ms: f64) {
        let earlier = self.executors.get(&view.executor).filter(|it| it.view.connected == view.connected);
        let since_ms = earlier.map_or(Some(now_ms), |it| it.since_ms);
        self.executors.insert(view.executor.clone(), SeenExecutor { view, since_ms });
    }

    fn take_run(&mut self, run: RunView) {
        match self.runs.iter_mut().find(|it| it.run == run.run) {
            Some(known) => *known = run,
            None => self.runs.insert(0, run),
        }
    }

    fn take_approved(&mut self, approved: Vec<ApprovedView>) {
        self.approved.extend(approved.into_iter().map(|it| (it.specification.clone(), it)));
    }
}

#[cfg(test)]
mod tests {
    use goalgraph::pdfa::Pdfa;
    use goalgraph::protocol::monitor::RunOrigin;
    use goalgraph::run::{Phase, Run};

    use super::*;

    fn executor(name: &str, connected: bool) -> ExecutorView {
        ExecutorView { executor: name.to_owned(), software: None, connected, holds: None, run: None }
    }

    fn run(id: &str, phase: Phase) -> RunView {
        let origin = RunOrigin {
            run: id.to_owned(),
            executor: "arm".to_owned(),
            specification: "s".to_owned(),
            name: "Two stacks".to_owned(),
            revision: 1,
            sha256: String::new(),
            began_at: String::new(),
        };
        RunView { phase, ..RunView::new(origin, &Run::new(&Pdfa::from_words(&[])), String::new()) }
    }

    fn snapshot(executors: Vec<ExecutorView>, runs: Vec<RunView>) -> ToMonitor {
        ToMonitor::Snapshot { executors, runs, approved: Vec::new() }
    }

    fn changes(executors: Vec<ExecutorView>, runs: Vec<RunView>) -> ToMonitor {
        ToMonitor::Changes { executors, runs, approved: Vec::new() }
    }

    fn ids(heard: &Heard) -> Vec<&str> {
        heard.runs.iter().map(|run| run.run.as_str()).collect()
    }

    #[test]
    fn it_is_known_since_when_an_executor_is_away_only_when_somebody_saw_it_go() {
        let mut heard = Heard::default();
        heard.take(snapshot(vec![executor("arm", true)], Vec::new()), 1.0);
        assert_eq!(heard.executors["arm"].since_ms, None);
        heard.take(changes(vec![executor("arm", false)], Vec::new()), 2.0);
        heard.take(changes(vec![executor("arm", false)], Vec::new()), 3.0);
        assert_eq!(heard.executors["arm"].since_ms, Some(2.0));
        heard.take(snapshot(vec![executor("arm", false)], Vec::new()), 4.0);
        assert_eq!(heard.executors["arm"].since_ms, Some(2.0), "a reconnection tells nothing new");
    }

    #[test]
    fn a_new_run_comes_first_and_a_known_one_stays_in_its_place() {
        let mut heard = Heard::default();
        heard.take(snapshot(Vec::new(), vec![run("b", Phase::Running), run("a", Phase::Finished)]), 0.0);
        let told = vec![run("d", Phase::Running), run("c", Phase::Running), run("b", Phase::Finished)];
        heard.take(changes(Vec::new(), told), 0.0);
        assert_eq!(ids(&heard), ["d", "c", "b", "a"]);
        assert_eq!(heard.run("b").map(|run| run.phase), Some(Phase::Finished));
    }

    #[test]
    fn a_snapshot_takes_the_place_of_everything_but_what_is_over_for_good() {
        let mut heard = Heard::default();
        let known = vec![run("c", Phase::Running), run("b", Phase::Finished), run("a", Phase::Stopped)];
        heard.take(snapshot(vec![executor("gone", true)], known), 0.0);
        heard.take(snapshot(Vec::new(), vec![run("d", Phase::Running), run("b", Phase::Finished)]), 0.0);
        assert_eq!(ids(&heard), ["d", "b", "a"]);
        assert!(heard.executors.is_empty());
    }

    #[test]
    fn older_runs_never_replace_what_is_known() {
        let mut heard = Heard::default();
        heard.take(snapshot(Vec::new(), vec![run("b", Phase::Paused)]), 0.0);
        heard.take_older(vec![run("b", Phase::Running), run("a", Phase::Finished)]);
        assert_eq!(ids(&heard), ["b", "a"]);
        assert_eq!(heard.run("b").map(|run| run.phase), Some(Phase::Paused));
    }

    #[test]
    fn the_run_to_look_at_is_the_newest_that_is_not_over() {
        let mut heard = Heard::default();
        heard.take(snapshot(Vec::new(), vec![run("c", Phase::Finished), run("b", Phase::Waiting)]), 0.0);
        assert_eq!(heard.newest().map(|run| run.run.as_str()), Some("b"));
        heard.take(changes(Vec::new(), vec![run("b", Phase::Failed)]), 0.0);
        assert_eq!(heard.newest().map(|run| run.run.as_str()), Some("c"));
    }
}
