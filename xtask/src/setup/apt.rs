//! Packages of Debian and its relatives.

use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::process::{first_line, on_path, run_quietly};
use crate::progress::say;

/// Installs the packages that are missing.
///
/// # Errors
///
/// When there is no apt, no right to install, or no such package.
pub(super) fn ensure(packages: &[&str]) -> Result<()> {
    let missing: Vec<&str> = packages.iter().copied().filter(|package| !is_installed(package)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let names = missing.join(" ");
    if on_path("apt-get").is_none() {
        bail!("this system has no apt: install {names}, or what your system calls them, yourself");
    }
    say(&format!("set-up: apt-get install {names}"));
    run_quietly(apt_get()?.args(["-qq", "update"])).context("cannot read the package lists")?;
    run_quietly(apt_get()?.args(["-qq", "-y", "--no-install-recommends", "install"]).args(&missing))
        .with_context(|| format!("cannot install {names}"))
}

fn is_installed(package: &str) -> bool {
    let mut query = Command::new("dpkg-query");
    query.args(["--show", "--showformat=${db:Status-Status}\\n", package]);
    first_line(&mut query).is_some_and(|status| status == "installed")
}

/// `apt-get`, with `sudo` for anyone but root.
fn apt_get() -> Result<Command> {
    let user = first_line(Command::new("id").arg("-u"));
    let mut command = if user.is_some_and(|id| id == "0") {
        Command::new("apt-get")
    } else if on_path("sudo").is_some() {
        let mut sudo = Command::new("sudo");
        // sudo does not hand on the environment.
        sudo.args(["DEBIAN_FRONTEND=noninteractive", "apt-get"]);
        sudo
    } else {
        bail!("installing packages needs root or sudo");
    };
    command.env("DEBIAN_FRONTEND", "noninteractive");
    Ok(command)
}
