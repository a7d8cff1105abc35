//! Demonstrations as JSON, read twice: once for the names of the features, once for the values.
//!
//! ```text
//! text -document> names -columns-> document or series -> recordings
//! ```

mod cells;
mod document;
mod fill;
mod names;
mod series;

use serde::de::DeserializeSeed;
use serde_json::Deserializer;

use self::document::{Document, Kind, Outline};
use self::fill::Fill;
use self::names::Names;
use self::series::Series;
use super::ImportError;
use super::column::{Columns, heading};
use super::recording::Recordings;
use super::text::shortened;
use crate::demonstration::Feature;

/// Objects may leave features out; so much that most values were never written is refused beyond this many.
const MIN_VALUES_LIMIT: usize = 1 << 20;

/// Whether a file is meant as JSON.
pub(super) fn is_json(name: &str, text: &str) -> bool {
    let has_extension = name.rsplit_once('.').is_some_and(|(_, end)| end.eq_ignore_ascii_case("json"));
    has_extension || text.trim_start().starts_with(['{', '['])
}

/// Reads the demonstrations in JSON text.
pub(super) fn read(text: &str) -> Result<Recordings, ImportError> {
    let mut names = Names::default();
    let outline = parse(text, Document(&mut names))?;
    let columns = columns(&outline, &names).map_err(ImportError::whole)?;
    let values = columns.names.len().saturating_mul(names.frames);
    if names.objects > 0 && values > MIN_VALUES_LIMIT.max(text.len()) {
        let message = format!(
            "{} frames name {} features between them, and most are missing in most frames",
            names.frames,
            columns.names.len()
        );
        return Err(ImportError::whole(message));
    }
    let parts = match outline.kind {
        Kind::Series => parse(text, Series(&columns))?,
        Kind::Frames | Kind::Demonstrations => {
            let keys = outline.features.map_or(names.keys, |features| features.keys);
            let mut fill = Fill::new(&columns, keys);
            parse(text, Document(&mut fill))?;
            fill.finish(outline.kind).map_err(ImportError::whole)?
        }
    };
    Ok(Recordings { features: columns.features.clone(), parts })
}

/// The columns by the list of features or else by the keys of the frames.
fn columns(outline: &Outline, names: &Names) -> Result<Columns, String> {
    let headings = match (&outline.kind, &outline.features) {
        (Kind::Series, Some(_)) => return Err("there are features, but no frames".to_owned()),
        (Kind::Series, None) => outline.others.iter().map(|key| heading(key)).collect(),
        (_, None) if names.lists > 0 => {
            return Err("the frames are lists of values; expected \"features\" that name them".to_owned());
        }
        (_, None) if names.frames == 0 => return Err("there are no frames".to_owned()),
        (_, None) => names.keys.names().iter().map(|key| heading(key)).collect::<Vec<Feature>>(),
        (_, Some(features)) => features.headings.clone(),
    };
    Columns::new(headings)
}

/// Reads all of `text` with `seed`.
fn parse<'de, S: DeserializeSeed<'de>>(text: &'de str, seed: S) -> Result<S::Value, ImportError> {
    let mut deserializer = Deserializer::from_str(text);
    seed.deserialize(&mut deserializer)
        .and_then(|value| deserializer.end().map(|()| value))
        .map_err(|error| explain(text, &error))
}

/// What the parser found wrong, in our words where its own are none for a reader of the file.
fn explain(text: &str, error: &serde_json::Error) -> ImportError {
    let place = format!(" at line {} column {}", error.line(), error.column());
    let full = error.to_string();
    let mut message = full.strip_suffix(&place).unwrap_or(&full).to_owned();
    for (theirs, ours) in [
        ("EOF while parsing", "the file ends within"),
        ("number out of range", "this number is out of range; expected a finite number"),
        ("trailing characters", "there is more behind the end; expected one JSON value, not one per line"),
        ("recursion limit exceeded", "this is nested too deeply"),
    ] {
        message = message.replace(theirs, ours);
    }
    let stumbles = ["expected value", "expected ident", "invalid number"];
    if let Some(start) = stumbles.iter().find_map(|stumble| message.strip_suffix(stumble))
        && stands_at_non_number(text, error)
    {
        message = format!("{start}NaN and Infinity are no JSON; expected null where a value is undefined");
    }
    let line = (error.line() > 0).then_some(error.line());
    ImportError { line, message: shortened(&message, 300) }
}

/// Whether the parser stumbled over a `NaN` or `Infinity`, which many programs write.
fn stands_at_non_number(text: &str, error: &serde_json::Error) -> bool {
    let line = text.split('\n').nth(error.line().saturating_sub(1)).unwrap_or_default().as_bytes();
    let start = error.column().saturating_sub(3).min(line.len());
    let near = String::from_utf8_lossy(&line[start..line.len().min(start + 10)]).to_ascii_lowercase();
    near.contains("nan") || near.contains("inf")
}
