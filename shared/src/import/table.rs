//! Tables as text: CSV and its kin, separated by commas, semicolons, tabs or blanks.
//!
//! Lines are read the plain way, straight from the bytes, up to the first that asks for more than that: quotation marks,
//! or words about what is wrong with it. From there on they are read the careful way, which decides what is accepted.

mod careful;
mod first;
mod layout;
mod names;
mod pieces;
mod plain;
#[cfg(test)]
mod tests;

use self::first::first;
use self::layout::Layout;
use self::names::{Names, Origin};
use super::recording::{Recorder, Recordings};
use super::{Header, ImportError};

/// The frames of a table, as they are read.
#[derive(Debug)]
struct Frames<'a> {
    table: &'a Layout<'a>,
    names: &'a Names,
    recorder: Recorder<'a>,
}

/// Reads a table in one pass; only the current line is held beside the values.
pub(super) fn read(text: &str, header: Header) -> Result<Recordings, ImportError> {
    read_with(pieces::read, text, header)
}

/// Reads a table, its lines with `plain` up to the byte of the file that it returns.
fn read_with(
    plain: impl FnOnce(&mut Frames<'_>, usize) -> Result<usize, ImportError>,
    text: &str,
    header: Header,
) -> Result<Recordings, ImportError> {
    let table = Layout::detect(text);
    let Some(first) = first(&table)? else {
        return Err(ImportError::whole("there are only comments; expected lines of values"));
    };
    let names = Names::find(&table, &first.record, header)
        .map_err(|message| ImportError::at(table.line_at(first.place), message))?;
    let start = if names.origin == Origin::FirstLine { first.end } else { table.start() };
    let mut frames = Frames { table: &table, names: &names, recorder: Recorder::new(&names.columns) };
    let rest = plain(&mut frames, start)?;
    if rest < text.len() {
        careful::read(&mut frames, rest)?;
    }
    let parts = frames.recorder.finish();
    if parts.is_empty() {
        return Err(ImportError::whole("there are no frames, only the names of the columns"));
    }
    Ok(Recordings { features: names.columns.features.clone(), parts })
}

impl Frames<'_> {
    /// Adds the row of the line that begins at byte `place` of the file.
    fn push_row(&mut self, place: usize) -> Result<(), ImportError> {
        let pushed = self.recorder.push_row(place);
        pushed.map_err(|error| self.error(place, error.message(|place| self.line_name(place))))
    }

    /// Something is wrong with the line that begins at byte `place` of the file.
    fn error(&self, place: usize, message: impl Into<String>) -> ImportError {
        ImportError::at(self.table.line_at(place), message)
    }

    fn line_name(&self, place: usize) -> String {
        format!("line {}", self.table.line_at(place))
    }
}
