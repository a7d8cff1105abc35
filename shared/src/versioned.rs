//! JSON that says of itself what it is: a `format` and a `version` before everything else.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

/// Why a text is not what it should be.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum VersionedError {
    /// The text is no JSON, or not of this shape.
    #[error("line {line}, column {column}: {message}")]
    Json {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What was found and expected.
        message: String,
    },
    /// It is something else.
    #[error("format: {found:?} instead of {expected:?}")]
    Format {
        /// What it says it is.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
    /// It is of a version that this program does not know.
    #[error("version: {found}, but this program reads version {expected}")]
    Version {
        /// The version that it says.
        found: u32,
        /// The version that is known.
        expected: u32,
    },
}

/// What a text says of itself.
#[derive(Deserialize)]
struct Kind {
    format: String,
    version: u32,
}

/// Reads `text`, which must be of this format and version.
///
/// # Errors
///
/// Another format or version is named as what it is, whatever its shape; otherwise the place where the JSON or its shape
/// is wrong.
///
/// # Complexity
///
/// Linear in the text.
pub fn read_versioned<T: DeserializeOwned>(
    text: &str,
    format: &'static str,
    version: u32,
) -> Result<T, VersionedError> {
    match serde_json::from_str::<Kind>(text) {
        Ok(kind) if kind.format != format => {
            Err(VersionedError::Format { found: kind.format, expected: format })
        }
        Ok(kind) if kind.version != version => {
            Err(VersionedError::Version { found: kind.version, expected: version })
        }
        _ => serde_json::from_str(text).map_err(|error| json_error(&error)),
    }
}

fn json_error(error: &serde_json::Error) -> VersionedError {
    let text = error.to_string();
    let message = text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message);
    VersionedError::Json { line: error.line(), column: error.column(), message: message.to_owned() }
}
