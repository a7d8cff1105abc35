//! The app into `dist/`, then the server that embeds it.

mod compress;
mod worker;

use std::io::Write;
use std::os::unix::process::CommandExt;
use std::path::PathBuf;
use std::process::{Command, ExitCode};

use anyhow::{Context, Result};

use crate::process::{cargo, run};
use crate::progress::say;
use crate::project::Project;
use crate::setup::Tools;

/// Every crate but the app, which is compiled for the browser only.
pub(crate) const NATIVE_CRATES: [&str; 3] = ["--workspace", "--exclude", "goalgraph-web"];

/// Where the server listens unless told otherwise.
const LISTEN: &str = "127.0.0.1:7700";

/// How the server is compiled.
#[derive(Clone, Copy)]
pub(crate) enum Profile {
    /// As the tests are.
    Debug,
    /// As it is handed out.
    Release,
}

/// Builds the app into `dist/`, with a compressed copy (`.br`) beside every file that gains from it.
///
/// # Errors
///
/// When the app does not compile or `dist/` cannot be written.
pub(crate) fn build(project: &Project, tools: &Tools) -> Result<()> {
    say("app: trunk build");
    let profile = ["--cargo-profile", "wasm-release"];
    run(tools.trunk().args(["build", "--release", "--offline", "--locked"]).args(profile))?;
    worker::build(project, tools)?;
    for file in compress::compress_folder(&project.dist())? {
        if file.path.extension().is_some_and(|it| it == "wasm") {
            say(&format!("app: {file}"));
        }
    }
    Ok(())
}

/// Builds the server; the app must be in `dist/` before.
///
/// # Errors
///
/// When it does not compile.
pub(crate) fn build_server(project: &Project, profile: Profile) -> Result<()> {
    say("server: cargo build");
    let mut build = cargo(&project.root);
    build.args(["build", "--locked", "--bin", "goalgraph"]);
    match profile {
        // The same choice of crates as for the tests: with another, cargo would compile some dependencies again.
        Profile::Debug => build.args(NATIVE_CRATES),
        Profile::Release => build.args(["--release", "--package", "goalgraph-server"]),
    };
    run(&mut build)
}

/// Where [`build_server`] puts the program.
pub(crate) fn server(project: &Project, profile: Profile) -> PathBuf {
    let folder = match profile {
        Profile::Debug => "debug",
        Profile::Release => "release",
    };
    project.target.join(folder).join("goalgraph")
}

/// Starts the server in place of this program; `arguments` are those of `goalgraph serve`.
///
/// # Errors
///
/// When it cannot be started.
pub(crate) fn serve(project: &Project, arguments: &[String]) -> Result<ExitCode> {
    let mut server = Command::new(server(project, Profile::Release));
    server.arg("serve");
    let listen = listen_address(arguments).unwrap_or_else(|| {
        server.args(["--listen", LISTEN]);
        LISTEN
    });
    server.args(arguments);
    say(&format!("server: http://{listen}/ (Ctrl+C ends it)"));
    std::io::stdout().flush()?;
    // Signals and the terminal are then the server's own.
    Err(server.exec()).context("cannot start the server")
}

/// The value of `--listen`, in either spelling.
fn listen_address(arguments: &[String]) -> Option<&str> {
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.strip_prefix("--listen") {
            Some("") => return rest.next().map(String::as_str),
            Some(value) => return value.strip_prefix('='),
            None => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_listen_address_is_found_in_either_spelling() {
        let check = |line: &str, expected| {
            let arguments: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
            assert_eq!(listen_address(&arguments), expected, "{line}");
        };
        check("", None);
        check("--verbose", None);
        check("--listen 127.0.0.1:80", Some("127.0.0.1:80"));
        check("--verbose --listen=[::1]:80", Some("[::1]:80"));
    }
}
