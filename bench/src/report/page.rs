//! The page of figures: its words are written by hand, its tables by a run.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

const BEGIN: &str = "<!-- Written by `cargo xtask bench --peers --write-docs` from here -->";
const END: &str = "<!-- to here -->";

/// Replaces the tables of `performance.md` in `docs`.
///
/// # Errors
///
/// When the page cannot be read or written, or has no place for tables.
pub(super) fn write(docs: &Path, tables: &str) -> Result<()> {
    let path = docs.join("performance.md");
    let page = fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
    let page =
        with_tables(&page, tables).with_context(|| format!("{BEGIN} and {END} must be lines of it"))?;
    Ok(fs::write(&path, page)?)
}

fn with_tables(page: &str, tables: &str) -> Option<String> {
    let (before, rest) = page.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{BEGIN}\n\n{tables}\n{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_between_the_marks_changes() {
        let page = format!("# Speed\n\n{BEGIN}\nold\n{END}\nWhy.\n");
        let expected = format!("# Speed\n\n{BEGIN}\n\nnew\n\n{END}\nWhy.\n");
        assert_eq!(with_tables(&page, "new\n").as_deref(), Some(expected.as_str()));
        assert_eq!(with_tables(&expected, "new\n").as_deref(), Some(expected.as_str()));
        assert_eq!(with_tables("# Speed", "new"), None);
    }
}
