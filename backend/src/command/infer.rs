//! `goalgraph infer`: from demonstrations or words to a specification.

mod options;
mod report;
mod subsets;

use std::path::PathBuf;

use clap::Args;
use goalgraph::demonstration::Demonstration;
use goalgraph::import::Header;
use goalgraph::infer::{InferError, InferRequest, Inference, Method, RadiusRule, infer, infer_words};
use goalgraph::pdfa::Semantics;
use goalgraph::subset::SubsetRequest;

use crate::failure::Failure;
use crate::input::{self, Recording};
use crate::output;
use crate::progress::Progress;
use options::{Radius, SemanticsName};
use report::Report;
use subsets::ParameterOption;

/// Arguments of `goalgraph infer`.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Files with demonstrations, or folders: of these the .csv, .tsv, .txt and .json files
    #[arg(value_name = "FILE|DIR", required_unless_present = "words")]
    paths: Vec<PathBuf>,
    /// Infer from words instead: one per line, symbols separated by blanks (also Abbadingo)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["paths", "subset", "epsilon", "min_points", "paper", "radius", "no_header"])]
    words: Option<PathBuf>,
    /// The specification to write; - is standard output
    #[arg(short, long, value_name = "SPEC")]
    output: PathBuf,
    /// What the task is called
    #[arg(long, default_value = "Untitled task")]
    name: String,
    /// Features in which sub-goals are searched together; repeatable [default: one subset per object]
    #[arg(long, value_name = "NAME=F1,F2,..", value_parser = subsets::parse_subset)]
    subset: Vec<SubsetRequest>,
    /// DBSCAN's neighborhood radius: auto or a number, for all subsets or SUBSET=.. for one; repeatable
    #[arg(long, value_name = "[SUBSET=]auto|X", value_parser = subsets::parse_epsilon)]
    epsilon: Vec<ParameterOption<f64>>,
    /// DBSCAN's smallest neighborhood of a core point: auto or a number, as for --epsilon; repeatable
    #[arg(long, value_name = "[SUBSET=]auto|N", value_parser = subsets::parse_min_points)]
    min_points: Vec<ParameterOption<usize>>,
    /// How weights are read as probabilities
    #[arg(long, value_enum, default_value_t)]
    semantics: SemanticsName,
    /// The method as published, without our additions; needs --epsilon and --min-points
    #[arg(long, conflicts_with = "radius")]
    paper: bool,
    /// How large the ball around a cluster is
    #[arg(long, value_enum, default_value_t)]
    radius: Radius,
    /// The first line of a table holds values, not names
    #[arg(long)]
    no_header: bool,
    /// Print a summary as JSON
    #[arg(long)]
    json: bool,
}

/// Infers, writes the specification, and says what was found.
///
/// # Errors
///
/// When a file cannot be read, nothing can be inferred from it, or the specification cannot be written.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.json && output::is_standard(&arguments.output) {
        return Err(Failure::Usage(
            "error: --json needs standard output, where -o - writes already".to_owned(),
        ));
    }
    if arguments.paper {
        subsets::refuse_automatic(&arguments.epsilon, &arguments.min_points)?;
    }
    output::refuse_impossible(&arguments.output)?;
    let (inference, seconds) = timed(|| match &arguments.words {
        Some(path) => from_words(arguments, path),
        None => from_recordings(arguments),
    });
    let inference = inference?;
    output::write(&arguments.output, &inference.specification.to_json())?;
    let report = Report::new(&inference, &arguments.output, seconds);
    report.say();
    if arguments.json { output::print_json(&report) } else { Ok(()) }
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = std::time::Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}

fn from_words(arguments: &Arguments, path: &std::path::Path) -> Result<Inference, Failure> {
    let words = input::read_words(path)?;
    let mut notes = Vec::new();
    if words.rejected > 0 {
        notes.push(format!("{} marked as rejected and left out", output::count(words.rejected, "word")));
    }
    let specification = infer_words(&arguments.name, Semantics::from(arguments.semantics), words);
    let completed = vec![Vec::new(); specification.demonstrations.len()];
    Ok(Inference { specification, completed, eliminated: Vec::new(), notes })
}

fn from_recordings(arguments: &Arguments) -> Result<Inference, Failure> {
    let progress = Progress::start();
    let header = if arguments.no_header { Header::Absent } else { Header::Detect };
    let recordings = input::read_demonstrations(&arguments.paths, header, &progress)?;
    let request = request(arguments, &recordings)?;
    let demonstrations: Vec<Demonstration> =
        recordings.iter().flat_map(|recording| recording.demonstrations.iter().cloned()).collect();
    let mut tell = |step: &goalgraph::infer::Progress| {
        progress.stage(format!("{} (step {} of {})", step.stage, step.done + 1, step.total));
    };
    infer(&demonstrations, &request, &mut tell).map_err(|error| failure(&error, &recordings))
}

fn request(arguments: &Arguments, recordings: &[Recording]) -> Result<InferRequest, Failure> {
    let features = recordings.first().and_then(|recording| recording.demonstrations.first());
    let features = features.map_or(&[][..], |demonstration| demonstration.features().as_ref());
    let subsets = subsets::settle(
        &arguments.subset,
        features,
        &arguments.epsilon,
        &arguments.min_points,
        arguments.paper,
    )?;
    let (method, radius) = if arguments.paper {
        (Method::Published, RadiusRule::Largest)
    } else {
        (Method::AtRest, RadiusRule::from(arguments.radius))
    };
    let (name, semantics) = (arguments.name.clone(), Semantics::from(arguments.semantics));
    Ok(InferRequest { name, subsets, semantics, method, radius })
}

/// The engine knows demonstrations by name; people look for files.
fn failure(error: &InferError, recordings: &[Recording]) -> Failure {
    let InferError::DifferentFeatures { name, first, difference } = error else {
        return Failure::input(error.to_string());
    };
    let holds = |recording: &&Recording| recording.demonstrations.iter().any(|it| it.name() == name);
    let files: Vec<_> = recordings.iter().filter(holds).collect();
    match files.as_slice() {
        [file] => Failure::file(&file.path, format!("its features are not those of {first}: {difference}")),
        _ => Failure::input(error.to_string()),
    }
}
