//! Large tables read in pieces, by as many threads as the caller has.
//!
//! Each piece is read the plain way as if it were a table of its own, and put behind the pieces before it. From the first
//! on that is not plain to its end, or does not follow, lines are read one after the other as ever, so that what is read
//! and what is refused does not depend on pieces.

use std::ops::Range;

use memchr::memchr2;

use super::{Frames, plain};
use crate::import::ImportError;
use crate::import::recording::Recorder;
use crate::parallel;

/// How a table is split.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    /// About how many bytes a piece has.
    pub(super) bytes: usize,
    /// How many pieces are read before they are put together, which bounds the memory that they take beside the table.
    pub(super) at_once: usize,
}

/// Pieces that take much longer than what it costs to hand them over.
const USUAL: Split = Split { bytes: 1 << 20, at_once: if parallel::AT_ONCE > 1 { 16 } else { 1 } };

/// Reads lines from byte `start` of the file on; returns where the first begins that is not plain, or the file's end.
///
/// # Errors
///
/// When a plain line does not follow the line before it.
pub(super) fn read(frames: &mut Frames<'_>, start: usize) -> Result<usize, ImportError> {
    read_split(frames, start, USUAL)
}

/// As [`read`], split as told.
pub(super) fn read_split(frames: &mut Frames<'_>, start: usize, split: Split) -> Result<usize, ImportError> {
    let text = frames.table.text;
    let mut at = start;
    loop {
        let pieces = pieces(text.as_bytes(), at, split);
        if pieces.len() < 2 {
            return plain::read(frames, at..text.len());
        }
        plain::expect_rows(frames, at..text.len());
        let recorders = parallel::map(pieces.len(), |index| recorder(frames, pieces[index].clone()));
        for (piece, recorder) in pieces.into_iter().zip(recorders) {
            if !recorder.is_some_and(|recorder| frames.recorder.join(recorder)) {
                return plain::read(frames, piece.start..text.len());
            }
            at = piece.end;
        }
    }
}

/// The next pieces from `start` on: all but the file's last end behind a line's end.
fn pieces(bytes: &[u8], start: usize, split: Split) -> Vec<Range<usize>> {
    let mut pieces = Vec::new();
    let mut start = start;
    while start < bytes.len() && pieces.len() < split.at_once {
        let least = bytes.len().min(start + split.bytes);
        let end = memchr2(b'\n', b'\r', &bytes[least..]).map_or(bytes.len(), |length| least + length + 1);
        pieces.push(start..end);
        start = end;
    }
    pieces
}

/// The rows of a piece that is plain to its end.
fn recorder<'a>(frames: &Frames<'a>, piece: Range<usize>) -> Option<Recorder<'a>> {
    let Frames { table, names, .. } = *frames;
    let mut part = Frames { table, names, recorder: Recorder::new(&names.columns) };
    let end = piece.end;
    (plain::read(&mut part, piece).ok()? == end).then_some(part.recorder)
}
