//! Every check, in one run with one verdict.
//!
//! The order is: what fails fastest first, and what is compiled for one check is there for the next.

mod api;
mod postgres;
mod report;
mod tally;

use std::fs;
use std::net::{Ipv4Addr, TcpListener};
use std::process::{Command, ExitCode};
use std::time::Instant;

use anyhow::{Context, Result};

use crate::app::{self, NATIVE_CRATES, Profile};
use crate::process::{cargo, first_line, run, run_watched};
use crate::progress::say;
use crate::project::Project;
use crate::setup::TestTools;
use postgres::Postgres;
use report::{Outcome, Report};
use tally::Tally;

/// One check; it counts the tests that it ran, if it ran any.
struct Check {
    name: &'static str,
    run: fn(&Project, &TestTools, &mut Tally) -> Result<()>,
    /// Checks without which this one means nothing.
    needs: &'static [&'static str],
}

const CHECKS: [Check; 11] = [
    Check { name: "format", run: format, needs: &[] },
    Check { name: "clippy", run: clippy, needs: &[] },
    Check { name: "clippy, app", run: clippy_app, needs: &[] },
    Check { name: "Rust tests", run: rust_tests, needs: &[] },
    Check { name: "app unit tests", run: app_unit_tests, needs: &[] },
    Check { name: "Rust examples", run: rust_examples, needs: &[] },
    Check { name: "app", run: |project, tools, _| app::build(project, &tools.build), needs: &[] },
    Check {
        name: "server",
        run: |project, _, _| app::build_server(project, Profile::Debug),
        needs: &["app"],
    },
    Check { name: "Python executor", run: python_executor, needs: &["server"] },
    Check { name: "API", run: requests_to_the_api, needs: &["server"] },
    Check { name: "browser tests", run: browser_tests, needs: &["server"] },
];

/// Runs every check, also after one has failed, and prints a summary.
///
/// # Errors
///
/// When the checks cannot be run at all; a check that fails is told by the exit code.
pub(crate) fn run_all(project: &Project, tools: &TestTools) -> Result<ExitCode> {
    // The server compiles only where the folder that it embeds is there.
    fs::create_dir_all(project.dist()).context("cannot make dist/")?;
    let mut reports: Vec<Report> = Vec::new();
    for check in &CHECKS {
        reports.push(run_check(check, project, tools, &reports));
    }
    Ok(report::summarize(&reports))
}

fn run_check(check: &Check, project: &Project, tools: &TestTools, before: &[Report]) -> Report {
    let started = Instant::now();
    let mut tally = Tally::default();
    let blocked = before.iter().any(|it| it.outcome != Outcome::Ok && check.needs.contains(&it.name));
    let outcome = if blocked {
        Outcome::Skipped
    } else {
        say(&format!("test: {}", check.name));
        match (check.run)(project, tools, &mut tally) {
            Ok(()) => Outcome::Ok,
            Err(error) => {
                eprintln!("error: {}: {error:#}", check.name);
                Outcome::Failed
            }
        }
    };
    Report { name: check.name, outcome, tally, time: started.elapsed() }
}

fn format(project: &Project, _: &TestTools, _: &mut Tally) -> Result<()> {
    run(cargo(&project.root).args(["fmt", "--all", "--check"]))
}

fn clippy(project: &Project, _: &TestTools, _: &mut Tally) -> Result<()> {
    run(cargo(&project.root).args(["clippy", "--locked"]).args(NATIVE_CRATES).args([
        "--all-targets",
        "--",
        "-Dwarnings",
    ]))
}

fn clippy_app(_: &Project, tools: &TestTools, _: &mut Tally) -> Result<()> {
    run(tools.build.clippy().args([
        "--locked",
        "--package",
        "goalgraph-web",
        "--all-targets",
        "--",
        "-Dwarnings",
    ]))
}

/// With nextest, which runs them side by side, where it is installed. The store is tested with a PostgreSQL as well: by
/// hand, start one and set `GOALGRAPH_TEST_POSTGRES` to the URL of a user who may create databases.
fn rust_tests(project: &Project, tools: &TestTools, tally: &mut Tally) -> Result<()> {
    let postgres = Postgres::start(&tools.postgres)?;
    let has_nextest = first_line(cargo(&project.root).args(["nextest", "--version"])).is_some();
    let mut tests = cargo(&project.root);
    if has_nextest {
        tests.args(["nextest", "run", "--no-fail-fast", "--no-tests=pass"]);
    } else {
        tests.args(["test", "--no-fail-fast", "--tests"]);
    }
    tests.env(postgres::VARIABLE, postgres.url());
    run_watched(tests.arg("--locked").args(NATIVE_CRATES), |line| tally.read(line))
}

/// What of the app needs no browser runs natively. Compiling leptos takes far longer than the tests, so nothing is
/// optimized.
fn app_unit_tests(project: &Project, _: &TestTools, tally: &mut Tally) -> Result<()> {
    let mut tests = cargo(&project.root);
    tests.args(["test", "--locked", "--package", "goalgraph-web", "--lib"]);
    for setting in ["dev.package.'*'.opt-level=0", "test.opt-level=0", "dev.debug=0", "test.debug=0"] {
        tests.args(["--config".to_owned(), format!("profile.{setting}")]);
    }
    run_watched(&mut tests, |line| tally.read(line))
}

fn rust_examples(project: &Project, _: &TestTools, tally: &mut Tally) -> Result<()> {
    run_watched(cargo(&project.root).args(["test", "--doc", "--locked"]).args(NATIVE_CRATES), |line| {
        tally.read(line);
    })
}

/// Its types, then its tests, which start the server.
fn python_executor(project: &Project, tools: &TestTools, tally: &mut Tally) -> Result<()> {
    let python = |module: &str| {
        let mut command = Command::new(tools.python.join("python"));
        command.current_dir(project.python_executor()).args(["-m", module]);
        command.env("GOALGRAPH_BIN", app::server(project, Profile::Debug));
        command
    };
    run(&mut python("mypy"))?;
    run_watched(&mut python("pytest"), |line| tally.read(line))
}

fn requests_to_the_api(project: &Project, tools: &TestTools, _: &mut Tally) -> Result<()> {
    api::check(project, &app::server(project, Profile::Debug), &tools.python)
}

fn browser_tests(project: &Project, tools: &TestTools, tally: &mut Tally) -> Result<()> {
    let mut playwright = Command::new("node");
    playwright
        .current_dir(project.e2e())
        .args(["node_modules/@playwright/test/cli.js", "test"])
        .env("GOALGRAPH_BIN", app::server(project, Profile::Debug))
        .env("GOALGRAPH_CHROMIUM", &tools.chromium)
        .env("GOALGRAPH_PORT", free_port()?.to_string());
    run_watched(&mut playwright, |line| tally.read(line))
}

/// A loopback port that nothing listens on.
fn free_port() -> Result<u16> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).context("no loopback port is free")?;
    Ok(listener.local_addr()?.port())
}
