//! Python environments of the project's own: one with what the Python executor and the API are tested with, one with
//! what the engine is measured against.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use super::apt;
use crate::process::{first_line, on_path, run_quietly};
use crate::progress::say;
use crate::project::Project;

/// An environment in the cache folder.
pub(super) struct Environment {
    /// Name of its folder.
    pub(super) folder: &'static str,
    /// What it is for, to say while it is made.
    pub(super) purpose: &'static str,
    /// The list of its packages, from the root of the source.
    pub(super) requirements: &'static str,
}

/// What the Python executor and the API are tested with.
pub(super) const TESTS: Environment = Environment {
    folder: "python",
    purpose: "the tests",
    requirements: "executors/python/requirements-test.txt",
};

/// What the engine is measured against.
pub(super) const PEERS: Environment = Environment {
    folder: "python-peers",
    purpose: "the peers",
    requirements: "bench/peers/requirements.txt",
};

/// Makes the environment and installs what its list names, unless that is done already. Returns the folder of its
/// programs.
///
/// # Errors
///
/// When there is no Python 3.11 or later, or the packages cannot be installed.
pub(super) fn ensure(project: &Project, environment: &Environment) -> Result<PathBuf> {
    let list = project.root.join(environment.requirements);
    let requirements = fs::read(&list).with_context(|| format!("cannot read {}", list.display()))?;
    let folder = project.cache.join(environment.folder);
    let programs = folder.join("bin");
    let stamp = folder.join("installed.txt");
    let runs = first_line(Command::new(programs.join("python")).arg("--version")).is_some();
    if runs && fs::read(&stamp).is_ok_and(|installed| installed == requirements) {
        return Ok(programs);
    }
    say(&format!("set-up: a Python environment for {}", environment.purpose));
    make(&folder).context("cannot make a Python environment")?;
    let mut pip = Command::new(programs.join("python"));
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r"]).arg(&list);
    run_quietly(&mut pip)
        .with_context(|| format!("cannot install the Python packages of {}", environment.purpose))?;
    fs::write(&stamp, requirements).with_context(|| format!("cannot write {}", stamp.display()))?;
    Ok(programs)
}

fn make(folder: &Path) -> Result<()> {
    if on_path("python3").is_none() {
        apt::ensure(&["python3", "python3-venv"])?;
    }
    let version =
        first_line(Command::new("python3").args(["-c", "import sys; print(*sys.version_info[:2])"]));
    let version = version.context("`python3` does not run")?;
    let numbers: Vec<u32> = version.split(' ').filter_map(|number| number.parse().ok()).collect();
    ensure!(numbers >= vec![3, 11], "Python 3.11 or later is needed, and `python3` is {version}");
    let venv = || {
        let mut command = Command::new("python3");
        command.args(["-m", "venv", "--clear"]).arg(folder);
        run_quietly(&mut command)
    };
    // Debian's Python comes without what makes environments.
    venv().or_else(|_| apt::ensure(&["python3-venv"]).and_then(|()| venv()))
}
