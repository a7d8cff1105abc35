//! What is heard of executors and runs, and how it is looked at.

mod heard;

use std::collections::BTreeMap;
use std::sync::Arc;

use goalgraph::protocol::api::StoredEvent;
use goalgraph::run::RunEvent;
use goalgraph::specification::Specification;
use leptos::prelude::*;

pub(crate) use heard::{Heard, SeenExecutor};

/// The two things that the Run tab is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum RunMode {
    /// Try the automaton without a robot.
    #[default]
    Simulate,
    /// Watch what robots do.
    Monitor,
}

/// How the line to the server is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Connection {
    /// Nobody has answered yet.
    #[default]
    Connecting,
    /// What is shown is what is so.
    Live,
    /// It broke off; what is shown is from before. Tried again and again.
    Lost {
        /// Since when, in milliseconds since 1970.
        since_ms: f64,
    },
    /// Nobody answers here. Tried again now and then.
    NoServer,
}

/// The events of a run, from the first on, as far as they were fetched.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct EventLog {
    /// Id of the run.
    pub(crate) run: String,
    /// The events: number 1 first, without gaps.
    pub(crate) events: Vec<StoredEvent>,
    /// Whether more of them are on their way.
    pub(crate) fetching: bool,
    /// Why there are no more, when the server did not give them.
    pub(crate) failed: Option<String>,
}

impl EventLog {
    /// The first events, up to this number, as far as they are here.
    pub(crate) fn up_to(&self, number: u64) -> &[StoredEvent] {
        let end = usize::try_from(number).map_or(self.events.len(), |end| end.min(self.events.len()));
        &self.events[..end]
    }
}

/// A look at a run as it was after one of its events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Replay {
    /// Number of the last event that counts; 0 for none.
    pub(crate) at: u64,
    /// Whether it goes on by itself.
    pub(crate) playing: bool,
}

/// Kinds of events, as people look for them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EventKind {
    /// Plans, new plans, and that there is none.
    Plan,
    /// Sub-goals begun and completed.
    SubGoal,
    /// What can be done, and what cannot.
    Availability,
    /// Paused, resumed, and how it ended.
    Course,
}

impl EventKind {
    /// All kinds.
    pub(crate) const ALL: [Self; 4] = [Self::Plan, Self::SubGoal, Self::Availability, Self::Course];

    /// The kind of an event.
    pub(crate) fn of(event: &RunEvent) -> Self {
        match event {
            RunEvent::Planned { .. } | RunEvent::Replanned { .. } | RunEvent::Waiting { .. } => Self::Plan,
            RunEvent::Started { .. } | RunEvent::Completed { .. } => Self::SubGoal,
            RunEvent::Unavailable { .. } | RunEvent::Available { .. } => Self::Availability,
            RunEvent::Paused
            | RunEvent::Resumed
            | RunEvent::Finished
            | RunEvent::Failed { .. }
            | RunEvent::Stopped => Self::Course,
        }
    }

    /// What people call it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Plan => "Plans",
            Self::SubGoal => "Sub-goals",
            Self::Availability => "Availability",
            Self::Course => "Pauses and end",
        }
    }
}

/// Which events are listed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct EventFilter {
    /// Those of this kind; none for every kind.
    pub(crate) kind: Option<EventKind>,
    /// Those with this in their sentence.
    pub(crate) text: String,
}

/// Runs that were over before the server's snapshot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Older {
    /// Where the next of them begin; none before the first were fetched.
    pub(crate) next: Option<String>,
    /// Whether there are no more.
    pub(crate) complete: bool,
    /// Whether some are on their way.
    pub(crate) fetching: bool,
}

/// Ground state of watching.
pub(crate) struct Watching {
    /// What the Run tab shows; none until somebody went there.
    pub(crate) mode: RwSignal<Option<RunMode>>,
    /// How the line to the server is.
    pub(crate) connection: RwSignal<Connection>,
    /// What the server said.
    pub(crate) heard: RwSignal<Heard>,
    /// The run that somebody chose to look at; none for the newest.
    pub(crate) chosen: RwSignal<Option<String>>,
    /// The executor that somebody chose to command; none for that of the run.
    pub(crate) executor: RwSignal<Option<String>>,
    /// The events of the run that is looked at.
    pub(crate) log: RwSignal<EventLog>,
    /// A look at an earlier moment; none for the newest.
    pub(crate) replay: RwSignal<Option<Replay>>,
    /// How many events a second a replay shows.
    pub(crate) pace: RwSignal<u32>,
    /// Which events are listed.
    pub(crate) filter: RwSignal<EventFilter>,
    /// Runs from before.
    pub(crate) older: RwSignal<Older>,
    /// Specifications that runs follow, by their SHA-256; none where the server does not give one.
    pub(crate) followed: RwSignal<BTreeMap<String, Option<Arc<Specification>>>>,
}

impl Watching {
    /// Nothing heard yet.
    pub(crate) fn new() -> Self {
        Self {
            mode: RwSignal::default(),
            connection: RwSignal::default(),
            heard: RwSignal::default(),
            chosen: RwSignal::default(),
            executor: RwSignal::default(),
            log: RwSignal::default(),
            replay: RwSignal::default(),
            pace: RwSignal::new(2),
            filter: RwSignal::default(),
            older: RwSignal::default(),
            followed: RwSignal::default(),
        }
    }
}
