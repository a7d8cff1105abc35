//! Problems as values: what it is, where, how much it matters, and a sentence.

use std::fmt;

use crate::pdfa::{StateId, Symbol};

/// How much a problem matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// A robot must not be given this.
    Error,
    /// Worth a look.
    Warning,
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// How much it matters.
    pub severity: Severity,
    /// What is wrong, and with what.
    pub kind: ProblemKind,
    /// One sentence.
    pub message: String,
}

/// What may be wrong.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ProblemKind {
    /// No word is accepted: from the initial state no end can be reached.
    NothingAccepted(StateId),
    /// The state cannot be reached from the initial state.
    Unreachable(StateId),
    /// From the state, which is not accepting, no end can be reached.
    DeadEnd(StateId),
    /// The state is accepting, but no word ends there or further on, for want of weight.
    NoWeight(StateId),
    /// The state is accepting, and words end further on, but none ends there.
    NeverEnds(StateId),
    /// The transition from the first state by the symbol to the second has probability zero.
    NeverTaken(StateId, Symbol, StateId),
    /// No transition uses the sub-goal.
    Unused(Symbol),
    /// The balls of two sub-goals overlap, the first earlier in the alphabet.
    Overlap(Symbol, Symbol),
    /// Each of the states can be reached from each of them: words can be of any length. In ascending order, never empty.
    Cycle(Vec<StateId>),
}

/// Where a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// A state, written `q3`.
    State(StateId),
    /// The transition from a state by a symbol to another, written `q0 g1 q2`.
    Transition(StateId, Symbol, StateId),
    /// A sub-goal, written `g1`.
    SubGoal(Symbol),
}

impl Problem {
    /// The state, transition or sub-goal that it is about: of overlapping sub-goals the later one, of a cycle its first
    /// state.
    pub fn place(&self) -> Place {
        match self.kind {
            ProblemKind::NothingAccepted(state)
            | ProblemKind::Unreachable(state)
            | ProblemKind::DeadEnd(state)
            | ProblemKind::NoWeight(state)
            | ProblemKind::NeverEnds(state) => Place::State(state),
            ProblemKind::NeverTaken(source, symbol, target) => Place::Transition(source, symbol, target),
            ProblemKind::Unused(symbol) | ProblemKind::Overlap(_, symbol) => Place::SubGoal(symbol),
            ProblemKind::Cycle(ref states) => Place::State(states.first().copied().unwrap_or(StateId(0))),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::State(state) => write!(formatter, "{state}"),
            Self::Transition(source, symbol, target) => write!(formatter, "{source} {symbol} {target}"),
            Self::SubGoal(symbol) => write!(formatter, "{symbol}"),
        }
    }
}
