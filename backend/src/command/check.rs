//! `goalgraph check`: what is wrong with a specification, and which demonstrations it accepts.

mod report;

use std::path::PathBuf;

use clap::Args;
use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, Words};
use goalgraph::pdfa::Symbol;
use goalgraph::specification::{Severity, Specification};

use crate::failure::Failure;
use crate::input::{self, Recording};
use crate::output;
use crate::progress::Progress;
use report::Report;

/// Arguments of `goalgraph check`.
#[derive(Args)]
pub(crate) struct Arguments {
    /// The specification; - is standard input
    #[arg(value_name = "SPEC")]
    specification: PathBuf,
    /// Files with demonstrations, or folders of them, to hold against it
    #[arg(value_name = "FILE|DIR")]
    paths: Vec<PathBuf>,
    /// A file of words to hold against it: one per line, names of sub-goals separated by blanks
    #[arg(long, value_name = "FILE", conflicts_with_all = ["paths", "no_header"])]
    words: Option<PathBuf>,
    /// The first line of a table holds values, not names
    #[arg(long)]
    no_header: bool,
    /// Print the findings as JSON
    #[arg(long)]
    json: bool,
}

/// A demonstration as the specification's alphabet reads it.
struct Read {
    name: String,
    /// What it completed, in order; a name is of no sub-goal where there is no symbol.
    word: Vec<(Option<Symbol>, String)>,
}

/// Lists the problems; with demonstrations or words, also how each fares.
///
/// # Errors
///
/// When a file cannot be read, or the specification has a problem that a robot must not be given.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let specification = input::read_specification(&arguments.specification)?;
    let read = match &arguments.words {
        Some(path) => Some(read_words(&specification, path)?),
        None if arguments.paths.is_empty() => None,
        None => Some(read_demonstrations(&specification, arguments)?),
    };
    let problems = specification.check();
    let report = Report::new(&specification, &problems, read.as_deref());
    if arguments.json {
        output::print_json(&report)?;
    } else {
        output::print(&report.text())?;
    }
    let errors = problems.iter().filter(|problem| problem.severity == Severity::Error).count();
    if errors == 0 {
        return Ok(());
    }
    Err(Failure::file(&arguments.specification, format!("{} found", output::count(errors, "error"))))
}

fn read_words(specification: &Specification, path: &std::path::Path) -> Result<Vec<Read>, Failure> {
    let known = |name: String| {
        let sub_goal = specification.sub_goals.iter().find(|sub_goal| sub_goal.name == name);
        (sub_goal.map(|sub_goal| sub_goal.id), name)
    };
    let Words { names, words, .. } = input::read_words(path)?;
    let names: Vec<(Option<Symbol>, String)> = names.into_iter().map(known).collect();
    let read = words.iter().enumerate().map(|(index, word)| Read {
        name: format!("word {}", index + 1),
        word: word.iter().map(|symbol| names[symbol.0 as usize].clone()).collect(),
    });
    Ok(read.collect())
}

fn read_demonstrations(specification: &Specification, arguments: &Arguments) -> Result<Vec<Read>, Failure> {
    let header = if arguments.no_header { Header::Absent } else { Header::Detect };
    let progress = Progress::start();
    let recordings = input::read_demonstrations(&arguments.paths, header, &progress)?;
    refuse_missing_features(specification, &recordings)?;
    progress.stage("Reading words");
    let demonstrations: Vec<Demonstration> =
        recordings.iter().flat_map(|recording| recording.demonstrations.iter().cloned()).collect();
    let words = goalgraph::infer::read_words(specification, &demonstrations);
    let named = |symbol: Symbol| (Some(symbol), specification.name_of(symbol));
    let read = demonstrations.iter().zip(words).map(|(demonstration, word)| Read {
        name: demonstration.name().to_owned(),
        word: word.into_iter().map(named).collect(),
    });
    Ok(read.collect())
}

/// Every feature that a sub-goal needs must be in every file.
fn refuse_missing_features(specification: &Specification, recordings: &[Recording]) -> Result<(), Failure> {
    let balls = specification.sub_goals.iter().filter_map(|sub_goal| sub_goal.ball.as_ref());
    let needed: Vec<&String> = balls.flat_map(|ball| &ball.features).collect();
    let fault = |recording: &Recording| {
        let has = |name: &str| recording.demonstrations.iter().all(|it| it.feature_index(name).is_some());
        let missing = needed.iter().find(|name| !has(name))?;
        Some(format!(
            "{}: there is no feature {missing:?}, which the specification needs",
            recording.path.display()
        ))
    };
    let faults: Vec<String> = recordings.iter().filter_map(fault).collect();
    if faults.is_empty() { Ok(()) } else { Err(Failure::Input(faults)) }
}
