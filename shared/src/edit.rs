//! Corrections of a specification as data: each knows its inverse and changes nothing when it fails.
//!
//! An [`Edit`] is applied to a specification and gives a [`Change`]: the patch that undoes it, and what became of the
//! states. Ids of states are never reused: an edit that may need new states is given the first of them.
//!
//! Counts are evidence. An edit may move them with what they belong to, add them up, or drop them with what is pruned;
//! none makes up new ones.

mod add_word;
mod alphabet;
mod automaton;
mod error;
mod fold;
mod forbid_word;
mod ids;
mod label;
mod merge;
mod name;
mod patch;
mod perform;
mod prune;
mod reach;
mod reread;
mod reweight;
mod sub_goals;
mod transition;

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::pdfa::{Semantics, StateId, Symbol, Word};
use crate::specification::Specification;

pub use crate::specification::COLORS;
pub use error::EditError;
pub use name::MAX_NAME;
pub use patch::Patch;

/// One correction of a specification.
///
/// Ids that are given for new states (`id`, `first_new`, from which on they are counted upwards) must be above every id
/// of the specification. Names have at most [`MAX_NAME`] characters, none of them a control character.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Edit {
    /// Renames the task.
    RenameTask {
        /// The new name, not blank.
        name: String,
    },
    /// Changes how weights are read as probabilities.
    SetSemantics {
        /// The new reading.
        semantics: Semantics,
    },
    /// Makes two states one: it has the transitions of both, and where both have one by the same symbol, their targets
    /// are merged as well, and so on (folding). Counts and weights add up; the state is accepting when one of them was,
    /// completed is what both completed, its name is the kept state's or else the other's.
    ///
    /// What contains `kept` keeps its id; states that fold elsewhere keep the smallest id among them. What contains the
    /// initial state is the initial state. Cycles may arise.
    MergeStates {
        /// The state that stays.
        kept: StateId,
        /// The state that becomes part of it.
        merged: StateId,
    },
    /// Removes a state with its transitions and whatever can no longer be reached without it. The initial state stays.
    PruneState {
        /// The state.
        state: StateId,
        /// What becomes of the ways through it.
        ways: Pruned,
    },
    /// Removes a transition and whatever can no longer be reached without it.
    PruneTransition {
        /// Where it starts.
        source: StateId,
        /// Its symbol.
        symbol: Symbol,
        /// What becomes of the ways through it.
        ways: Pruned,
    },
    /// Gives an outcome of a state a probability; the others share the rest in proportion to their probabilities.
    ///
    /// When those are all zero they share it in proportion to their counts, and when those are zero, too, equally.
    Reweight {
        /// Where the choice is.
        state: StateId,
        /// What is chosen.
        outcome: Outcome,
        /// Its probability from now on.
        probability: f64,
        /// Outcomes that keep their probabilities.
        locked: BTreeSet<Outcome>,
    },
    /// Makes the weights of a state equal to its counts again.
    ResetWeights {
        /// The state.
        state: StateId,
    },
    /// Lets the task end in a state, or not. An end that has no weight gets that of its count, at least 1; one that is
    /// taken away has none.
    SetAccepting {
        /// The state.
        state: StateId,
        /// Whether the task may end there.
        accepting: bool,
    },
    /// Adds a state to which nothing leads yet.
    AddState {
        /// Its id.
        id: StateId,
    },
    /// Adds a transition with the weight of one demonstration and the count of none. A state to which nothing led
    /// before completes what is completed on this way.
    AddTransition {
        /// Where it starts.
        source: StateId,
        /// Its symbol, which no other transition from there has.
        symbol: Symbol,
        /// Where it leads.
        target: StateId,
    },
    /// Moves the ends of a transition, which keeps its weight. From another source it starts without count, for no
    /// demonstration went that way.
    MoveTransition {
        /// Where it starts.
        source: StateId,
        /// Its symbol.
        symbol: Symbol,
        /// Where it starts from now on; no other transition from there has the symbol.
        new_source: StateId,
        /// Where it leads from now on.
        new_target: StateId,
    },
    /// Names a state.
    RenameState {
        /// The state.
        state: StateId,
        /// Its name; empty takes the name away.
        name: String,
    },
    /// Renames a sub-goal.
    RenameSubGoal {
        /// The sub-goal.
        symbol: Symbol,
        /// The new name, not blank.
        name: String,
    },
    /// Gives a sub-goal a color.
    RecolorSubGoal {
        /// The sub-goal.
        symbol: Symbol,
        /// Below [`COLORS`]; none leaves the choice to whoever draws.
        color: Option<u8>,
    },
    /// Makes two sub-goals one and reads words and automaton again: in words, `kept` stands for both, and only the first
    /// of several stays. Its ball is the smallest that encloses both, its frames are those of both.
    ///
    /// States keep the id of the state with the same completed sub-goals, with their names, and with weights that an
    /// expert changed where source, symbol and target are the same. Other changes of the automaton are not kept.
    MergeSubGoals {
        /// The sub-goal that stays.
        kept: Symbol,
        /// The sub-goal that becomes part of it.
        merged: Symbol,
        /// The first id for new states.
        first_new: StateId,
    },
    /// Removes a sub-goal and reads words and automaton again, see [`Edit::MergeSubGoals`]; one that is in no word and on
    /// no transition goes without that.
    RemoveSubGoal {
        /// The sub-goal.
        symbol: Symbol,
        /// The first id for new states.
        first_new: StateId,
    },
    /// Makes a word accepted as if it had been demonstrated once, but without count: its way gains a weight of 1.
    /// Where there is no transition, one is added to the state with the completed sub-goals of that place (the smallest
    /// id of several), or else to a new state.
    ///
    /// Words share states: what may follow or end somewhere now may do so after every word that leads there, and where
    /// a new transition leads into a state that was there, all that can follow there is accepted as well.
    AddWord {
        /// The word.
        word: Word,
        /// The first id for new states.
        first_new: StateId,
    },
    /// Makes a word rejected, and nothing else: states on its way that other words share are split. The other words
    /// keep their proportions. The word's evidence goes with its way; states where nothing is left to do are removed.
    ForbidWord {
        /// The word.
        word: Word,
        /// The first id for new states.
        first_new: StateId,
    },
    /// Puts another specification in the place of this one: learned again, or opened.
    Replace {
        /// The text of its file.
        specification: String,
    },
}

/// What becomes of the ways through what is pruned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pruned {
    /// They go.
    Cut,
    /// They go past it: where a pruned transition started, the outcomes of its target take its place and share out its
    /// weight. Where there is already a transition by the same symbol, the targets are merged (the smallest id stays).
    ///
    /// New ways have no count, for no demonstration went that way. Self-loops of the target are dropped.
    Heal,
}

/// What may happen in a state. Transitions are ordered by symbol, the end comes last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The sub-goal is completed next.
    Transition(Symbol),
    /// The word ends.
    End,
}

/// What an edit did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// What undoes it.
    pub inverse: Patch,
    /// States that are gone, with the state that each is part of now.
    pub folded: BTreeMap<StateId, StateId>,
    /// States that are gone altogether.
    pub removed: BTreeSet<StateId>,
    /// New states.
    pub added: BTreeSet<StateId>,
}

/// States that became part of others: gone -> stays.
type Folded = BTreeMap<StateId, StateId>;

impl Edit {
    /// Applies the edit; one that fails leaves everything as it was.
    ///
    /// Counts that become too large to be numbers stay at the largest, weights at 1e100, the largest of a file.
    ///
    /// # Errors
    ///
    /// When it names what is not there, gives a number or name out of its range, or would do what must not be: each
    /// [`EditError`] says it in a sentence.
    ///
    /// # Complexity
    ///
    /// Linear in the size of the specification, O(T · A + Q log Q) for T transitions, A symbols and Q states.
    ///
    /// # Example
    ///
    /// ```
    /// use goalgraph::edit::Edit;
    /// use goalgraph::infer::infer_words;
    /// use goalgraph::pdfa::{Semantics, StateId};
    ///
    /// let word = |names: &[&str]| names.iter().map(|name| name.to_string()).collect();
    /// let words = [word(&["a", "b"]), word(&["c"])];
    /// let learned = infer_words("Task", Semantics::default(), &words);
    ///
    /// let mut specification = learned.clone();
    /// let merge = Edit::MergeStates { kept: StateId(2), merged: StateId(3) };
    /// assert_eq!(merge.label(&specification), "Merge q3 into q2");
    /// let change = merge.apply(&mut specification)?;
    /// assert_eq!(specification.pdfa.states.len(), 3);
    ///
    /// let _again = change.inverse.apply(&mut specification);
    /// assert_eq!(specification, learned);
    /// # Ok::<(), goalgraph::edit::EditError>(())
    /// ```
    pub fn apply(&self, specification: &mut Specification) -> Result<Change, EditError> {
        let mut after = specification.clone();
        let folded = self.perform(&mut after)?;
        let inverse = Patch::between(&after, specification);
        let (old, new) = (&specification.pdfa.states, &after.pdfa.states);
        let gone = old.keys().filter(|id| !new.contains_key(id) && !folded.contains_key(id));
        let removed = gone.copied().collect();
        let added = new.keys().filter(|id| !old.contains_key(id)).copied().collect();
        *specification = after;
        Ok(Change { inverse, folded, removed, added })
    }
}
