//! Trunk and the wasm-bindgen command line, from crates.io into the cache folder.

use std::fs;
use std::process::Command;

use anyhow::{Context, Result};

use crate::process::{cargo, first_line, run_quietly};
use crate::progress::say;
use crate::project::Project;

/// A program that `cargo install` builds.
struct CargoTool {
    package: &'static str,
    version: &'static str,
    /// The first is asked for its version.
    programs: &'static [&'static str],
}

const TOOLS: [CargoTool; 2] = [
    // Must be the version of the wasm-bindgen crate.
    CargoTool {
        package: "wasm-bindgen-cli",
        version: "0.2.129",
        programs: &["wasm-bindgen", "wasm-bindgen-test-runner"],
    },
    CargoTool { package: "trunk", version: "0.21.14", programs: &["trunk"] },
];

/// They run for seconds: compiling them quickly matters more than their speed.
const LIGHT_PROFILE: [(&str, &str); 4] = [
    ("CARGO_PROFILE_RELEASE_OPT_LEVEL", "1"),
    ("CARGO_PROFILE_RELEASE_LTO", "off"),
    ("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "16"),
    ("CARGO_PROFILE_RELEASE_DEBUG", "0"),
];

/// Installs the tools that are missing or have another version.
///
/// # Errors
///
/// When one does not build.
pub(super) fn ensure(project: &Project) -> Result<()> {
    let missing: Vec<_> = TOOLS.iter().filter(|tool| !tool.is_installed(project)).collect();
    for tool in &missing {
        say(&format!("set-up: cargo install {} {} (takes minutes, once)", tool.package, tool.version));
        tool.install(project).with_context(|| format!("cannot install {} {}", tool.package, tool.version))?;
    }
    if !missing.is_empty() {
        // Only a loss of disk space if it stays.
        let _ = fs::remove_dir_all(project.cache.join("cargo-build"));
    }
    Ok(())
}

impl CargoTool {
    fn is_installed(&self, project: &Project) -> bool {
        let program = self.programs[0];
        let printed = first_line(Command::new(project.cache.join("bin").join(program)).arg("--version"));
        printed.is_some_and(|line| line == format!("{program} {}", self.version))
    }

    /// One build folder for all: what they have in common is compiled once, and an interrupted run goes on.
    fn install(&self, project: &Project) -> Result<()> {
        // From the cache folder: the workspace's cargo configuration is not meant for tools.
        let mut install = cargo(&project.cache);
        install.args(["install", self.package, "--version", self.version, "--locked", "--force"]);
        install.args(["--no-default-features", "--root"]).arg(&project.cache);
        for program in self.programs {
            install.args(["--bin", program]);
        }
        install.envs(LIGHT_PROFILE).env("CARGO_TARGET_DIR", project.cache.join("cargo-build"));
        run_quietly(&mut install)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_that_names_a_tool_names_the_same_version() {
        let workspace = include_str!("../../../Cargo.toml");
        let trunk = include_str!("../../../Trunk.toml");
        let [wasm_bindgen, trunk_itself] = TOOLS.map(|tool| tool.version);
        assert!(workspace.contains(&format!("\nwasm-bindgen = \"={wasm_bindgen}\"\n")));
        assert!(trunk.contains(&format!("\nwasm_bindgen = \"{wasm_bindgen}\"\n")));
        assert!(trunk.contains(&format!("\ntrunk-version = \"={trunk_itself}\"\n")));
    }
}
