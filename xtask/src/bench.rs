//! How fast the engine is, beside others: builds `goalgraph-bench` and what it measures itself against, and runs it.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

use crate::app;
use crate::process::{cargo, run};
use crate::progress::say;
use crate::project::Project;
use crate::setup::{self, Tools};

/// Said before what `goalgraph-bench report --help` says.
const PEERS_HELP: &str = "\
cargo xtask bench [--peers] [OPTIONS]

  --peers   measure beside scikit-learn, petal-clustering, AALpy and a script in Python, and in Chromium:
            installs them in the cache folder, and builds the app and the server. Gives the options
            --python, --goalgraph, --chromium and --webassembly of the following.
";

/// Measures and prints tables; `arguments` are `--peers` and those of `goalgraph-bench report`.
///
/// # Errors
///
/// When something does not build, or measuring fails.
pub(crate) fn measure(project: &Project, arguments: &[String]) -> Result<()> {
    let (own, rest): (Vec<_>, Vec<_>) = arguments.iter().partition(|argument| *argument == "--peers");
    let has_peers = !own.is_empty();
    if rest.iter().any(|argument| *argument == "--help" || *argument == "-h") {
        println!("{PEERS_HELP}");
    }
    let peers = if has_peers { arguments_for_peers(project, &rest)? } else { Vec::new() };
    say("bench: cargo build");
    let mut build = cargo(&project.root);
    build.args(["build", "--release", "--locked", "--package", "goalgraph-bench"]);
    if has_peers {
        build.args(["--features", "peers"]);
    }
    run(&mut build)?;
    let mut measure = Command::new(project.target.join("release/goalgraph-bench"));
    measure.arg("report").arg("--root").arg(&project.root).args(peers).args(rest);
    run(&mut measure)
}

/// Builds and installs what `--peers` needs, and gives the options that tell where it is.
fn arguments_for_peers(project: &Project, rest: &[&String]) -> Result<Vec<OsString>> {
    let tools = setup::for_peers(project)?;
    let mut arguments: Vec<OsString> = Vec::new();
    let mut give = |option: &str, path: PathBuf| arguments.extend([option.into(), path.into_os_string()]);
    give("--python", tools.python.join("python"));
    give("--chromium", tools.chromium);
    if asks_for(rest, "webassembly") {
        give("--webassembly", build_webassembly(project, &tools.build)?);
    }
    if asks_for(rest, "whole-way") {
        app::build(project, &tools.build)?;
        app::build_server(project, app::Profile::Release)?;
        give("--goalgraph", app::server(project, app::Profile::Release));
    }
    Ok(arguments)
}

/// Whether a section is measured: building for it takes minutes.
fn asks_for(arguments: &[&String], section: &str) -> bool {
    let mut values = Vec::new();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.strip_prefix("--only") {
            Some("") => values.extend(rest.next()),
            Some(_) => values.push(argument),
            None => {}
        }
    }
    let names = |value: &&&String| value.split([',', '=']).any(|name| name == section);
    values.is_empty() || values.iter().any(names)
}

/// The workloads for the browser, compiled and optimized as the app's worker is. Returns the folder of the module.
fn build_webassembly(project: &Project, tools: &Tools) -> Result<PathBuf> {
    say("bench: cargo build for the browser");
    let (mut build, results) = tools.build_for_the_browser();
    build.args(["--locked", "--package", "goalgraph-bench", "--lib", "--profile", "wasm-worker"]);
    // Not RUSTFLAGS, which would replace what a compiler without a standard library for the browser is told.
    build.args(["--config", "target.wasm32-unknown-unknown.rustflags=['-Ctarget-feature=+simd128']"]);
    run(&mut build)?;
    let folder = project.target.join("goalgraph-bench-webassembly");
    let mut bind = tools.program("wasm-bindgen");
    bind.args(["--target", "no-modules", "--no-typescript", "--out-dir"]).arg(&folder);
    run(bind.arg(results.join("wasm-worker/goalgraph_bench.wasm")))?;
    let module = folder.join("goalgraph_bench_bg.wasm");
    run(tools.program("wasm-opt").args(["-O3", "-o"]).args([&module, &module]))?;
    Ok(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_takes_minutes_is_built_for_its_section_only() {
        let check = |line: &str, expected| {
            let arguments: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
            let arguments: Vec<&String> = arguments.iter().collect();
            assert_eq!(asks_for(&arguments, "whole-way"), expected, "{line}");
        };
        check("", true);
        check("--write-docs --up-to 1000", true);
        check("--only whole-way", true);
        check("--only=aalpy,whole-way", true);
        check("--only aalpy --write-docs", false);
        check("--only aalpy --only whole-way", true);
    }
}
