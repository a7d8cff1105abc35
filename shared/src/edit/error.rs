//! Why an edit is refused.

use thiserror::Error;

use super::{COLORS, MAX_NAME, Outcome};
use crate::pdfa::{StateId, Symbol};
use crate::specification::ReadError;

/// Why an edit is refused: one sentence that names what, where and the limit.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum EditError {
    /// An edit names a state that is not there.
    #[error("{0}: there is no such state")]
    NoState(StateId),
    /// An edit names a sub-goal that is not there.
    #[error("{0}: there is no such sub-goal")]
    NoSubGoal(Symbol),
    /// An edit names a transition that is not there.
    #[error("{0}: there is no transition by {1}")]
    NoTransition(StateId, Symbol),
    /// An edit names an end where no word may end.
    #[error("{0}: no word may end here, so ending has no probability")]
    NotAccepting(StateId),
    /// Two transitions would leave a state by one symbol.
    #[error("{0}: there is already a transition by {1}")]
    TransitionExists(StateId, Symbol),
    /// A state is to become part of itself.
    #[error("{0} cannot be merged into itself")]
    SameState(StateId),
    /// A sub-goal is to become part of itself.
    #[error("{0} cannot be merged into itself")]
    SameSubGoal(Symbol),
    /// The state where every word starts is to go.
    #[error("the initial state {0} cannot be pruned")]
    InitialPruned(StateId),
    /// An id is not above all ids.
    #[error("{0}: a new state needs an id above {1}, because ids are never reused")]
    IdTaken(StateId, StateId),
    /// There is no number above the largest id.
    #[error("there is no id left for a new state: q{max} is the last", max = u32::MAX)]
    NoIdLeft,
    /// A probability that is none.
    #[error("the probability must be a number from 0 to 1, not {0}")]
    Probability(f64),
    /// Probabilities above 1 in sum.
    #[error("{state}: {probability} and the locked {locked} are more than 1")]
    TooMuch {
        /// Where.
        state: StateId,
        /// What was asked for.
        probability: f64,
        /// The sum of the locked probabilities.
        locked: f64,
    },
    /// Probabilities below 1 in sum.
    #[error(
        "{state}: {probability} and the locked {locked} are less than 1, and nothing is left that could take the rest"
    )]
    NothingLeft {
        /// Where.
        state: StateId,
        /// What was asked for.
        probability: f64,
        /// The sum of the locked probabilities.
        locked: f64,
    },
    /// Under equation 3 of the paper, probabilities of ending follow from the weights of transitions.
    #[error(
        "{0}: the published semantics derive the probability of ending from what flows in; it cannot be set"
    )]
    Derived(StateId),
    /// Without evidence there are no weights to go back to.
    #[error("{0}: no demonstration was here, so there are no counts to go back to")]
    NoEvidence(StateId),
    /// A name that is too long.
    #[error("the name has {0} characters; at most {MAX_NAME} are allowed")]
    LongName(usize),
    /// A name that nobody can see.
    #[error("the name is blank")]
    BlankName,
    /// A name with a line feed or another control character.
    #[error("the name has the control character {0:?}; only visible characters are allowed")]
    ControlCharacter(char),
    /// A color outside the palette.
    #[error("color: {0} must be below {COLORS}")]
    Color(u8),
    /// Sub-goals of different subsets have no common ball.
    #[error("{0} and {1} are places of different features and cannot be merged")]
    DifferentSubsets(Symbol, Symbol),
    /// Balls so far apart that no number says how far.
    #[error("{0} and {1} are too far apart to be merged: the radius has no number")]
    TooFarApart(Symbol, Symbol),
    /// A sub-goal of an automaton whose words are not known.
    #[error("{0}: there are no demonstrations from which the automaton could be read again without it")]
    NoWords(Symbol),
    /// A word that the automaton accepts anyway.
    #[error("the word is accepted already")]
    Accepted,
    /// A word that the automaton does not accept anyway.
    #[error("the word is not accepted, so it cannot be forbidden")]
    NotAccepted,
    /// Another specification that cannot be read.
    #[error("the new specification cannot be read: {0}")]
    Unreadable(#[from] ReadError),
}

impl EditError {
    /// That `outcome` of `state` is not there.
    pub(super) fn no_outcome(state: StateId, outcome: Outcome) -> Self {
        match outcome {
            Outcome::Transition(symbol) => Self::NoTransition(state, symbol),
            Outcome::End => Self::NotAccepting(state),
        }
    }
}
