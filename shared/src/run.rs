//! A run: what an executor reports while it works through a plan, and where that puts it in the automaton.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::pdfa::{Pdfa, Probabilities, StateId, Symbol, Word};

/// What an executor reports during a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "event", rename_all = "snake_case", deny_unknown_fields)]
pub enum RunEvent {
    /// The first plan: the sub-goals ahead, in order, with the probability of the plan.
    Planned {
        /// Where the plan starts.
        state: StateId,
        /// The sub-goals ahead, in order.
        word: Word,
        /// Probability of the plan, from 0 to 1.
        probability: f64,
    },
    /// The executor works on a sub-goal.
    Started {
        /// The sub-goal.
        sub_goal: Symbol,
    },
    /// A sub-goal is completed, whether or not it was the one worked on.
    Completed {
        /// The sub-goal.
        sub_goal: Symbol,
    },
    /// A sub-goal cannot be completed for the time being.
    Unavailable {
        /// The sub-goal.
        sub_goal: Symbol,
        /// Why, for people.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        reason: Option<String>,
    },
    /// A sub-goal that was unavailable can be completed again.
    Available {
        /// The sub-goal.
        sub_goal: Symbol,
    },
    /// A new plan took the place of the one before.
    Replanned {
        /// Where the plan starts.
        state: StateId,
        /// The sub-goals ahead, in order.
        word: Word,
        /// Probability of the plan, from 0 to 1.
        probability: f64,
    },
    /// No plan is left with what is available: the executor waits.
    Waiting {
        /// Where it waits.
        state: StateId,
    },
    /// The executor was told to pause.
    Paused,
    /// The executor goes on after a pause.
    Resumed,
    /// The task is done. Nothing comes after it.
    Finished,
    /// The executor gave up. Nothing comes after it.
    Failed {
        /// Why, for people.
        reason: String,
    },
    /// The executor was told to stop, and did. Nothing comes after it.
    Stopped,
}

/// How a run stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// At work.
    #[default]
    Running,
    /// Without a plan until something becomes available.
    Waiting,
    /// Paused on command.
    Paused,
    /// Done.
    Finished,
    /// Given up.
    Failed,
    /// Ended on command.
    Stopped,
}

impl Phase {
    /// Whether nothing comes after it.
    pub fn is_over(self) -> bool {
        matches!(self, Self::Finished | Self::Failed | Self::Stopped)
    }
}

/// How a run left what the automaton knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Departure {
    /// A sub-goal was completed for which there is no way of positive probability.
    NoWay {
        /// Number of the event.
        number: u64,
        /// The state without the way.
        state: StateId,
        /// The sub-goal.
        sub_goal: Symbol,
    },
    /// It finished where the task does not end.
    EndedEarly {
        /// Number of the event.
        number: u64,
        /// The state in which the task does not end.
        state: StateId,
    },
}

/// Why an event is not taken.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum EventError {
    /// The run is over.
    #[error("event {number}: the run is over since event {last}, so nothing can follow")]
    Over {
        /// Number of the event.
        number: u64,
        /// Number of the event that ended the run.
        last: u64,
    },
    /// An event is missing before it.
    #[error("event {number}: expected event {expected}; events are numbered from 1 without gaps")]
    Gap {
        /// Number of the event.
        number: u64,
        /// Number that would have been right.
        expected: u64,
    },
}

/// Where a run stands after its events so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// How it stands.
    pub phase: Phase,
    /// Where it is in the automaton; none once it has left it.
    pub state: Option<StateId>,
    /// The sub-goals completed, in order.
    pub trail: Word,
    /// The states passed while it followed the automaton: the first is the initial state.
    pub states: Vec<StateId>,
    /// The sub-goal that it works on.
    pub active: Option<Symbol>,
    /// The sub-goals still ahead by the last plan, in order.
    pub plan: Word,
    /// What it reported as unavailable.
    pub unavailable: BTreeSet<Symbol>,
    /// How often it planned anew.
    pub replans: u64,
    /// How many events it has.
    pub events: u64,
    /// How it left the automaton, if it did.
    pub departure: Option<Departure>,
    /// Natural logarithm of the probability of the transitions taken: at most 0, and 0 before the first.
    pub log_likelihood: f64,
}

impl Run {
    /// A run of which nothing has been reported yet.
    pub fn new(pdfa: &Pdfa) -> Self {
        Self {
            phase: Phase::Running,
            state: Some(pdfa.initial),
            trail: Word::new(),
            states: vec![pdfa.initial],
            active: None,
            plan: Word::new(),
            unavailable: BTreeSet::new(),
            replans: 0,
            events: 0,
            departure: None,
            log_likelihood: 0.0,
        }
    }

    /// Takes the event with this number into account. On an error nothing has changed.
    ///
    /// # Errors
    ///
    /// When the number is not the one after the last, or the run is over.
    ///
    /// # Complexity
    ///
    /// O(log T) for T transitions, and the length of a plan.
    pub fn apply(
        &mut self,
        pdfa: &Pdfa,
        probabilities: &Probabilities,
        number: u64,
        event: &RunEvent,
    ) -> Result<(), EventError> {
        if number != self.events + 1 {
            return Err(EventError::Gap { number, expected: self.events + 1 });
        }
        if self.phase.is_over() {
            return Err(EventError::Over { number, last: self.events });
        }
        self.events = number;
        match event {
            RunEvent::Planned { word, .. } => self.follow(word),
            RunEvent::Replanned { word, .. } => {
                self.replans += 1;
                self.follow(word);
            }
            RunEvent::Started { sub_goal } => self.active = Some(*sub_goal),
            RunEvent::Completed { sub_goal } => self.complete(pdfa, probabilities, *sub_goal),
            RunEvent::Unavailable { sub_goal, .. } => {
                self.unavailable.insert(*sub_goal);
                self.active = self.active.filter(|active| active != sub_goal);
            }
            RunEvent::Available { sub_goal } => {
                self.unavailable.remove(sub_goal);
            }
            RunEvent::Waiting { .. } => {
                self.active = None;
                self.plan.clear();
                self.phase = Phase::Waiting;
            }
            RunEvent::Paused => self.phase = Phase::Paused,
            RunEvent::Resumed => self.phase = Phase::Running,
            RunEvent::Finished => self.finish(probabilities),
            RunEvent::Failed { .. } => self.end(Phase::Failed),
            RunEvent::Stopped => self.end(Phase::Stopped),
        }
        Ok(())
    }

    fn follow(&mut self, word: &[Symbol]) {
        self.plan = word.to_vec();
        if self.phase == Phase::Waiting {
            self.phase = Phase::Running;
        }
    }

    fn complete(&mut self, pdfa: &Pdfa, probabilities: &Probabilities, sub_goal: Symbol) {
        self.trail.push(sub_goal);
        self.active = self.active.filter(|active| *active != sub_goal);
        if self.plan.first() == Some(&sub_goal) {
            self.plan.remove(0);
        }
        let Some(state) = self.state else {
            return;
        };
        let probability = probabilities.transition(state, sub_goal);
        if let Some(way) = pdfa.transition(state, sub_goal).filter(|_| probability > 0.0) {
            self.log_likelihood += probability.ln();
            self.state = Some(way.target);
            self.states.push(way.target);
        } else {
            self.departure.get_or_insert(Departure::NoWay { number: self.events, state, sub_goal });
            self.state = None;
        }
    }

    fn finish(&mut self, probabilities: &Probabilities) {
        if let Some(state) = self.state.filter(|&state| probabilities.end(state) <= 0.0) {
            self.departure.get_or_insert(Departure::EndedEarly { number: self.events, state });
        }
        self.end(Phase::Finished);
    }

    fn end(&mut self, phase: Phase) {
        self.active = None;
        self.plan.clear();
        self.phase = phase;
    }
}
