//! The npm packages of the browser tests.

use std::fs;
use std::process::Command;

use anyhow::{Context, Result};

use crate::process::run_quietly;
use crate::progress::say;
use crate::project::Project;

/// Runs `npm ci` in `e2e/` unless what its lock names is installed already.
///
/// # Errors
///
/// When npm fails.
pub(super) fn ensure(project: &Project) -> Result<()> {
    let folder = project.e2e();
    let lock = fs::read(folder.join("package-lock.json")).context("cannot read e2e/package-lock.json")?;
    let installed = folder.join("node_modules/.installed-lock.json");
    if fs::read(&installed).is_ok_and(|it| it == lock) {
        return Ok(());
    }
    say("set-up: npm ci in e2e/");
    let mut npm = Command::new("npm");
    npm.args(["ci", "--no-audit", "--no-fund"]).current_dir(&folder);
    run_quietly(npm.env("PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD", "1"))
        .context("cannot install the browser tests")?;
    fs::write(&installed, lock).with_context(|| format!("cannot write {}", installed.display()))
}
