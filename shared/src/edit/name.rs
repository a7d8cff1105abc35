//! Names that people give.

use super::EditError;

/// The most characters of a name.
pub const MAX_NAME: usize = 200;

/// `name`, if it can be shown on one line.
pub(super) fn visible(name: &str) -> Result<String, EditError> {
    let length = name.chars().count();
    if length > MAX_NAME {
        return Err(EditError::LongName(length));
    }
    match name.chars().find(|character| character.is_control()) {
        Some(character) => Err(EditError::ControlCharacter(character)),
        None if name.trim().is_empty() => Err(EditError::BlankName),
        None => Ok(name.to_owned()),
    }
}

/// `name`, or none when it is empty.
pub(super) fn optional(name: &str) -> Result<Option<String>, EditError> {
    if name.is_empty() { Ok(None) } else { visible(name).map(Some) }
}

/// The beginning of `name` that fits into a label of a list.
pub(super) fn shortened(name: &str) -> String {
    const MOST: usize = 40;
    if name.chars().count() <= MOST {
        return name.to_owned();
    }
    name.chars().take(MOST - 1).chain(['…']).collect()
}
