//! The page of figures: its words are written by hand, its tables by a run.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

const BEGIN: &str = "<!-- Written by `cargo xtask bench --peers --write-docs` from here -->";
const END: &str = "<!-- to here -->";
/// What a table begins with.
const HEADING: &str = "### ";

/// A table for the page, and the command that prints it again.
pub(super) struct PageTable {
    pub(super) command: String,
    pub(super) markdown: String,
}

/// Puts tables into `performance.md` in `docs`: where the same command printed one before, in its place.
///
/// # Errors
///
/// When the page cannot be read or written, or has no place for tables.
pub(super) fn write(docs: &Path, tables: &[PageTable]) -> Result<()> {
    let path = docs.join("performance.md");
    let page = fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
    let page =
        with_tables(&page, tables).with_context(|| format!("{BEGIN} and {END} must be lines of it"))?;
    Ok(fs::write(&path, page)?)
}

fn with_tables(page: &str, tables: &[PageTable]) -> Option<String> {
    let (before, rest) = page.split_once(BEGIN)?;
    let (old, after) = rest.split_once(END)?;
    let mut all: Vec<String> =
        old.split(HEADING).skip(1).map(|text| format!("{HEADING}{}\n", text.trim())).collect();
    for PageTable { command, markdown } in tables {
        let line = format!("\n`{command}`\n");
        match all.iter_mut().find(|known| known.contains(&line)) {
            Some(known) => known.clone_from(markdown),
            None => all.push(markdown.clone()),
        }
    }
    Some(format!("{before}{BEGIN}\n\n{}\n{END}{after}", all.join("\n")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(command: &str, figure: u32) -> PageTable {
        let markdown = format!("### About {command}\n\n`{command}`\n\n| {figure} |\n");
        PageTable { command: command.to_owned(), markdown }
    }

    #[test]
    fn a_table_takes_the_place_of_the_one_that_its_command_printed_before() {
        let empty = format!("# Speed\n\n{BEGIN}\n{END}\nWhy.\n");
        let page = with_tables(&empty, &[table("b", 1), table("b c", 2)]).unwrap();
        let page = with_tables(&page, &[table("a", 3), table("b", 4)]).unwrap();
        let [b, c, a] = [table("b", 4), table("b c", 2), table("a", 3)].map(|it| it.markdown);
        assert_eq!(page, format!("# Speed\n\n{BEGIN}\n\n{b}\n{c}\n{a}\n{END}\nWhy.\n"));
        assert_eq!(with_tables("# Speed", &[]), None);
    }
}
