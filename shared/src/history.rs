//! What was done to a specification, gesture by gesture: undo, redo, and a log from which all of it can be done again.

mod log;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::edit::{Edit, EditError, Patch};
use crate::pdfa::StateId;
use crate::specification::Specification;

pub use log::{HistoryError, HistoryLog};

/// One gesture of an expert: it happens as a whole or not at all.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transaction {
    /// What it is called in the list of what was done.
    pub label: String,
    /// What it does, in order.
    pub edits: Vec<Edit>,
}

/// What a position in a history is remembered for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mark {
    /// It was saved.
    Saved,
    /// It was approved.
    Approved,
}

/// A specification with everything that was done to it.
///
/// Positions count transactions: 0 is the base, [`History::position`] the present. What was undone lies after the
/// present until the next commit forgets it.
///
/// # Example
///
/// ```
/// use goalgraph::edit::Edit;
/// use goalgraph::history::{History, Transaction};
/// use goalgraph::infer::infer_words;
///
/// let mut history = History::new(infer_words("Task", Default::default(), &[]));
/// let rename = Edit::RenameTask { name: "Two stacks".to_owned() };
/// let label = rename.label(history.specification());
/// history.commit(Transaction { label, edits: vec![rename] })?;
/// assert_eq!(history.labels(), ["Rename the task to Two stacks"]);
/// assert!(history.undo());
/// assert_eq!(history.specification().name, "Task");
/// # Ok::<(), goalgraph::edit::EditError>(())
/// ```
#[derive(Clone, Debug)]
pub struct History {
    base: Arc<Specification>,
    present: Arc<Specification>,
    position: usize,
    entries: Vec<Entry>,
    marks: BTreeMap<Mark, usize>,
    next_state: StateId,
}

/// A transaction with the way to its other side: back when it is before the present, forth when it is after it.
#[derive(Clone, Debug)]
struct Entry {
    transaction: Transaction,
    patch: Patch,
    /// What the last replacement in it put in place.
    learned: Option<Arc<Specification>>,
}

impl History {
    /// A history in which nothing was done to `base` yet.
    pub fn new(base: Specification) -> Self {
        let next_state = id_above(&base, StateId(0));
        let base = Arc::new(base);
        let present = Arc::clone(&base);
        Self { base, present, position: 0, entries: Vec::new(), marks: BTreeMap::new(), next_state }
    }

    /// The specification at the present position.
    pub fn specification(&self) -> &Specification {
        &self.present
    }

    /// The specification at the present position, to be kept.
    pub fn shared(&self) -> Arc<Specification> {
        Arc::clone(&self.present)
    }

    /// What was learned or opened last: by the last [`Edit::Replace`] before the present position, or the base.
    pub fn learned(&self) -> Arc<Specification> {
        let before = self.entries.iter().take(self.position);
        let replaced = before.rev().find_map(|entry| entry.learned.as_ref());
        Arc::clone(replaced.unwrap_or(&self.base))
    }

    /// The first id that no state ever had, also in what was undone and forgotten; the largest id when all were used.
    pub fn next_state(&self) -> StateId {
        self.next_state
    }

    /// Does `transaction` and forgets what was undone, with the marks on it.
    ///
    /// # Errors
    ///
    /// That of its first edit that cannot be done; nothing is done then.
    ///
    /// # Complexity
    ///
    /// That of its edits, see [`Edit::apply`].
    pub fn commit(&mut self, transaction: Transaction) -> Result<(), EditError> {
        let mut next = Specification::clone(&self.present);
        let mut next_state = self.next_state;
        let mut learned = None;
        for edit in &transaction.edits {
            let had: BTreeSet<StateId> = next.pdfa.states.keys().copied().collect();
            edit.perform(&mut next)?;
            refuse_reused(&next, &had, next_state, edit)?;
            next_state = id_above(&next, next_state);
            if let Edit::Replace { .. } = edit {
                learned = Some(Arc::new(next.clone()));
            }
        }
        let patch = Patch::between(&next, &self.present);
        self.entries.truncate(self.position);
        self.marks.retain(|_, position| *position <= self.position);
        self.entries.push(Entry { transaction, patch, learned });
        self.position += 1;
        self.next_state = next_state;
        self.present = Arc::new(next);
        Ok(())
    }

    /// Takes the last transaction back; false when there is none.
    pub fn undo(&mut self) -> bool {
        let Some(position) = self.position.checked_sub(1) else {
            return false;
        };
        self.cross(position);
        self.position = position;
        true
    }

    /// Does again what was undone last; false when there is nothing.
    pub fn redo(&mut self) -> bool {
        if self.position == self.entries.len() {
            return false;
        }
        self.cross(self.position);
        self.position += 1;
        true
    }

    /// Goes to `position`, or to the last one when there are fewer.
    pub fn jump(&mut self, position: usize) {
        let position = position.min(self.entries.len());
        while self.position > position {
            self.undo();
        }
        while self.position < position {
            self.redo();
        }
    }

    /// Crosses the entry at `index` in the direction in which its patch leads.
    fn cross(&mut self, index: usize) {
        if let Some(entry) = self.entries.get_mut(index) {
            let patch = std::mem::take(&mut entry.patch);
            entry.patch = patch.apply(Arc::make_mut(&mut self.present));
        }
    }

    /// How many transactions lead from the base to the present.
    pub fn position(&self) -> usize {
        self.position
    }

    /// What the transactions are called, also those that were undone; the base has no label.
    pub fn labels(&self) -> Vec<String> {
        self.entries.iter().map(|entry| entry.transaction.label.clone()).collect()
    }

    /// Remembers the present position for `mark`, and no other.
    pub fn mark(&mut self, mark: Mark) {
        self.marks.insert(mark, self.position);
    }

    /// The position of `mark`; none when it was never set or what it was set on is forgotten.
    pub fn marked(&self, mark: Mark) -> Option<usize> {
        self.marks.get(&mark).copied()
    }
}

/// An id that was given before is never given again, not even of a state that is gone. Another specification has its own.
fn refuse_reused(
    after: &Specification,
    had: &BTreeSet<StateId>,
    next_state: StateId,
    edit: &Edit,
) -> Result<(), EditError> {
    let reused = |id: &&StateId| **id < next_state && !had.contains(id);
    match after.pdfa.states.keys().find(reused) {
        Some(&id) if !matches!(edit, Edit::Replace { .. }) => {
            Err(EditError::IdTaken(id, StateId(next_state.0 - 1)))
        }
        _ => Ok(()),
    }
}

/// The smallest id that is above all states and not below `least`.
fn id_above(specification: &Specification, least: StateId) -> StateId {
    let last = specification.pdfa.states.keys().next_back();
    last.map_or(least, |last| least.max(StateId(last.0.saturating_add(1))))
}
