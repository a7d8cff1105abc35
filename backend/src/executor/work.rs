//! One run of the simulated robot, with the events that the server has not stored yet.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use goalgraph::execution::{Execution, Numbered, Observation};
use goalgraph::protocol::executor::FromExecutor;
use goalgraph::run::{Phase, RunEvent};
use goalgraph::specification::Specification;

use super::disturbance::Schedule;
use super::robot::Robot;

/// An event that the server has not stored yet, as far as is known here.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Report {
    /// Its number in the run.
    pub(super) number: u64,
    /// When it happened, in milliseconds since 1970.
    pub(super) at_ms: i64,
    /// What happened.
    pub(super) happened: RunEvent,
}

/// A run: asked for, granted, under way, or over but not stored yet.
#[derive(Clone, Debug)]
pub(super) struct Work {
    /// Id of the run.
    pub(super) id: String,
    /// SHA-256 of the specification that it follows.
    pub(super) sha256: String,
    /// The specification that it follows.
    pub(super) specification: Arc<Specification>,
    /// Whether the server has granted the lease on this connection.
    pub(super) granted: bool,
    /// Whether the lease has run out, so that the robot stands still.
    pub(super) suspended: bool,
    /// Whether what is not stored has to be sent again later.
    pub(super) put_off: bool,
    /// How long it has been since it held the lease.
    pub(super) without_lease: Duration,
    robot: Robot,
    schedule: Schedule,
    elapsed_s: f64,
    /// None until the run is granted for the first time.
    execution: Option<Execution>,
    acknowledged: u64,
    reports: VecDeque<Report>,
}

impl Work {
    /// A run that is not granted yet.
    pub(super) fn new(
        id: String,
        sha256: String,
        specification: Arc<Specification>,
        robot: Robot,
        schedule: Schedule,
    ) -> Self {
        Self {
            id,
            sha256,
            specification,
            granted: false,
            suspended: false,
            put_off: false,
            without_lease: Duration::ZERO,
            robot,
            schedule,
            elapsed_s: 0.0,
            execution: None,
            acknowledged: 0,
            reports: VecDeque::new(),
        }
    }

    /// The lease is granted and the server has `stored` events: begins, and gives the first events; or goes on.
    ///
    /// # Errors
    ///
    /// One sentence when the server remembers another run than this one.
    pub(super) fn grant(&mut self, stored: u64, at_ms: i64) -> Result<Vec<Report>, String> {
        let events = self.execution.as_ref().map_or(0, |execution| execution.run().events);
        if stored > events {
            return Err(format!(
                "the server has {stored} events of this run, but only {events} happened here"
            ));
        }
        if stored < self.acknowledged {
            let acknowledged = self.acknowledged;
            return Err(format!("the server has acknowledged {acknowledged} events and kept only {stored}"));
        }
        (self.granted, self.suspended, self.without_lease) = (true, false, Duration::ZERO);
        self.stored(stored);
        if self.execution.is_some() {
            return Ok(Vec::new());
        }
        let (execution, first) =
            Execution::begin(Arc::clone(&self.specification), &self.schedule.unavailable);
        self.execution = Some(execution);
        Ok(self.keep(first, at_ms))
    }

    /// The robot works for some seconds, and what is to happen meanwhile happens.
    pub(super) fn advance(&mut self, seconds: f64, at_ms: i64) -> Vec<Report> {
        if self.suspended || self.execution.is_none() {
            return Vec::new();
        }
        self.elapsed_s += seconds;
        let mut reports = Vec::new();
        for observation in self.schedule.due(self.elapsed_s) {
            reports.extend(self.observe(observation, at_ms));
        }
        if let Some(observation) = self.robot_works(seconds) {
            reports.extend(self.observe(observation, at_ms));
        }
        reports
    }

    fn robot_works(&mut self, seconds: f64) -> Option<Observation> {
        let symbol = self.execution.as_ref()?.next()?;
        let sub_goal = self.specification.sub_goal(symbol)?;
        if self.schedule.fails_at(symbol) {
            return Some(Observation::Failed(format!("{} cannot be completed", sub_goal.name)));
        }
        self.robot.work(sub_goal, seconds).then_some(Observation::Completed(symbol))
    }

    /// Takes an observation into account.
    pub(super) fn observe(&mut self, observation: Observation, at_ms: i64) -> Vec<Report> {
        let Some(execution) = &mut self.execution else {
            return Vec::new();
        };
        let events = execution.observe(observation);
        self.keep(events, at_ms)
    }

    fn keep(&mut self, events: Vec<Numbered>, at_ms: i64) -> Vec<Report> {
        let report = |(number, happened)| Report { number, at_ms, happened };
        let reports: Vec<Report> = events.into_iter().map(report).collect();
        self.reports.extend(reports.iter().cloned());
        reports
    }

    /// The server has stored the events up to `number`.
    pub(super) fn stored(&mut self, number: u64) {
        self.acknowledged = self.acknowledged.max(number);
        self.reports.retain(|report| report.number > number);
    }

    /// The messages about all events from `number` on that the server has not stored.
    pub(super) fn messages_from(&self, number: u64) -> Vec<FromExecutor> {
        self.reports.iter().filter(|report| report.number >= number).map(|it| self.message(it)).collect()
    }

    /// The message about an event.
    pub(super) fn message(&self, report: &Report) -> FromExecutor {
        FromExecutor::Event {
            run: self.id.clone(),
            number: report.number,
            at_ms: Some(report.at_ms),
            happened: report.happened.clone(),
        }
    }

    /// How the run stands.
    pub(super) fn phase(&self) -> Phase {
        self.execution.as_ref().map_or(Phase::Running, |execution| execution.run().phase)
    }

    /// Whether it has begun, that is, has been granted once.
    pub(super) fn has_begun(&self) -> bool {
        self.execution.is_some()
    }

    /// Whether it is over and the server has stored all of it.
    pub(super) fn is_settled(&self) -> bool {
        self.phase().is_over() && self.reports.is_empty()
    }
}
