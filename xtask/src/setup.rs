//! What building and testing need, installed where it is missing.
//!
//! Everything but Debian packages goes into the project's own cache folder. A second run only asks for versions.

mod apt;
mod binaryen;
mod browser_tests;
mod cargo_tools;
mod chromium;
mod debian;
pub(crate) mod postgres;
mod python;
mod wasm_target;

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result};

use crate::process::{self, first_line};
use crate::progress::say;
use crate::project::Project;
use wasm_target::WasmTarget;

pub(crate) use wasm_target::TARGET;

/// What the app is built with.
pub(crate) struct Tools {
    root: PathBuf,
    target: PathBuf,
    path: OsString,
    wasm_target: WasmTarget,
}

/// What the tests need on top.
pub(crate) struct TestTools {
    /// What the app is built with.
    pub(crate) build: Tools,
    /// The browser.
    pub(crate) chromium: PathBuf,
    /// The folder of PostgreSQL's programs.
    pub(crate) postgres: PathBuf,
    /// The folder of the Python environment's programs.
    pub(crate) python: PathBuf,
}

/// What measuring against other programs needs on top of [`Tools`].
pub(crate) struct PeerTools {
    /// What the app and the WebAssembly are built with.
    pub(crate) build: Tools,
    /// The browser.
    pub(crate) chromium: PathBuf,
    /// The folder of the programs of a Python environment with other learners.
    pub(crate) python: PathBuf,
}

/// Installs what building the app and the server needs.
///
/// # Errors
///
/// When something is missing and cannot be installed.
pub(crate) fn for_build(project: &Project) -> Result<Tools> {
    check_node()?;
    let wasm_target = wasm_target::ensure(project)?;
    cargo_tools::ensure(project)?;
    let binaryen = binaryen::ensure(project)?;
    let tools = Tools {
        root: project.root.clone(),
        target: project.target.clone(),
        path: wasm_target.search_path([project.cache.join("bin"), binaryen])?,
        wasm_target,
    };
    process::run_quietly(process::cargo(&project.root).args(["fetch", "--locked"]))
        .context("cannot fetch the crates that Cargo.lock names")?;
    say(&format!("set-up: the app is compiled with {}", tools.wasm_target));
    Ok(tools)
}

/// Installs what building and the tests need.
///
/// # Errors
///
/// When something is missing and cannot be installed.
pub(crate) fn for_test(project: &Project) -> Result<TestTools> {
    let build = for_build(project)?;
    let chromium = chromium::ensure()?;
    let postgres = postgres::ensure()?;
    let python = python::ensure(project, &python::TESTS)?;
    browser_tests::ensure(project)?;
    say(&format!("set-up: the browser is {}", chromium.display()));
    say(&format!("set-up: PostgreSQL is in {}", postgres.display()));
    Ok(TestTools { build, chromium, postgres, python })
}

/// Installs what measuring against other programs needs.
///
/// # Errors
///
/// When something is missing and cannot be installed.
pub(crate) fn for_peers(project: &Project) -> Result<PeerTools> {
    let build = for_build(project)?;
    let chromium = chromium::ensure()?;
    let python = python::ensure(project, &python::PEERS)?;
    browser_tests::ensure(project)?;
    Ok(PeerTools { build, chromium, python })
}

impl Tools {
    /// Trunk, with the compiler and the tools that belong to it.
    pub(crate) fn trunk(&self) -> Command {
        let mut command = self.program("trunk");
        command.env("TRUNK_SKIP_VERSION_CHECK", "true");
        command
    }

    /// A tool for modules of the browser: `wasm-bindgen`, `wasm-opt`.
    pub(crate) fn program(&self, name: &str) -> Command {
        let mut command = Command::new(name);
        self.prepare(&mut command);
        command
    }

    /// Clippy of the compiler that builds the app.
    pub(crate) fn clippy(&self) -> Command {
        let mut command = self.wasm_target.clippy();
        self.prepare(&mut command);
        command
    }

    /// `cargo build` for the browser; the folder of the target's results comes with it.
    pub(crate) fn build_for_the_browser(&self) -> (Command, PathBuf) {
        let mut command = self.wasm_target.cargo();
        self.prepare(&mut command);
        command.args(["build", "--target", wasm_target::TARGET]);
        (command, self.wasm_target.results(&self.target).join(wasm_target::TARGET))
    }

    fn prepare(&self, command: &mut Command) {
        process::forget_own_package(command);
        command.current_dir(&self.root).env("PATH", &self.path);
        self.wasm_target.prepare(command, &self.target);
    }
}

fn check_node() -> Result<()> {
    for program in ["node", "npm"] {
        first_line(Command::new(program).arg("--version"))
            .with_context(|| format!("`{program}` is missing: install Node.js 20 or later, with npm"))?;
    }
    Ok(())
}

/// `first`, then the folders of `PATH`.
fn search_path(first: impl IntoIterator<Item = PathBuf>) -> Result<OsString> {
    let inherited = env::var_os("PATH").unwrap_or_default();
    env::join_paths(first.into_iter().chain(env::split_paths(&inherited)))
        .context("the cache folder's name must not hold a colon: set GOALGRAPH_CACHE to another folder")
}
