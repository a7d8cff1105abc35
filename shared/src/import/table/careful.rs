//! Lines read the careful way: quotation marks are understood, and what is wrong is told.

use csv::{ByteRecord, Reader, ReaderBuilder};

use super::Frames;
use super::layout::Layout;
use crate::demonstration::LARGEST_VALUE;
use crate::import::ImportError;
use crate::import::cell::{self, CellError};
use crate::import::column::Role;
use crate::import::recording::Row;
use crate::import::text::quoted;

/// The lines of a table that are not blank, one after the other.
pub(super) struct Records<'a> {
    table: &'a Layout<'a>,
    start: usize,
    reader: Reader<&'a [u8]>,
    record: ByteRecord,
}

/// Reads all lines from byte `start` of the file on.
///
/// # Errors
///
/// When a line does not have a value for each column, a value is no number, or it does not follow the line before it.
pub(super) fn read(frames: &mut Frames<'_>, start: usize) -> Result<(), ImportError> {
    let mut records = Records::new(frames.table, start);
    while records.advance()? {
        let place = records.place();
        fill(frames, records.record()).map_err(|message| frames.error(place, message))?;
        frames.push_row(place)?;
    }
    Ok(())
}

impl<'a> Records<'a> {
    /// The lines from byte `start` of the file on.
    pub(super) fn new(table: &'a Layout<'a>, start: usize) -> Self {
        let reader = ReaderBuilder::new()
            .delimiter(table.separator.byte())
            .has_headers(false)
            .flexible(true)
            .buffer_capacity(1 << 16)
            .from_reader(&table.text.as_bytes()[start..]);
        Self { table, start, reader, record: ByteRecord::new() }
    }

    /// Goes to the next line that is not blank; `false` at the end of the table.
    pub(super) fn advance(&mut self) -> Result<bool, ImportError> {
        loop {
            match self.reader.read_byte_record(&mut self.record) {
                Ok(true) if self.table.is_blank(&self.record) => {}
                Ok(more) => return Ok(more),
                Err(error) => return Err(ImportError::whole(error.to_string())),
            }
        }
    }

    /// The line, when no more are wanted.
    pub(super) fn into_record(self) -> ByteRecord {
        self.record
    }

    /// The line.
    fn record(&self) -> &ByteRecord {
        &self.record
    }

    /// The byte of the file at which the line begins, or line ends before it.
    pub(super) fn place(&self) -> usize {
        self.start + self.record.position().map_or(0, |position| position.byte() as usize)
    }

    /// The byte of the file behind the line.
    pub(super) fn end(&self) -> usize {
        self.start + self.reader.position().byte() as usize
    }
}

/// Fills the recorder's row with one line.
fn fill(frames: &mut Frames<'_>, record: &ByteRecord) -> Result<(), String> {
    let Frames { table, names, recorder } = frames;
    let columns = &names.columns;
    let count = table.cells(record).count();
    if count != columns.names.len() {
        return Err(names.ragged(count));
    }
    let row = recorder.blank_row();
    for (index, cell) in table.cells(record).enumerate() {
        fill_cell(row, columns.roles[index], cell, table)
            .map_err(|error| format!("{}: {}", columns.names[index], cell_message(cell, error)))?;
    }
    Ok(())
}

fn fill_cell(row: &mut Row, role: Role, cell: &[u8], table: &Layout<'_>) -> Result<(), CellError> {
    let decimal = table.separator.decimal();
    match role {
        Role::Feature(feature) => row.values[feature] = cell::number(cell, decimal)?,
        Role::Time(time) => row.times[time] = cell::number(cell, decimal).unwrap_or(f64::NAN),
        Role::Label => row.label.push_str(&String::from_utf8_lossy(cell)),
        Role::Dropped => {}
    }
    Ok(())
}

fn cell_message(cell: &[u8], error: CellError) -> String {
    let text = quoted(&String::from_utf8_lossy(cell));
    match error {
        CellError::Infinite => format!("{text} is not finite; expected a finite number"),
        CellError::TooLarge => format!("{text} is beyond {LARGEST_VALUE:e}; expected a smaller number"),
        CellError::Text if cell.contains(&b'\n') => {
            format!("{text} runs over several lines; a quotation mark may be missing")
        }
        CellError::Text => format!("{text} is no number; expected a number, or nothing where undefined"),
    }
}
