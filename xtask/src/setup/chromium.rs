//! The browser of the browser tests: one that is there, else Debian's. None is ever downloaded.

use std::env;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};

use super::apt;
use crate::process::on_path;

const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Finds Chromium, installing it where it is missing.
///
/// `GOALGRAPH_CHROMIUM` names one to use instead.
///
/// # Errors
///
/// When there is none and it cannot be installed.
pub(super) fn ensure() -> Result<PathBuf> {
    if let Some(chosen) = env::var_os("GOALGRAPH_CHROMIUM").map(PathBuf::from) {
        if !chosen.is_file() {
            bail!("GOALGRAPH_CHROMIUM names {}, which is no file", chosen.display());
        }
        return Ok(chosen);
    }
    if let Some(found) = find() {
        return Ok(found);
    }
    apt::ensure(&["chromium"]).context(
        "install Chromium for the browser tests, or set GOALGRAPH_CHROMIUM to a Chromium or Chrome",
    )?;
    find().context("the package chromium has no program `chromium`: set GOALGRAPH_CHROMIUM to it")
}

fn find() -> Option<PathBuf> {
    NAMES.iter().find_map(|name| on_path(name))
}
