//! The PostgreSQL that the store is tested with: one that is there, else Debian's.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::apt;
use crate::process::on_path;

/// Where Debian has the programs of each version, which are not on `PATH`.
const VERSIONS: &str = "/usr/lib/postgresql";

/// Finds the folder of PostgreSQL's programs, installing them where they are missing.
///
/// # Errors
///
/// When there are none and they cannot be installed.
pub(crate) fn ensure() -> Result<PathBuf> {
    if let Some(found) = find() {
        return Ok(found);
    }
    apt::ensure(&["postgresql"]).context("install PostgreSQL's server for the tests of the store")?;
    find().context("the package postgresql has no programs `initdb` and `postgres`")
}

/// The folder of PostgreSQL's programs, if they are installed.
pub(crate) fn find() -> Option<PathBuf> {
    newest_version().or_else(|| on_path("initdb")?.parent().map(Path::to_path_buf)).filter(|it| is_whole(it))
}

fn newest_version() -> Option<PathBuf> {
    let versions = fs::read_dir(VERSIONS).ok()?.flatten();
    let number = |path: &PathBuf| path.file_name()?.to_str()?.parse::<u32>().ok();
    let folders = versions.map(|entry| entry.path()).filter(|path| is_whole(&path.join("bin")));
    folders.max_by_key(number).map(|path| path.join("bin"))
}

fn is_whole(folder: &Path) -> bool {
    ["initdb", "postgres"].iter().all(|program| folder.join(program).is_file())
}
