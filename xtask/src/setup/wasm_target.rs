//! A compiler with a standard library for the browser: the installed one, or Debian's.

use std::env;
use std::ffi::OsString;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use anyhow::{Context, Result};

use super::debian::DebianToolchain;
use super::search_path;
use crate::process;
use crate::progress::say;
use crate::project::Project;

/// The target's name.
pub(crate) const TARGET: &str = "wasm32-unknown-unknown";

/// The folder inside the target folder that Debian's compiler puts its results into.
const DEBIAN_RESULTS: &str = "debian";

/// Some networks swallow connections instead of refusing them.
const RUSTUP_LIMIT: Duration = Duration::from_mins(3);

/// The compiler that builds the app.
pub(super) enum WasmTarget {
    /// The one that runs this program.
    Installed,
    /// Debian's, with a standard library built by [`super::debian`].
    Debian(DebianToolchain),
}

/// Finds a compiler that can build for the browser, installing as little as possible.
///
/// `GOALGRAPH_WASM_TOOLCHAIN=debian` chooses Debian's compiler even where another would do.
///
/// # Errors
///
/// When neither rustup nor Debian's packages give one.
pub(super) fn ensure(project: &Project) -> Result<WasmTarget> {
    if env::var_os("GOALGRAPH_WASM_TOOLCHAIN").is_some_and(|name| name == "debian") {
        return Ok(WasmTarget::Debian(DebianToolchain::ensure(&project.cache)?));
    }
    if WasmTarget::Installed.works(&project.cache) {
        return Ok(WasmTarget::Installed);
    }
    if let Some(toolchain) = DebianToolchain::present(&project.cache) {
        return Ok(WasmTarget::Debian(toolchain));
    }
    if process::on_path("rustup").is_some() {
        say(&format!("set-up: rustup target add {TARGET}"));
        let added =
            process::run_within(RUSTUP_LIMIT, Command::new("rustup").args(["-q", "target", "add", TARGET]));
        match added {
            Ok(()) if WasmTarget::Installed.works(&project.cache) => return Ok(WasmTarget::Installed),
            Ok(()) => say("set-up: rustup's target does not link"),
            Err(error) => say(&format!("set-up: {error:#}")),
        }
    }
    let toolchain = DebianToolchain::ensure(&project.cache).with_context(|| {
        format!(
            "no compiler for the browser: run `rustup target add {TARGET}` where rustup can reach its server"
        )
    })?;
    Ok(WasmTarget::Debian(toolchain))
}

impl WasmTarget {
    /// `first`, then where this compiler lies, then `PATH`.
    pub(super) fn search_path(&self, first: impl IntoIterator<Item = PathBuf>) -> Result<OsString> {
        let own = match self {
            Self::Installed => Vec::new(),
            Self::Debian(_) => vec![PathBuf::from("/usr/bin")],
        };
        search_path(first.into_iter().chain(own))
    }

    /// Makes a program that calls cargo use this compiler; `target` is the folder of native builds.
    pub(super) fn prepare(&self, command: &mut Command, target: &Path) {
        if let Self::Debian(toolchain) = self {
            toolchain.prepare(command, &self.results(target));
        }
    }

    /// This compiler's cargo.
    pub(super) fn cargo(&self) -> Command {
        Command::new(match self {
            Self::Installed => "cargo",
            Self::Debian(_) => "/usr/bin/cargo",
        })
    }

    /// Where its results are put; `target` is the folder of native builds.
    pub(super) fn results(&self, target: &Path) -> PathBuf {
        match self {
            Self::Installed => target.to_path_buf(),
            Self::Debian(_) => target.join(DEBIAN_RESULTS),
        }
    }

    /// This compiler's `cargo clippy`.
    pub(super) fn clippy(&self) -> Command {
        let mut command = match self {
            Self::Installed => Command::new("cargo"),
            Self::Debian(_) => Command::new("/usr/bin/cargo-clippy"),
        };
        command.args(["clippy", "--target", TARGET]);
        command
    }

    /// Links a module the way the app is linked: a standard library without bitcode fails here.
    fn works(&self, scratch: &Path) -> bool {
        let source = scratch.join(format!("probe-{}.rs", std::process::id()));
        let module = source.with_extension("wasm");
        let mut rustc = match self {
            Self::Installed => Command::new("rustc"),
            Self::Debian(toolchain) => toolchain.rustc(),
        };
        rustc.args(["--edition=2024", "--crate-type=cdylib", "--target", TARGET]);
        rustc.args(["-Cpanic=abort", "-Clto=fat", "-Copt-level=1", "-o"]).args([&module, &source]);
        let linked = fs::write(&source, PROBE).is_ok()
            && rustc.output().is_ok_and(|output| output.status.success())
            && module.is_file();
        // Left-overs do no harm.
        let _ = (fs::remove_file(source), fs::remove_file(module));
        linked
    }
}

const PROBE: &str =
    "#[unsafe(no_mangle)] pub extern \"C\" fn digits(n: u32) -> usize { n.to_string().len() }\n";

impl fmt::Display for WasmTarget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Installed => write!(f, "the installed Rust"),
            Self::Debian(toolchain) => write!(f, "Debian's {}", toolchain.version()),
        }
    }
}
