//! From the bytes of a file to demonstrations.
//!
//! ```text
//! bytes -text-> text -table or json-> rows of columns -recording-> demonstrations
//! ```

mod cell;
mod column;
mod decimal;
pub mod dot;
mod json;
mod recording;
mod table;
mod text;
mod words;

use sha2::{Digest, Sha256};
use thiserror::Error;

use self::recording::Recordings;
pub use self::words::{Words, import_words};
use crate::demonstration::Demonstration;
use crate::parallel;

/// Whether the first line of a table names the columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Header {
    /// It does, unless every cell of it is a number.
    #[default]
    Detect,
    /// It does not: columns are called `f1`, `f2` and so on.
    Absent,
}

/// Why a file holds no demonstrations. Its text is one sentence with the line, where there is one.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}{message}", line.map(|line| format!("line {line}: ")).unwrap_or_default())]
pub struct ImportError {
    /// The line, from 1, where the file has lines.
    pub line: Option<usize>,
    /// What was found and what was expected.
    pub message: String,
}

impl ImportError {
    /// Something is wrong at `line`, from 1.
    fn at(line: usize, message: impl Into<String>) -> Self {
        Self { line: Some(line), message: message.into() }
    }

    /// Something is wrong with the file as a whole.
    fn whole(message: impl Into<String>) -> Self {
        Self { line: None, message: message.into() }
    }
}

/// Reads the demonstrations in a file called `name`: a table (CSV and its kin) or JSON, told apart by its content.
///
/// A demonstration is called `name` when the file holds one, and `name #3` or `name #Anna` when the file numbers or
/// names it. Its digest is that of the whole file. Columns of time and of counting are left out of its features.
/// What exactly is accepted is in `docs/demonstration-files.md`. `header` says nothing about JSON.
///
/// ```
/// use goalgraph::import::{Header, import};
///
/// let demonstrations = import("take.csv", b"demo,red.x [m],red.y [m]\n0,0.1,\n0,0.2,0.3\n", Header::Detect)?;
/// assert_eq!(demonstrations[0].name(), "take.csv");
/// assert_eq!(demonstrations[0].frame(1), [0.2, 0.3]);
///
/// let error = import("take.csv", b"red.x,red.y\n0.1,0.2\n0.1\n", Header::Detect).unwrap_err();
/// assert_eq!(error.to_string(), "line 3: 1 value, but the header names 2 features");
/// # Ok::<(), goalgraph::import::ImportError>(())
/// ```
///
/// # Errors
///
/// When the file is empty, of no known format, or breaks its format; nothing of it is read then.
///
/// # Complexity
///
/// Linear in the number of bytes. The values are held once more, at 8 bytes each. With the feature `parallel` the digest
/// is computed beside the reading.
pub fn import(name: &str, bytes: &[u8], header: Header) -> Result<Vec<Demonstration>, ImportError> {
    let (recordings, sha256) = parallel::both(|| read(name, bytes, header), || sha256(bytes));
    recordings?.into_demonstrations(name, &sha256)
}

/// As [`import`], for a caller who knows the hexadecimal SHA-256 of `bytes` already.
///
/// # Errors
///
/// As [`import`].
pub fn import_digested(
    name: &str,
    sha256: &str,
    bytes: &[u8],
    header: Header,
) -> Result<Vec<Demonstration>, ImportError> {
    read(name, bytes, header)?.into_demonstrations(name, sha256)
}

fn read(name: &str, bytes: &[u8], header: Header) -> Result<Recordings, ImportError> {
    let text = text::text(bytes, "CSV or JSON")?;
    if json::is_json(name, text) { json::read(text) } else { table::read(text, header) }
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).into_iter().flat_map(hexadecimal).collect()
}

fn hexadecimal(byte: u8) -> [char; 2] {
    [byte >> 4, byte & 15].map(|digit| char::from_digit(digit.into(), 16).unwrap_or_default())
}
