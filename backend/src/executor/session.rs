//! What the simulated robot says to the server, whatever the connection does. There is no socket and no clock here.

mod replies;
mod specification;

use std::collections::BTreeMap;
use std::time::Duration;

use goalgraph::execution::Observation;
use goalgraph::protocol::executor::{Command, FromExecutor};
use goalgraph::run::Phase;
use uuid::Uuid;

use super::disturbance::Disturbances;
use super::lines;
use super::robot::Robot;
use super::work::{Report, Work};
use specification::Held;

/// When the robot begins runs without being told to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Begin {
    /// Never.
    #[default]
    OnCommand,
    /// Once with every specification that it is sent.
    EverySpecification,
    /// This often, one after the other.
    Times(u64),
}

/// How the robot behaves.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Its name.
    pub name: String,
    /// When it begins runs by itself.
    pub begin: Begin,
    /// After how many runs it is done; none to go on for ever.
    pub runs: Option<u64>,
    /// How fast things move, in units of the features a second.
    pub speed: f64,
    /// What goes wrong in every run.
    pub disturbances: Disturbances,
}

/// The robot's side of the protocol. Whoever owns the socket hands in what was [heard](Session::heard) and how much time
/// [passed](Session::advance), and sends the [messages](Session::take_messages).
#[derive(Debug)]
pub struct Session {
    settings: Settings,
    welcomed: bool,
    heartbeat: Duration,
    lease: Duration,
    held: Option<Held>,
    /// Place in the journal of the approval accepted last, by specification: there is no way back behind it.
    approvals: BTreeMap<String, u64>,
    accepted_last: u64,
    /// Whether the specification held has not been run yet.
    fresh: bool,
    work: Option<Work>,
    runs_over: u64,
    stopping: bool,
    /// How long nothing was heard.
    silence: Duration,
    since_heartbeat: Duration,
    at_ms: i64,
    messages: Vec<FromExecutor>,
    lines: Vec<String>,
}

impl Session {
    /// A robot that has not been connected yet.
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            welcomed: false,
            heartbeat: Duration::from_secs(5),
            lease: Duration::from_secs(15),
            held: None,
            approvals: BTreeMap::new(),
            accepted_last: 0,
            fresh: false,
            work: None,
            runs_over: 0,
            stopping: false,
            silence: Duration::ZERO,
            since_heartbeat: Duration::ZERO,
            at_ms: 0,
            messages: Vec::new(),
            lines: Vec::new(),
        }
    }

    /// A connection was made.
    pub fn connected(&mut self) {
        self.messages.clear();
        self.silence = Duration::ZERO;
        let software = Some(format!("goalgraph {} (simulated)", env!("CARGO_PKG_VERSION")));
        self.messages.push(FromExecutor::Hello { executor: self.settings.name.clone(), software });
    }

    /// The connection was lost. The robot goes on until the lease runs out.
    pub fn disconnected(&mut self) {
        self.messages.clear();
        (self.welcomed, self.held) = (false, None);
        if let Some(work) = &mut self.work {
            (work.granted, work.without_lease) = (false, work.without_lease + self.silence);
        }
    }

    /// Time passed: the robot works, and says that it is still there. `at_ms` is the time now, in milliseconds since 1970.
    pub fn advance(&mut self, passed: Duration, at_ms: i64) {
        self.at_ms = at_ms;
        self.silence += passed;
        self.since_heartbeat += passed;
        if let Some(work) = self.work.as_mut().filter(|work| work.has_begun() && !work.suspended) {
            if !work.granted {
                work.without_lease += passed;
            }
            if work.without_lease.max(self.silence) > self.lease {
                work.suspended = true;
                self.lines.push(format!("run {}: the lease has run out, the robot stands still", work.id));
            }
        }
        if self.welcomed && self.since_heartbeat >= self.heartbeat / 2 {
            self.since_heartbeat = Duration::ZERO;
            self.messages.push(FromExecutor::Heartbeat);
        }
        let reports = self.work.as_mut().map(|work| work.advance(passed.as_secs_f64(), at_ms));
        self.report(&reports.unwrap_or_default());
    }

    /// What is to be sent now, in order.
    pub fn take_messages(&mut self) -> Vec<FromExecutor> {
        std::mem::take(&mut self.messages)
    }

    /// What has happened since the last call, one line each.
    pub fn take_lines(&mut self) -> Vec<String> {
        std::mem::take(&mut self.lines)
    }

    /// Whether the server has welcomed it on this connection.
    pub fn is_welcomed(&self) -> bool {
        self.welcomed
    }

    /// Whether nothing was heard for so long that the connection must be dead.
    pub fn is_deaf(&self) -> bool {
        self.silence > self.lease
    }

    /// Whether all runs that were wanted are over and stored, or it was stopped and there is nothing left to store.
    pub fn is_done(&self) -> bool {
        let enough = self.settings.runs.is_some_and(|runs| self.runs_over >= runs);
        self.work.is_none() && (self.stopping || enough)
    }

    /// Ends the run under way, and begins no other.
    pub fn stop(&mut self) {
        self.stopping = true;
        if self.work.as_ref().is_some_and(|work| !work.has_begun()) {
            self.work = None;
        }
        self.observe(Observation::Stop);
    }

    fn observe(&mut self, observation: Observation) {
        let at_ms = self.at_ms;
        let reports = self.work.as_mut().map(|work| work.observe(observation, at_ms));
        self.report(&reports.unwrap_or_default());
    }

    fn obey(&mut self, command: Command) {
        self.lines.push(format!("told to {}", replies::word(command)));
        match command {
            Command::Start if self.work.is_some() => {
                self.lines.push("there is a run under way, so none is begun".to_owned());
            }
            Command::Start => self.begin(),
            Command::Pause => self.observe(Observation::Pause),
            Command::Resume => self.observe(Observation::Resume),
            Command::Stop => self.observe(Observation::Stop),
        }
    }

    /// Asks for the lease of a new run with what is held.
    fn begin(&mut self) {
        let Some(held) = self.held.as_ref().filter(|_| !self.stopping) else {
            self.lines.push("there is no approved specification to run".to_owned());
            return;
        };
        let (schedule, faults) = self.settings.disturbances.schedule(&held.specification);
        self.lines.extend(faults);
        let robot = Robot::new(&held.specification, self.settings.speed);
        let (run, sha256) = (Uuid::new_v4().to_string(), held.sha256.clone());
        self.lines.push(format!("run {run} with {}", held.name()));
        self.messages.push(FromExecutor::Begin { run: run.clone(), sha256: sha256.clone() });
        self.work = Some(Work::new(run, sha256, held.specification.clone(), robot, schedule));
        self.fresh = false;
    }

    fn begin_by_itself(&mut self) {
        let wanted = match self.settings.begin {
            Begin::OnCommand => false,
            Begin::EverySpecification => self.fresh,
            Begin::Times(runs) => self.runs_over < runs,
        };
        if wanted && self.work.is_none() && self.held.is_some() && !self.stopping && !self.is_done() {
            self.begin();
        }
    }

    /// Tells about events, and sends them when the lease is held.
    fn report(&mut self, reports: &[Report]) {
        let Some(work) = &self.work else {
            return;
        };
        for report in reports {
            self.lines.push(lines::of_event(&work.specification, report));
            if work.granted {
                self.messages.push(work.message(report));
            }
        }
    }

    /// Lets go of a run that is over and stored.
    fn settle(&mut self) {
        let Some(work) = self.work.take_if(|work| work.is_settled()) else {
            return;
        };
        let how = match work.phase() {
            Phase::Finished => "finished",
            Phase::Failed => "failed",
            _ => "stopped",
        };
        self.lines.push(format!("run {} {how}, all of it is stored", work.id));
        self.runs_over += 1;
        self.begin_by_itself();
    }

    /// Lets go of a run that cannot go on.
    fn give_up(&mut self, why: &str) {
        if let Some(work) = self.work.take() {
            self.lines.push(format!("run {} ends here: {why}", work.id));
            self.runs_over += 1;
        }
    }
}
