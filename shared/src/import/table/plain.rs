//! Lines read the plain way: cell after cell straight from the bytes, with nothing set aside.
//!
//! Nothing is refused here. A line that is anything but one value for each column, without quotation marks, is left to
//! the [careful way](super::careful), together with the lines behind it.

use std::ops::Range;

use memchr::{memchr_iter, memchr2, memchr3};

use super::Frames;
use crate::import::ImportError;
use crate::import::cell::{self, CellError, Decimal};
use crate::import::column::Role;
use crate::import::decimal::{leading_decimal, long_decimal, short_decimal};
use crate::import::recording::Row;

/// From how much of a table the number of its lines is estimated.
const SAMPLE: usize = 1 << 16;

/// Reads the lines that are at `range` in the file; returns where the first begins that is not plain, or the range's end.
///
/// # Errors
///
/// When a plain line does not follow the line before it.
pub(super) fn read(frames: &mut Frames<'_>, range: Range<usize>) -> Result<usize, ImportError> {
    expect_rows(frames, range.clone());
    let bytes = &frames.table.text.as_bytes()[..range.end];
    let mut place = range.start + line_ends(&bytes[range.start..]);
    let line = Line::of(frames, &bytes[place..]);
    loop {
        place += line_ends(&bytes[place..]);
        let row = frames.recorder.next_row();
        let Some(length) = line.fill(row, &bytes[place..]) else { return Ok(place) };
        frames.push_row(place)?;
        place += length;
    }
}

/// Makes room for the rows at `range`, as far as they are of one demonstration.
pub(super) fn expect_rows(frames: &mut Frames<'_>, range: Range<usize>) {
    let columns = &frames.names.columns;
    if columns.label.is_none() {
        let bytes = &frames.table.text.as_bytes()[range];
        // However short the lines are later on, each has a byte for each column.
        frames.recorder.expect_rows(estimated_lines(bytes).min(bytes.len() / columns.roles.len() + 1));
    }
}

/// What a plain line is like.
struct Line<'a> {
    roles: &'a [Role],
    separator: u8,
    decimal: Decimal,
    /// What mostly ends it.
    end: u8,
}

impl<'a> Line<'a> {
    /// What the plain lines of a table are like, of which the next are `bytes`.
    fn of(frames: &Frames<'a>, bytes: &[u8]) -> Self {
        let separator = frames.table.separator;
        Self {
            roles: &frames.names.columns.roles,
            separator: separator.byte(),
            decimal: separator.decimal(),
            end: memchr2(b'\n', b'\r', bytes).map_or(b'\n', |at| bytes[at]),
        }
    }

    /// Fills `row` with the line at the beginning of `bytes`; returns the line's length when it is plain.
    fn fill(&self, row: &mut Row, bytes: &[u8]) -> Option<usize> {
        let (&last, others) = self.roles.split_last()?;
        let mut at = 0;
        for &role in others {
            at += self.fill_cell(row, role, &bytes[at..], self.separator)? + 1;
        }
        Some(at + self.fill_cell(row, last, &bytes[at..], self.end)?)
    }

    /// Fills the place of `role` with the cell at the beginning of `bytes` that is ended by `end`; returns the cell's length.
    #[expect(clippy::inline_always, reason = "a call for each cell costs as much as reading it")]
    #[inline(always)]
    fn fill_cell(&self, row: &mut Row, role: Role, bytes: &[u8], end: u8) -> Option<usize> {
        match role {
            Role::Feature(feature) => {
                let (value, length) = self.number(bytes, end)?;
                row.values[feature] = value.ok()?;
                Some(length)
            }
            Role::Time(time) => {
                let (value, length) = self.number(bytes, end)?;
                row.times[time] = value.unwrap_or(f64::NAN);
                Some(length)
            }
            Role::Label => self.fill_label(&mut row.label, bytes, end),
            Role::Dropped => Some(self.cell(bytes, end)?.1),
        }
    }

    /// The number in the cell at the beginning of `bytes`, and the cell's length.
    #[expect(clippy::inline_always, reason = "a call for each cell costs as much as reading it")]
    #[inline(always)]
    fn number(&self, bytes: &[u8], end: u8) -> Option<(Result<f64, CellError>, usize)> {
        match short_decimal(bytes) {
            Some(decimal) if decimal.next == Some(end) => Some((Ok(decimal.value), decimal.length)),
            _ => self.long_number(bytes, end),
        }
    }

    #[inline(never)]
    fn long_number(&self, bytes: &[u8], end: u8) -> Option<(Result<f64, CellError>, usize)> {
        match long_decimal(bytes) {
            Some(decimal) if decimal.next == Some(end) => Some((Ok(decimal.value), decimal.length)),
            _ => self.any_number(bytes, end),
        }
    }

    fn any_number(&self, bytes: &[u8], end: u8) -> Option<(Result<f64, CellError>, usize)> {
        let start = blanks(bytes);
        if let Some(decimal) = leading_decimal(&bytes[start..])
            && let Some(length) = self.end(bytes, start + decimal.length, end)
        {
            return Some((Ok(decimal.value), length));
        }
        let (cell, length) = self.cell(bytes, end)?;
        Some((cell::number(cell, self.decimal), length))
    }

    /// Makes `label` that of the cell at the beginning of `bytes`, which it mostly is already; returns the cell's length.
    fn fill_label(&self, label: &mut String, bytes: &[u8], end: u8) -> Option<usize> {
        let is_same = bytes.starts_with(label.as_bytes()) && bytes.get(label.len()) == Some(&end);
        if is_same && !label.is_empty() {
            return Some(label.len());
        }
        let (cell, length) = self.cell(bytes, end)?;
        label.clear();
        label.push_str(str::from_utf8(cell).ok()?);
        Some(length)
    }

    /// The trimmed cell at the beginning of `bytes` and its length, unless quotation marks begin it or it may belong to a
    /// blank line.
    fn cell<'b>(&self, bytes: &'b [u8], end: u8) -> Option<(&'b [u8], usize)> {
        let start = blanks(bytes);
        let behind = &bytes[start..];
        let length = memchr3(self.separator, b'\n', b'\r', behind).unwrap_or(behind.len());
        let cell = behind[..length].trim_ascii();
        let may_be_blank = self.separator == b' ' || self.roles.len() == 1;
        let is_plain = bytes.get(start) != Some(&b'"') && !(may_be_blank && cell.is_empty());
        let length = self.end(bytes, start + length, end)?;
        is_plain.then_some((cell, length))
    }

    /// Where the cell at the beginning of `bytes` ends that has its text before `at`, when it is ended as it must be.
    fn end(&self, bytes: &[u8], mut at: usize, end: u8) -> Option<usize> {
        let ends_line = end == self.end;
        if ends_line && self.separator == b' ' {
            at += blanks(&bytes[at..]);
        }
        let is_ended = match bytes.get(at) {
            Some(&byte) => byte == end || (ends_line && is_line_end(byte)),
            None => ends_line,
        };
        is_ended.then_some(at)
    }
}

/// How many line ends `bytes` begins with.
fn line_ends(bytes: &[u8]) -> usize {
    bytes.iter().take_while(|&&byte| is_line_end(byte)).count()
}

fn is_line_end(byte: u8) -> bool {
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
