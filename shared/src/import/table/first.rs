//! The first line of a table, which names the columns or is a frame.

use csv::ByteRecord;
use memchr::{memchr, memchr2};

use super::careful::Records;
use super::layout::Layout;
use crate::import::ImportError;

/// The first line of a table that is not blank.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct First {
    pub(super) record: ByteRecord,
    /// The byte of the file at which it begins, or line ends before it.
    pub(super) place: usize,
    /// The byte of the file behind its text, at its line end or behind that.
    pub(super) end: usize,
}

/// The first line, if there is one.
pub(super) fn first(table: &Layout<'_>) -> Result<Option<First>, ImportError> {
    match plain_first(table) {
        Some(first) => Ok(Some(first)),
        None => careful_first(table),
    }
}

/// Without quotation marks, making ready to understand them is spared: in a small file that takes longer than reading.
pub(super) fn plain_first(table: &Layout<'_>) -> Option<First> {
    let body = table.body.as_bytes();
    let line = &body[..memchr2(b'\n', b'\r', body).unwrap_or(body.len())];
    let is_plain = memchr(b'"', line).is_none() && !line.trim_ascii().is_empty();
    let place = table.start();
    is_plain.then(|| First {
        record: line.split(|&byte| byte == table.separator.byte()).collect(),
        place,
        end: place + line.len(),
    })
}

pub(super) fn careful_first(table: &Layout<'_>) -> Result<Option<First>, ImportError> {
    let mut records = Records::new(table, table.start());
    let is_there = records.advance()?;
    let (place, end) = (records.place(), records.end());
    Ok(is_there.then(|| First { record: records.into_record(), place, end }))
}
