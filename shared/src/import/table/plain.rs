//! Lines read the plain way: cell after cell straight from the bytes, with nothing set aside.
//!
//! Nothing is refused here. A line that is anything but one value for each column, without quotation marks, is left to
//! the [careful way](super::careful), together with the lines behind it.

use memchr::{memchr_iter, memchr3};

use super::Frames;
use super::layout::Separator;
use crate::import::ImportError;
use crate::import::cell::{self, CellError};
use crate::import::column::Role;
use crate::import::recording::Row;

/// From how much of a table the number of its lines is estimated.
const SAMPLE: usize = 1 << 16;

/// Reads lines from byte `start` of the file on; returns where the first begins that is not plain, or the file's end.
///
/// # Errors
///
/// When a plain line does not follow the line before it.
pub(super) fn read(frames: &mut Frames<'_>, start: usize) -> Result<usize, ImportError> {
    let bytes = frames.table.text.as_bytes();
    let columns = &frames.names.columns;
    let line = Line { separator: frames.table.separator, roles: &columns.roles };
    if columns.label.is_none() {
        let rest = &bytes[start..];
        // However short the lines are later on, each has a byte for each column.
        frames.recorder.expect_rows(estimated_lines(rest).min(rest.len() / columns.roles.len() + 1));
    }
    let mut place = start;
    loop {
        place += bytes[place..].iter().take_while(|&&byte| ends_line(byte)).count();
        let row = frames.recorder.blank_row();
        let Some(length) = line.fill(row, &bytes[place..]) else { return Ok(place) };
        frames.push_row(place)?;
        place += length;
    }
}

/// What a plain line is like.
struct Line<'a> {
    separator: Separator,
    roles: &'a [Role],
}

impl Line<'_> {
    /// Fills `row` with the line at the beginning of `bytes`; returns the line's length when it is plain.
    fn fill(&self, row: &mut Row, bytes: &[u8]) -> Option<usize> {
        let mut at = 0;
        for (index, &role) in self.roles.iter().enumerate() {
            if index > 0 {
                bytes.get(at).filter(|&&byte| byte == self.separator.byte())?;
                at += 1;
            }
            at += blanks(&bytes[at..]);
            at += self.fill_cell(row, role, &bytes[at..])?;
        }
        if self.separator == Separator::Blank {
            at += blanks(&bytes[at..]);
        }
        bytes.get(at).is_none_or(|&byte| ends_line(byte)).then_some(at)
    }

    /// Fills the place of `role` with the cell at the beginning of `bytes`; returns the cell's length.
    fn fill_cell(&self, row: &mut Row, role: Role, bytes: &[u8]) -> Option<usize> {
        match role {
            Role::Feature(feature) => {
                let (value, length) = self.number(bytes)?;
                row.values[feature] = value.ok()?;
                Some(length)
            }
            Role::Time(time) => {
                let (value, length) = self.number(bytes)?;
                row.times[time] = value.unwrap_or(f64::NAN);
                Some(length)
            }
            Role::Label => {
                let cell = self.cell(bytes)?;
                row.label.push_str(str::from_utf8(cell.trim_ascii()).ok()?);
                Some(cell.len())
            }
            Role::Dropped => Some(self.cell(bytes)?.len()),
        }
    }

    /// The number in the cell at the beginning of `bytes`, and the cell's length.
    #[inline]
    fn number(&self, bytes: &[u8]) -> Option<(Result<f64, CellError>, usize)> {
        if let Some((value, length)) = cell::leading_number(bytes)
            && bytes.get(length).is_none_or(|&byte| self.ends_cell(byte))
        {
            return Some((Ok(value), length));
        }
        let cell = self.cell(bytes)?;
        Some((cell::number(cell.trim_ascii(), self.separator.decimal()), cell.len()))
    }

    /// The cell at the beginning of `bytes`, unless quotation marks begin it or it may belong to a blank line.
    fn cell<'b>(&self, bytes: &'b [u8]) -> Option<&'b [u8]> {
        let end = memchr3(self.separator.byte(), b'\n', b'\r', bytes).unwrap_or(bytes.len());
        let cell = &bytes[..end];
        let may_be_blank = self.separator == Separator::Blank || self.roles.len() == 1;
        let is_plain = cell.first() != Some(&b'"') && !(may_be_blank && cell.trim_ascii().is_empty());
        is_plain.then_some(cell)
    }

    fn ends_cell(&self, byte: u8) -> bool {
        byte == self.separator.byte() || ends_line(byte)
    }
}

fn ends_line(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

fn blanks(bytes: &[u8]) -> usize {
    bytes.iter().take_while(|&&byte| byte == b' ').count()
}

/// About how many lines there are in `bytes`, by how many there are at their beginning.
fn estimated_lines(bytes: &[u8]) -> usize {
    let sample = &bytes[..bytes.len().min(SAMPLE)];
    let ends = memchr_iter(b'\n', sample).count().max(memchr_iter(b'\r', sample).count());
    let lines = (ends + 1) as f64 * bytes.len() as f64 / sample.len().max(1) as f64;
    lines as usize + 1
}
