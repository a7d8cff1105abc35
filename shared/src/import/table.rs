//! Tables as text: CSV and its kin, separated by commas, semicolons, tabs or blanks.

mod layout;
mod names;

use csv::{ByteRecord, Reader, ReaderBuilder};

use self::layout::Layout;
use self::names::{Names, Origin};
use super::cell::{self, CellError};
use super::column::Role;
use super::recording::{Recorder, Recordings, Row};
use super::text::quoted;
use super::{Header, ImportError};

/// Reads a table in one pass; only the current line is held beside the values.
pub(super) fn read(text: &str, header: Header) -> Result<Recordings, ImportError> {
    let table = Layout::detect(text);
    let mut reader = reader(&table);
    let mut record = ByteRecord::new();
    if !next_record(&mut reader, &mut record, &table)? {
        return Err(ImportError::whole("there are only comments; expected lines of values"));
    }
    let names = Names::find(&table, &record, header)
        .map_err(|message| ImportError::at(table.line_at(table.place_of(&record)), message))?;
    let mut recorder = Recorder::new(&names.columns);
    let mut is_frame = names.origin != Origin::FirstLine;
    while is_frame || next_record(&mut reader, &mut record, &table)? {
        push(&mut recorder, &record, &table, &names)
            .map_err(|message| ImportError::at(table.line_at(table.place_of(&record)), message))?;
        is_frame = false;
    }
    let parts = recorder.finish();
    if parts.is_empty() {
        return Err(ImportError::whole("there are no frames, only the names of the columns"));
    }
    Ok(Recordings { features: names.columns.features.clone(), parts })
}

fn reader<'a>(table: &Layout<'a>) -> Reader<&'a [u8]> {
    ReaderBuilder::new()
        .delimiter(table.separator.byte())
        .has_headers(false)
        .flexible(true)
        .buffer_capacity(1 << 16)
        .from_reader(table.body.as_bytes())
}

/// Reads the next line that is not blank; `false` at the end of the table.
fn next_record(
    reader: &mut Reader<&[u8]>,
    record: &mut ByteRecord,
    table: &Layout<'_>,
) -> Result<bool, ImportError> {
    loop {
        match reader.read_byte_record(record) {
            Ok(true) if table.is_blank(record) => {}
            Ok(more) => return Ok(more),
            Err(error) => return Err(ImportError::whole(error.to_string())),
        }
    }
}

/// Adds one line to the recorder.
fn push(
    recorder: &mut Recorder<'_>,
    record: &ByteRecord,
    table: &Layout<'_>,
    names: &Names,
) -> Result<(), String> {
    let columns = &names.columns;
    let count = table.cells(record).count();
    if count != columns.names.len() {
        return Err(names.ragged(count));
    }
    let row = recorder.blank_row();
    for (index, cell) in table.cells(record).enumerate() {
        fill(row, columns.roles[index], cell, table)
            .map_err(|error| format!("{}: {}", columns.names[index], cell_message(cell, error)))?;
    }
    let line = |place| format!("line {}", table.line_at(place));
    recorder.push_row(table.place_of(record)).map_err(|error| error.message(line))
}

fn fill(row: &mut Row, role: Role, cell: &[u8], table: &Layout<'_>) -> Result<(), CellError> {
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
        CellError::Text if cell.contains(&b'\n') => {
            format!("{text} runs over several lines; a quotation mark may be missing")
        }
        CellError::Text => format!("{text} is no number; expected a number, or nothing where undefined"),
    }
}
