//! A history as a file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{History, Mark, Transaction};
use crate::edit::EditError;
use crate::pdfa::StateId;
use crate::specification::{ReadError, Specification};
use crate::versioned::{VersionedError, read_versioned};

const FORMAT: &str = "goalgraph-history";
const VERSION: u32 = 1;

/// A history as data: what it starts from and everything that was done, in order. All else follows from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HistoryLog {
    /// What kind of data this is: `goalgraph-history`.
    pub format: String,
    /// Version of the format: 1.
    pub version: u32,
    /// Text of the specification's file before the first transaction.
    pub base: String,
    /// What was done, also what was undone after it.
    pub transactions: Vec<Transaction>,
    /// How many of the transactions are done.
    pub position: usize,
    /// Positions that are remembered.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub marks: BTreeMap<Mark, usize>,
    /// The first id that no state ever had.
    pub next_state: StateId,
}

/// Why data is no history.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum HistoryError {
    /// It is no JSON of this shape, or of another format or version.
    #[error(transparent)]
    Versioned(#[from] VersionedError),
    /// The specification that it starts from cannot be read.
    #[error("base: {0}")]
    Base(#[from] ReadError),
    /// Something cannot be done that is said to have been done.
    #[error("transactions[{index}], {label:?}: {error}")]
    Transaction {
        /// Which, from 0.
        index: usize,
        /// What it is called.
        label: String,
        /// Why not.
        error: EditError,
    },
    /// A position after the last.
    #[error("{place}: {position}, but there are {transactions} transactions")]
    Position {
        /// Where it is.
        place: &'static str,
        /// The position.
        position: usize,
        /// How many transactions there are.
        transactions: usize,
    },
}

impl History {
    /// The history as data.
    pub fn log(&self) -> HistoryLog {
        HistoryLog {
            format: FORMAT.to_owned(),
            version: VERSION,
            base: self.base.to_json(),
            transactions: self.entries.iter().map(|entry| entry.transaction.clone()).collect(),
            position: self.position,
            marks: self.marks.clone(),
            next_state: self.next_state,
        }
    }

    /// Does everything again that `log` says.
    ///
    /// # Errors
    ///
    /// When it is of another format or version, or something in it cannot be done.
    ///
    /// # Complexity
    ///
    /// That of all its edits.
    pub fn from_log(log: HistoryLog) -> Result<Self, HistoryError> {
        if log.format != FORMAT {
            return Err(VersionedError::Format { found: log.format, expected: FORMAT }.into());
        }
        if log.version != VERSION {
            return Err(VersionedError::Version { found: log.version, expected: VERSION }.into());
        }
        let mut history = Self::new(Specification::from_json(&log.base)?);
        let transactions = log.transactions.len();
        let within = |place: &'static str, position: usize| {
            let error = HistoryError::Position { place, position, transactions };
            if position > transactions { Err(error) } else { Ok(()) }
        };
        within("position", log.position)?;
        log.marks.values().try_for_each(|&position| within("marks", position))?;
        for (index, transaction) in log.transactions.into_iter().enumerate() {
            let label = transaction.label.clone();
            let refused = |error| HistoryError::Transaction { index, label, error };
            history.commit(transaction).map_err(refused)?;
        }
        history.jump(log.position);
        history.marks = log.marks;
        history.next_state = history.next_state.max(log.next_state);
        Ok(history)
    }
}

impl HistoryLog {
    /// The log as text: JSON with a line feed at its end.
    pub fn to_json(&self) -> String {
        // It holds nothing that JSON cannot: an edit whose number is none was refused and is in no history.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }

    /// Reads a log from text.
    ///
    /// # Errors
    ///
    /// When it is no JSON of this shape, or of another format or version.
    pub fn from_json(text: &str) -> Result<Self, HistoryError> {
        Ok(read_versioned(text, FORMAT, VERSION)?)
    }
}
