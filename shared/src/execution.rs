//! What a robot does with a specification: which sub-goal comes next, and what it reports.
//!
//! An [`Execution`] holds neither robot nor connection. It is told what was observed and answers with the events to
//! report, so that the simulated robot, tests and pages agree on what following an automaton means.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::pdfa::{Probabilities, StateId, Symbol};
use crate::plan::{NoPlan, Plan, PlanRequest, Strategy, plan};
use crate::run::{Phase, Run, RunEvent};
use crate::specification::Specification;

/// An event with its number in the run: 1, 2, 3..
pub type Numbered = (u64, RunEvent);

/// What was observed of the robot, or is wanted of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Observation {
    /// A sub-goal is completed, whether or not it was the one worked on.
    Completed(Symbol),
    /// A sub-goal cannot be completed for the time being, and why.
    Unavailable(Symbol, Option<String>),
    /// A sub-goal can be completed again.
    Available(Symbol),
    /// Somebody wants a pause before the next sub-goal.
    Pause,
    /// Somebody wants the run to go on after a pause.
    Resume,
    /// Somebody wants the run to end.
    Stop,
    /// The robot gives up, and why.
    Failed(String),
}

/// A run as the robot sees it: the plan that it follows and the events that it has reported.
///
/// From each state it takes the available sub-goal of highest probability that leads to an end (the greedy
/// [`plan`]). When no end is in reach it does [what can be done meanwhile](NoPlan::OutOfReach), then waits. What is under
/// way is dropped only when it became impossible or pointless; a better way that has become available is taken
/// at the next state.
#[derive(Clone, Debug)]
pub struct Execution {
    specification: Arc<Specification>,
    probabilities: Probabilities,
    run: Run,
    worth: Worth,
    planned: bool,
    pausing: bool,
    /// Where it last reported to wait.
    waits_in: Option<StateId>,
    reported: Vec<Numbered>,
}

/// What the plan is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Worth {
    /// It no longer fits where the run is and what is available.
    Outdated,
    /// It leads to no end: it is what can be done meanwhile.
    Meanwhile,
    /// It leads to an end.
    Complete,
    /// It leads to an end, but something has become available that it leaves out.
    Improvable,
}

impl Execution {
    /// Begins a run while `unavailable` cannot be completed; also gives the first events to report.
    pub fn begin(specification: Arc<Specification>, unavailable: &BTreeSet<Symbol>) -> (Self, Vec<Numbered>) {
        let mut execution = Self {
            probabilities: specification.pdfa.probabilities(specification.semantics),
            run: Run::new(&specification.pdfa),
            specification,
            worth: Worth::Outdated,
            planned: false,
            pausing: false,
            waits_in: None,
            reported: Vec::new(),
        };
        for &sub_goal in unavailable {
            execution.report(RunEvent::Unavailable { sub_goal, reason: None });
        }
        execution.go_on();
        let reported = std::mem::take(&mut execution.reported);
        (execution, reported)
    }

    /// Takes an observation into account and gives the events to report, in order. After the end there are none.
    ///
    /// # Complexity
    ///
    /// That of [`plan`].
    pub fn observe(&mut self, observation: Observation) -> Vec<Numbered> {
        if !self.run.phase.is_over() {
            match observation {
                Observation::Completed(sub_goal) => self.complete(sub_goal),
                Observation::Unavailable(sub_goal, reason) => self.lose(sub_goal, reason),
                Observation::Available(sub_goal) => self.regain(sub_goal),
                Observation::Pause => self.pause(),
                Observation::Resume => self.resume(),
                Observation::Stop => self.report(RunEvent::Stopped),
                Observation::Failed(reason) => self.report(RunEvent::Failed { reason }),
            }
        }
        std::mem::take(&mut self.reported)
    }

    /// The sub-goal to work on now; none while it waits or pauses, and once it is over.
    pub fn next(&self) -> Option<Symbol> {
        self.run.active.filter(|_| self.run.phase == Phase::Running)
    }

    /// Where the run stands, as everybody else sees it who has all events so far.
    pub fn run(&self) -> &Run {
        &self.run
    }

    fn complete(&mut self, sub_goal: Symbol) {
        let expected = self.run.plan.first() == Some(&sub_goal);
        let before = self.run.state;
        self.report(RunEvent::Completed { sub_goal });
        if self.run.state.is_none() {
            let state = before.map(|state| state.to_string()).unwrap_or_default();
            let name = self.specification.name_of(sub_goal);
            let reason = format!("{name} was completed in {state}, where the automaton has no way for it");
            self.report(RunEvent::Failed { reason });
            return;
        }
        if !expected || self.worth == Worth::Improvable {
            self.worth = Worth::Outdated;
        }
        self.go_on();
    }

    fn lose(&mut self, sub_goal: Symbol, reason: Option<String>) {
        if self.run.unavailable.contains(&sub_goal) {
            return;
        }
        if self.run.plan.contains(&sub_goal) {
            self.worth = Worth::Outdated;
        }
        self.report(RunEvent::Unavailable { sub_goal, reason });
        self.go_on();
    }

    fn regain(&mut self, sub_goal: Symbol) {
        if !self.run.unavailable.contains(&sub_goal) {
            return;
        }
        self.report(RunEvent::Available { sub_goal });
        self.worth = match self.worth {
            Worth::Complete | Worth::Improvable => Worth::Improvable,
            Worth::Meanwhile | Worth::Outdated => Worth::Outdated,
        };
        self.go_on();
    }

    fn pause(&mut self) {
        self.pausing = true;
        if self.run.active.is_none() {
            self.go_on();
        }
    }

    fn resume(&mut self) {
        self.pausing = false;
        if self.run.phase == Phase::Paused {
            self.report(RunEvent::Resumed);
            // It may have waited before the pause; then that has to be said again.
            self.waits_in = None;
            self.go_on();
        }
    }

    /// Plans where that is needed, then begins what comes next, or ends, or waits, or pauses.
    fn go_on(&mut self) {
        if self.pausing {
            let interrupted = self.run.active.is_none() || self.worth == Worth::Outdated;
            if self.run.phase != Phase::Paused && interrupted {
                self.report(RunEvent::Paused);
            }
            return;
        }
        if self.worth == Worth::Outdated {
            self.plan_anew();
        } else if self.run.plan.is_empty() {
            self.rest();
        }
        if let Some(&sub_goal) = self.run.plan.first().filter(|&first| self.run.active != Some(*first)) {
            self.report(RunEvent::Started { sub_goal });
        }
    }

    fn plan_anew(&mut self) {
        let from = self.run.state.unwrap_or(self.specification.pdfa.initial);
        let unavailable = self.run.unavailable.clone();
        let request = PlanRequest { from, unavailable, strategy: Strategy::Greedy };
        let (plan, worth) = match plan(&self.specification.pdfa, &self.probabilities, &request) {
            Ok(plan) => (plan, Worth::Complete),
            Err(NoPlan::OutOfReach { meanwhile, .. }) => (meanwhile, Worth::Meanwhile),
            Err(NoPlan::UnknownState(_)) => return,
        };
        self.worth = worth;
        if plan.word.is_empty() {
            self.rest();
        } else if plan.word != self.run.plan {
            self.follow(from, plan);
        }
    }

    fn follow(&mut self, state: StateId, plan: Plan) {
        let Plan { word, probability, .. } = plan;
        self.waits_in = None;
        self.report(if self.planned {
            RunEvent::Replanned { state, word, probability }
        } else {
            RunEvent::Planned { state, word, probability }
        });
        self.planned = true;
    }

    /// There is nothing to do: because the task may end here, or until something becomes available.
    fn rest(&mut self) {
        if matches!(self.worth, Worth::Complete | Worth::Improvable) {
            self.report(RunEvent::Finished);
        } else if let Some(state) = self.run.state.filter(|_| self.waits_in != self.run.state) {
            self.waits_in = Some(state);
            self.report(RunEvent::Waiting { state });
        }
    }

    /// The run has taken its own events, so that what the robot believes is what the events say.
    fn report(&mut self, event: RunEvent) {
        let number = self.run.events + 1;
        if self.run.apply(&self.specification.pdfa, &self.probabilities, number, &event).is_ok() {
            self.reported.push((number, event));
        }
    }
}
