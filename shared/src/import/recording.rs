//! From rows to demonstrations: rows of one label belong together, and time does not run backwards.

mod join;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use super::ImportError;
use super::column::Columns;
use super::text::quoted;
use crate::demonstration::{Demonstration, Feature};

/// More than this in one file is taken for a mistake: another column was meant.
pub(super) const MAX_DEMONSTRATIONS: usize = 100_000;

/// One row, to be filled cell by cell.
#[derive(Debug)]
pub(super) struct Row {
    /// One value per feature; NaN is undefined.
    pub(super) values: Vec<f64>,
    /// One value per time; NaN is unknown.
    pub(super) times: Vec<f64>,
    /// Which demonstration it belongs to.
    pub(super) label: String,
}

/// Why a row does not follow the rows before it. Places are those given with the rows.
#[derive(Debug)]
pub(super) enum RowError {
    /// It does not say which demonstration it belongs to.
    NoLabel { column: String },
    /// It belongs to a demonstration that had ended at `place`.
    Returned { column: String, label: String, place: usize },
    /// It is earlier than the row before it.
    Backwards { column: String, before: f64, after: f64 },
    /// It begins one demonstration too many.
    TooMany { column: String },
}

/// The rows of a file, collected into demonstrations.
#[derive(Debug)]
pub(super) struct Recorder<'a> {
    columns: &'a Columns,
    row: Row,
    /// The times of the first row.
    first: Vec<f64>,
    /// The last known times of the last demonstration.
    before: Vec<f64>,
    /// Where the last row stands.
    place: usize,
    /// How many values the next demonstration is expected to have.
    expected: usize,
    ended: BTreeMap<String, usize>,
    parts: Vec<Part>,
}

/// The frames of one demonstration and what the file calls it.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) label: Option<String>,
    pub(super) values: Vec<f64>,
}

/// What a file holds.
#[derive(Debug)]
pub(super) struct Recordings {
    pub(super) features: Arc<[Feature]>,
    pub(super) parts: Vec<Part>,
}

impl<'a> Recorder<'a> {
    /// No rows yet of a file with these columns.
    pub(super) fn new(columns: &'a Columns) -> Self {
        let row = Row {
            values: vec![f64::NAN; columns.features.len()],
            times: vec![f64::NAN; columns.times.len()],
            label: String::new(),
        };
        let unknown = row.times.clone();
        Self {
            columns,
            row,
            first: unknown.clone(),
            before: unknown,
            place: 0,
            expected: 0,
            ended: BTreeMap::new(),
            parts: Vec::new(),
        }
    }

    /// Makes room for one demonstration of about `rows` rows, as far as there is any.
    pub(super) fn expect_rows(&mut self, rows: usize) {
        self.expected = rows.saturating_mul(self.columns.features.len());
    }

    /// The next row, still as the one before, for whoever fills all of it.
    pub(super) fn next_row(&mut self) -> &mut Row {
        &mut self.row
    }

    /// The next row, with everything undefined.
    pub(super) fn blank_row(&mut self) -> &mut Row {
        self.row.values.fill(f64::NAN);
        self.row.times.fill(f64::NAN);
        self.row.label.clear();
        &mut self.row
    }

    /// Adds the row as it was filled; `place` is where it stands in the file.
    pub(super) fn push_row(&mut self, place: usize) -> Result<(), RowError> {
        self.open_part()?;
        for (column, (before, &after)) in self.before.iter_mut().zip(&self.row.times).enumerate() {
            if after < *before {
                let column = self.columns.times[column].clone();
                return Err(RowError::Backwards { column, before: *before, after });
            }
            *before = if after.is_nan() { *before } else { after };
        }
        if let Some(part) = self.parts.last_mut() {
            part.values.extend_from_slice(&self.row.values);
        }
        self.place = place;
        Ok(())
    }

    /// The demonstrations; a label is left out when there is one demonstration only.
    pub(super) fn finish(mut self) -> Vec<Part> {
        self.close_part();
        if let [part] = &mut self.parts[..] {
            part.label = None;
        }
        self.parts
    }

    /// Begins a new demonstration when the row's label says so.
    fn open_part(&mut self) -> Result<(), RowError> {
        let Some(column) = &self.columns.label else {
            if self.parts.is_empty() {
                self.push_part(None);
            }
            return Ok(());
        };
        let last = self.parts.last().and_then(|part| part.label.as_deref());
        if last == Some(self.row.label.as_str()) {
            return Ok(());
        }
        let column = column.clone();
        if self.row.label.is_empty() {
            return Err(RowError::NoLabel { column });
        }
        if self.parts.len() == MAX_DEMONSTRATIONS {
            return Err(RowError::TooMany { column });
        }
        self.end_part();
        let label = self.row.label.clone();
        if let Entry::Occupied(ended) = self.ended.entry(label.clone()) {
            return Err(RowError::Returned { column, label, place: *ended.get() });
        }
        self.before.fill(f64::NAN);
        self.close_part();
        self.push_part(Some(label));
        Ok(())
    }

    /// Notes where the last demonstration ended.
    fn end_part(&mut self) {
        if let Some(label) = self.parts.last().and_then(|part| part.label.as_ref()) {
            self.ended.insert(label.clone(), self.place);
        }
    }

    fn push_part(&mut self, label: Option<String>) {
        if self.parts.is_empty() {
            self.first.clone_from(&self.row.times);
        }
        let mut values = Vec::new();
        // Where there is no such room, there may be enough for what really comes.
        values.try_reserve_exact(self.expected).unwrap_or_default();
        self.parts.push(Part { label, values });
    }

    /// Gives back what the last demonstration does not need; the next may well be as long.
    fn close_part(&mut self) {
        if let Some(part) = self.parts.last_mut() {
            part.values.shrink_to_fit();
            self.expected = part.values.len();
        }
    }
}

impl Part {
    /// The same demonstration when the file calls what it is in `name`.
    pub(super) fn labelled(self, name: Option<&str>) -> Self {
        let label = match (name, self.label) {
            (Some(name), Some(label)) => Some(format!("{name} #{label}")),
            (Some(name), None) => Some(name.to_owned()),
            (None, label) => label,
        };
        Self { label, ..self }
    }
}

impl RowError {
    /// The sentence for it, with places told by `place_name`.
    pub(super) fn message(&self, place_name: impl Fn(usize) -> String) -> String {
        match self {
            Self::NoLabel { column } => {
                format!("{column} is empty; expected the demonstration that the frame belongs to")
            }
            Self::Returned { column, label, place } => format!(
                "{column} {} is back after it ended at {}; frames of one demonstration must follow one another",
                quoted(label),
                place_name(*place)
            ),
            Self::Backwards { column, before, after } => format!(
                "{column} runs backwards from {before} to {after}; frames must be in the order of time \
                 (several demonstrations in one file need a column demo)"
            ),
            Self::TooMany { column } => {
                format!("{column} has more than {MAX_DEMONSTRATIONS} different values")
            }
        }
    }
}

impl Recordings {
    /// The demonstrations of the file called `file`, whose digest is `sha256`.
    pub(super) fn into_demonstrations(
        self,
        file: &str,
        sha256: &str,
    ) -> Result<Vec<Demonstration>, ImportError> {
        if self.parts.is_empty() {
            return Err(ImportError::whole("there are no frames"));
        }
        let demonstration = |part: Part| {
            let name = part.label.map_or_else(|| file.to_owned(), |label| format!("{file} #{label}"));
            Demonstration::new(name, sha256, Arc::clone(&self.features), part.values)
                .map_err(|error| ImportError::whole(error.to_string()))
        };
        self.parts.into_iter().map(demonstration).collect()
    }
}
