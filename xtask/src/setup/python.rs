//! A Python environment of the project's own, with what the Python executor and the API are tested with.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use super::apt;
use crate::process::{first_line, on_path, run_quietly};
use crate::progress::say;
use crate::project::Project;

/// Makes the environment in the cache folder and installs what `requirements-test.txt` names, unless that is done
/// already. Returns the folder of its programs.
///
/// # Errors
///
/// When there is no Python 3.11 or later, or the packages cannot be installed.
pub(super) fn ensure(project: &Project) -> Result<PathBuf> {
    let list = project.python_executor().join("requirements-test.txt");
    let requirements = fs::read(&list).with_context(|| format!("cannot read {}", list.display()))?;
    let folder = project.cache.join("python");
    let programs = folder.join("bin");
    let stamp = folder.join("installed.txt");
    let runs = first_line(Command::new(programs.join("python")).arg("--version")).is_some();
    if runs && fs::read(&stamp).is_ok_and(|installed| installed == requirements) {
        return Ok(programs);
    }
    say("set-up: a Python environment for the tests");
    make(&folder).context("cannot make a Python environment")?;
    let mut pip = Command::new(programs.join("python"));
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r"]).arg(&list);
    run_quietly(&mut pip).context("cannot install the Python packages of the tests")?;
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
