//! What is in a file. No browser here.

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import, import_digested};

use super::opening::{is_specification, opened};

/// What a file holds.
pub(super) enum Content {
    /// At least one demonstration.
    Demonstrations(Vec<Demonstration>),
    /// The text of a specification.
    Specification(Result<String, String>),
}

/// What is in the file called `name`; `sha256` is its digest where that is known.
///
/// # Errors
///
/// When it is no specification and no demonstrations can be read from it.
pub(super) fn read(name: &str, bytes: &[u8], sha256: Option<&str>) -> Result<Content, String> {
    if is_specification(name, bytes) {
        return Ok(Content::Specification(opened(name, bytes)));
    }
    let demonstrations = match sha256 {
        Some(sha256) => import_digested(name, sha256, bytes, Header::Detect),
        None => import(name, bytes, Header::Detect),
    };
    let demonstrations = demonstrations.map_err(|error| error.to_string())?;
    if demonstrations.is_empty() {
        return Err("there are no demonstrations in it".to_owned());
    }
    Ok(Content::Demonstrations(demonstrations))
}
