//! Nine demonstrations of 300 frames: Python from its start to words, our command line, and the page from the drop to the
//! drawn automaton.

mod server;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use goalgraph::specification::{DemonstrationWord, Specification};
use goalgraph_bench::recordings::nine_files;

use crate::Options;
use crate::measure::{seconds, take_turns};
use crate::peer::Peer;
use crate::report::{Bar, Report, times};
use server::Server;

/// What the published method is given, in both languages.
const EPSILON: &str = "0.01";
const MIN_POINTS: &str = "10";

/// Python takes at least so many times as long as the page.
const ENOUGH: f64 = 10.0;

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    let python = options.python.as_deref().context("no Python was given")?;
    let goalgraph = options.goalgraph.as_deref().context("no goalgraph was given")?;
    let folder = tempfile::tempdir()?;
    let mut paths = Vec::new();
    for file in nine_files() {
        let path = folder.path().join(&file.name);
        std::fs::write(&path, &file.text)?;
        paths.push(path);
    }
    let specification = folder.path().join("task.goalgraph.json");
    let script = options.script("words.py");
    check_same_words(
        &mut theirs(python, &script, &paths),
        ours(goalgraph, &paths, &specification).args([
            "--paper",
            "--epsilon",
            EPSILON,
            "--min-points",
            MIN_POINTS,
        ]),
        &specification,
    )?;

    let mut infer = || process(&mut ours(goalgraph, &paths, &specification));
    let mut published = || process(&mut theirs(python, &script, &paths));
    let Some(chromium) = &options.chromium else {
        let turns = take_turns([&mut published, &mut infer])?;
        report.row("Python against `goalgraph infer`, whole processes", times(turns.ratio(0, 1)));
        return Ok(());
    };
    let server = Server::start(goalgraph, folder.path())?;
    let mut node = Command::new("node");
    node.arg(options.script("drop.mjs")).arg(options.root.join("e2e")).arg(chromium);
    let mut page = Peer::start(node.arg(server.address()).args(&paths), false)?;
    let turns = take_turns([&mut published, &mut infer, &mut || page.turn("drop")])?;
    report.row("Python against `goalgraph infer`, whole processes", times(turns.ratio(0, 1)));
    let ratio = turns.ratio(0, 2);
    report.row_with_bar(
        "Python, whole process, against the page, drop to drawn automaton",
        times(ratio),
        Bar::at_least(ENOUGH, ratio.median, "x"),
    );
    Ok(())
}

fn theirs(python: &Path, script: &Path, paths: &[PathBuf]) -> Command {
    let mut command = Command::new(python);
    command.arg(script).args([EPSILON, MIN_POINTS]).args(paths);
    command
}

fn ours(goalgraph: &Path, paths: &[PathBuf], specification: &Path) -> Command {
    let mut command = Command::new(goalgraph);
    command.arg("infer").args(paths).arg("-o").arg(specification);
    command
}

/// Seconds of a whole process.
fn process(command: &mut Command) -> Result<f64> {
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut status = None;
    let seconds = seconds(|| status = command.status().ok());
    ensure!(status.is_some_and(|status| status.success()), "{command:?} failed");
    Ok(seconds)
}

/// What Python does is what we do when asked for the published method: both find the same words, but for the names of
/// their symbols. What is timed of ours looks for rests on top.
fn check_same_words(python: &mut Command, goalgraph: &mut Command, specification: &Path) -> Result<()> {
    let printed = python.output().context("cannot start Python")?;
    ensure!(printed.status.success(), "{}", String::from_utf8_lossy(&printed.stderr));
    let printed = String::from_utf8(printed.stdout)?;
    let published =
        printed.lines().map(|line| line.split_whitespace().map(str::to_owned).collect()).collect();
    process(goalgraph)?;
    let inferred = Specification::from_json(&std::fs::read_to_string(specification)?)?;
    let word =
        |demonstration: &DemonstrationWord| demonstration.word.iter().map(ToString::to_string).collect();
    let inferred: Vec<Vec<String>> = inferred.demonstrations.iter().map(word).collect();
    let (published, inferred) = (in_numbers(published), in_numbers(inferred));
    ensure!(published == inferred, "Python finds other words: {published:?} and not {inferred:?}");
    Ok(())
}

/// Symbols as numbers in the order in which they first appear.
fn in_numbers(words: Vec<Vec<String>>) -> Vec<Vec<usize>> {
    let mut numbers = BTreeMap::new();
    let mut number = |symbol: String| {
        let next = numbers.len();
        *numbers.entry(symbol).or_insert(next)
    };
    words.into_iter().map(|word| word.into_iter().map(&mut number).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_symbols_say_nothing() {
        let words = |text: &str| {
            in_numbers(text.split('/').map(|word| word.split(' ').map(str::to_owned).collect()).collect())
        };
        assert_eq!(words("g2 g0/g0 g1"), words("a b/b c"));
        assert_ne!(words("g2 g0/g0 g1"), words("a b/a c"));
    }
}
