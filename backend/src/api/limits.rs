//! How much the API takes.

use super::problem::{ApiError, ApiResult};

/// Largest JSON body, in bytes. A specification of 4,096 states has about 4 MB.
pub(crate) const JSON_BYTES: usize = 32 << 20;

/// Largest demonstration file, in bytes.
pub(crate) const DEMONSTRATION_BYTES: u64 = 4 << 30;

/// Longest name, in characters.
pub(crate) const NAME: usize = 200;

/// Longest message or comment, in characters.
pub(crate) const MESSAGE: usize = 5_000;

/// The text without blanks around it, when it is a single line of at most `longest` characters.
///
/// # Errors
///
/// When it is longer, or holds a control character.
pub(crate) fn line(what: &str, text: &str, longest: usize) -> ApiResult<String> {
    bounded(what, text, longest, char::is_control)
}

/// The text without blanks around it, when it has at most [`MESSAGE`] characters; it may have several lines.
///
/// # Errors
///
/// When it is longer, or holds a control character other than tabulators and ends of lines.
pub(crate) fn lines(what: &str, text: &str) -> ApiResult<String> {
    bounded(what, text, MESSAGE, |character| {
        character.is_control() && !matches!(character, '\n' | '\r' | '\t')
    })
}

fn bounded(what: &str, text: &str, longest: usize, forbidden: impl Fn(char) -> bool) -> ApiResult<String> {
    let text = text.trim();
    let characters = text.chars().count();
    if characters > longest {
        return Err(ApiError::invalid(format!(
            "{what}: {characters} characters; at most {longest} are taken"
        )));
    }
    match text.chars().find(|&character| forbidden(character)) {
        Some(found) => Err(ApiError::invalid(format!("{what}: holds the control character {found:?}"))),
        None => Ok(text.to_owned()),
    }
}
