//! `cargo xtask`: everything a contributor or CI does, on a machine that has only cargo, a C compiler, Node and npm.
//!
//! Modules in the order in which a command uses them:
//!
//! - [`project`]: where the source, the build results and the tools lie
//! - [`setup`]: what the build needs, installed where it is missing
//! - [`app`]: the app into `dist/`, then the server that embeds it
//! - [`test`]: every check, in one run with one verdict
//! - [`samples`]: the demonstrations that come with the app
//! - [`bench`]: how fast the engine is, beside others
//!
//! [`process`] starts programs and [`progress`] says what is going on.

mod app;
mod bench;
mod process;
mod progress;
mod project;
mod samples;
mod setup;
mod test;

use std::process::ExitCode;

use anyhow::Result;

use project::Project;

/// One subcommand.
struct Subcommand {
    name: &'static str,
    arguments: &'static str,
    help: &'static str,
    run: fn(&Project, &[String]) -> Result<ExitCode>,
}

/// What `cargo xtask` can do, in the order of the help.
const SUBCOMMANDS: [Subcommand; 6] = [
    Subcommand {
        name: "run",
        arguments: "[--listen ADDRESS]",
        help: "build everything and start the server",
        run: |project, arguments| {
            let tools = setup::for_build(project)?;
            app::build(project, &tools)?;
            app::build_server(project, app::Profile::Release)?;
            app::serve(project, arguments)
        },
    },
    Subcommand {
        name: "test",
        arguments: "",
        help: "run every check and test, in real Chromium too",
        run: |project, _| {
            let tools = setup::for_test(project)?;
            test::run_all(project, &tools)
        },
    },
    Subcommand {
        name: "build",
        arguments: "",
        help: "build the app into dist/ and the server into target/release/goalgraph",
        run: |project, _| {
            let tools = setup::for_build(project)?;
            app::build(project, &tools)?;
            app::build_server(project, app::Profile::Release)?;
            Ok(ExitCode::SUCCESS)
        },
    },
    Subcommand {
        name: "setup",
        arguments: "",
        help: "install what building and testing need",
        run: |project, _| setup::for_test(project).map(|_| ExitCode::SUCCESS),
    },
    Subcommand {
        name: "samples",
        arguments: "",
        help: "write assets/samples/ again, the same bytes every time",
        run: |project, _| samples::regenerate(project).map(|()| ExitCode::SUCCESS),
    },
    Subcommand {
        name: "bench",
        arguments: "[--peers] [--only SECTION,..] ..",
        help: "measure the engine, with --peers beside others; --help tells more",
        run: |project, arguments| bench::measure(project, arguments).map(|()| ExitCode::SUCCESS),
    },
];

fn main() -> ExitCode {
    progress::start();
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((name, rest)) = arguments.split_first() else {
        println!("{}", usage());
        return ExitCode::SUCCESS;
    };
    if matches!(name.as_str(), "help" | "--help" | "-h") {
        println!("{}", usage());
        return ExitCode::SUCCESS;
    }
    let Some(subcommand) = SUBCOMMANDS.iter().find(|it| it.name == name) else {
        eprintln!("there is no subcommand `{name}`\n\n{}", usage());
        return ExitCode::from(2);
    };
    if subcommand.arguments.is_empty() && !rest.is_empty() {
        eprintln!("`cargo xtask {name}` takes no arguments, but got `{}`", rest.join(" "));
        return ExitCode::from(2);
    }
    match Project::find().and_then(|project| (subcommand.run)(&project, rest)) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn usage() -> String {
    let row = |it: &Subcommand| format!("  {:<38} {}", format!("{} {}", it.name, it.arguments), it.help);
    let rows: Vec<String> = SUBCOMMANDS.iter().map(row).collect();
    format!("cargo xtask SUBCOMMAND\n\n{}", rows.join("\n"))
}
