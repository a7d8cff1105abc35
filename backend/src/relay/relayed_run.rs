//! A run as the relay follows it.

use goalgraph::pdfa::{Pdfa, Probabilities};
use goalgraph::protocol::monitor::{RunOrigin, RunView};
use goalgraph::run::{EventError, Run, RunEvent};
use goalgraph::specification::Specification;
use jiff::Timestamp;

use std::sync::Arc;

use super::lease::Lease;

/// What runs of a revision are followed through.
#[derive(Debug)]
pub(super) struct Automaton {
    /// What the specification is called.
    pub(super) name: String,
    pdfa: Pdfa,
    probabilities: Probabilities,
}

impl Automaton {
    /// The automaton of a specification.
    pub(super) fn of(specification: Specification) -> Self {
        let probabilities = specification.pdfa.probabilities(specification.semantics);
        Self { name: specification.name, pdfa: specification.pdfa, probabilities }
    }

    /// A run of which nothing has been reported yet.
    pub(super) fn run(&self) -> Run {
        Run::new(&self.pdfa)
    }
}

/// A run with everything that is known of it.
#[derive(Debug, Clone)]
pub(super) struct RelayedRun {
    /// What its events do not tell. `executor` holds it, or held it last.
    pub(super) origin: RunOrigin,
    /// Its place in the order of the server's runs: a newer one has a larger number.
    pub(super) sequence: u64,
    /// What it is followed through.
    pub(super) automaton: Arc<Automaton>,
    /// Where it stands after the events that are stored.
    pub(super) run: Run,
    /// When its last event was stored, in milliseconds since 1970.
    pub(super) heard_at_ms: i64,
    /// Who may report events, once somebody asked.
    pub(super) lease: Option<Lease>,
    /// Whether the store has been told that the run is over.
    pub(super) closed: bool,
}

impl RelayedRun {
    /// Takes an event into account that is stored.
    ///
    /// # Errors
    ///
    /// When it cannot be the next; nothing has changed then.
    pub(super) fn apply(&mut self, number: u64, event: &RunEvent, at_ms: i64) -> Result<(), EventError> {
        self.run.apply(&self.automaton.pdfa, &self.automaton.probabilities, number, event)?;
        self.heard_at_ms = at_ms;
        Ok(())
    }

    /// The run as a page sees it.
    pub(super) fn view(&self) -> RunView {
        RunView::new(self.origin.clone(), &self.run, rfc3339(self.heard_at_ms))
    }
}

/// Whether nothing can come after `event`.
pub(super) fn ends_run(event: &RunEvent) -> bool {
    matches!(event, RunEvent::Finished | RunEvent::Failed { .. } | RunEvent::Stopped)
}

/// The wall clock, in milliseconds since 1970: for people, nothing is ordered by it.
pub(super) fn now_ms() -> i64 {
    Timestamp::now().as_millisecond()
}

/// A time of the wall clock as text. One beyond the calendar is its nearest end.
pub(super) fn rfc3339(at_ms: i64) -> String {
    let end = if at_ms < 0 { Timestamp::MIN } else { Timestamp::MAX };
    Timestamp::from_millisecond(at_ms).unwrap_or(end).to_string()
}
