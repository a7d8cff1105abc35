//! Where the names of a table's columns come from.

use csv::{ByteRecord, ReaderBuilder};

use super::layout::{Layout, Separator};
use crate::import::Header;
use crate::import::cell::{self, CellError};
use crate::import::column::{Columns, check_count, heading};
use crate::import::text::counted;

/// Where the names were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// In the first line.
    FirstLine,
    /// In a comment directly before the first line.
    Comment,
    /// Nowhere: the columns are numbered.
    Nowhere,
}

/// The columns of a table and where their names were found.
#[derive(Debug)]
pub(super) struct Names {
    pub(super) columns: Columns,
    pub(super) origin: Origin,
}

impl Names {
    /// The names of the columns of a table whose first line is `first`.
    ///
    /// # Errors
    ///
    /// When the names do not do as names of columns.
    pub(super) fn find(table: &Layout<'_>, first: &ByteRecord, header: Header) -> Result<Self, String> {
        let count = table.cells(first).count();
        check_count(count)?;
        let (headings, origin) = match (header, is_frame(table, first)) {
            (Header::Absent, _) => (None, Origin::Nowhere),
            (Header::Detect, false) => (Some(texts(table, first)), Origin::FirstLine),
            (Header::Detect, true) => match comment_names(table, count) {
                Some(names) => (Some(names), Origin::Comment),
                None => (None, Origin::Nowhere),
            },
        };
        let columns = match headings {
            Some(texts) => Columns::new(texts.iter().map(|text| heading(text)).collect())?,
            None => Columns::numbered(count),
        };
        Ok(Self { columns, origin })
    }

    /// What to say about a line with `count` values, which are too few or too many.
    pub(super) fn ragged(&self, count: usize) -> String {
        let expected = self.columns.names.len();
        let values = counted(count, "value");
        match self.origin {
            Origin::Nowhere => format!("{values}, but the first line has {expected}"),
            Origin::FirstLine | Origin::Comment => {
                format!("{values}, but the header names {}", counted(expected, self.columns.noun()))
            }
        }
    }
}

/// Whether every cell is a number or says that there is none, and not all say so.
///
/// An empty cell before 0, 1, 2.. is no frame but the header of a table whose columns were never named.
fn is_frame(table: &Layout<'_>, line: &ByteRecord) -> bool {
    let mut numbers = 0;
    let mut counts_from_zero = line.len() > 2;
    for (index, cell) in table.cells(line).enumerate() {
        match cell::number(cell, table.separator.decimal()) {
            Ok(value) if value.is_nan() => counts_from_zero &= index == 0 && cell.is_empty(),
            Ok(value) => {
                numbers += 1;
                counts_from_zero &= index > 0 && value.to_bits() == (index as f64 - 1.0).to_bits();
            }
            Err(CellError::Infinite | CellError::TooLarge) => numbers += 1,
            Err(CellError::Text) => return false,
        }
    }
    numbers > 0 && !counts_from_zero
}

/// The names in a comment, as in `#t [ns],x [m],y [m]`, where it has one for each of `count` columns.
///
/// Not where blanks separate: a remark in prose would be taken for names.
fn comment_names(table: &Layout<'_>, count: usize) -> Option<Vec<String>> {
    let comment = table.comment.filter(|_| count > 1 && table.separator != Separator::Blank)?;
    let mut reader = ReaderBuilder::new()
        .delimiter(table.separator.byte())
        .has_headers(false)
        .from_reader(comment.as_bytes());
    let line = reader.byte_records().next()?.ok()?;
    let names = texts(table, &line);
    (names.len() == count && !is_frame(table, &line)).then_some(names)
}

fn texts(table: &Layout<'_>, line: &ByteRecord) -> Vec<String> {
    table.cells(line).map(|cell| String::from_utf8_lossy(cell).into_owned()).collect()
}
