//! `wasm-opt`, which makes the app's module smaller: from npm, since the packages of some systems break modules.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result};

use crate::process::{first_line, run_quietly};
use crate::progress::say;
use crate::project::Project;

const VERSION: &str = "132.0.0";

/// Installs binaryen into the cache folder where it is missing; gives the folder of its programs.
///
/// # Errors
///
/// When npm fails.
pub(super) fn ensure(project: &Project) -> Result<PathBuf> {
    let home = project.cache.join("npm");
    let programs = home.join("node_modules/.bin");
    let printed = first_line(Command::new(programs.join("wasm-opt")).arg("--version"));
    if !printed.is_some_and(|line| line.contains(&format!("({})", release()))) {
        say(&format!("set-up: npm install binaryen {VERSION}"));
        std::fs::create_dir_all(&home)?;
        let mut npm = Command::new("npm");
        npm.args(["install", "--no-audit", "--no-fund", "--prefix"]).arg(&home);
        npm.arg(format!("binaryen@{VERSION}"));
        run_quietly(&mut npm).context("cannot install binaryen")?;
    }
    Ok(programs)
}

/// What `wasm-opt` and Trunk call the version: `version_132`.
fn release() -> String {
    format!("version_{}", VERSION.split('.').next().unwrap_or(VERSION))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trunk_accepts_no_other_wasm_opt() {
        let trunk = include_str!("../../../Trunk.toml");
        assert!(trunk.contains(&format!("\nwasm_opt = \"{}\"\n", release())));
    }
}
