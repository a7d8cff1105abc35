//! scikit-learn's DBSCAN beside ours: how long it takes, and whether it says the same.

mod agreement;
mod real;

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result};
use goalgraph::dbscan::DbscanParameters;
use goalgraph::points::Points;
use goalgraph_bench::clouds::{Cloud, labels};

use super::clustering::on_one_thread;
use crate::Options;
use crate::measure::{Turns, exponent, take_turns};
use crate::peer::{GivenUp, Peer, PointFile};
use crate::report::{Bar, Report, Whose, power, times};
use agreement::{Theirs, differing_borders};

/// How many times as fast as scikit-learn is enough, with and without heaps.
const ENOUGH_AT_REST: f64 = 20.0;
const ENOUGH_IN_NOISE: f64 = 3.0;

/// Its ways to find neighbors: what it chooses by itself, and the one that suits three dimensions.
const ALGORITHMS: [&str; 2] = ["auto", "kd_tree"];

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    let python = options.python.as_deref().context("no Python was given")?;
    for cloud in Cloud::ALL {
        for algorithm in ALGORITHMS {
            grow(options, report, python, cloud, algorithm)?;
        }
    }
    real::run(options, report, python)
}

/// How many points peers are given: where things share places, their neighborhoods are quadratic.
pub(super) fn sizes(cloud: Cloud, options: &Options) -> Vec<usize> {
    let least = options.sizes().first().copied().unwrap_or(10_000);
    match cloud {
        Cloud::Resting => vec![least, 2 * least, 4 * least, 10 * least, 100 * least],
        _ => options.sizes(),
    }
    .into_iter()
    .filter(|&points| points <= options.up_to.unwrap_or(1_000_000).min(1_000_000))
    .collect()
}

fn grow(options: &Options, report: &mut Report, python: &Path, cloud: Cloud, algorithm: &str) -> Result<()> {
    let mut grown = Vec::new();
    for points in sizes(cloud, options) {
        let what = format!("{} {} points, {algorithm}", power(points), cloud.name());
        let parameters = cloud.parameters(points, 3);
        let script = options.script("dbscan.py");
        match compare(python, &script, &cloud.points(points, 3), parameters, algorithm) {
            Ok(compared) => {
                let ratio = compared.turns.ratio(0, 1);
                let measured = format!("{}, {}", times(ratio), said(compared.borders, compared.clusters));
                match cloud {
                    Cloud::Resting | Cloud::Scattered => {
                        report.row_with_bar(what, measured, Bar::at_least(ENOUGH_AT_REST, ratio.median, "x"));
                    }
                    Cloud::Uniform => {
                        report.row_with_bar(
                            what,
                            measured,
                            Bar::at_least(ENOUGH_IN_NOISE, ratio.median, "x"),
                        );
                    }
                    Cloud::Blobs => report.row(what, measured),
                }
                grown.push((points, compared.turns.seconds(0)));
            }
            Err(error) => {
                let given_up: GivenUp = error.downcast()?;
                report.row(what, given_up.to_string());
                break;
            }
        }
    }
    if grown.len() > 1 {
        let what = format!("its growth exponent on {}, {algorithm}", cloud.name());
        report.row(what, format!("{:.2}", exponent(&grown)));
    }
    if algorithm == ALGORITHMS[1] {
        report.curve(format!("scikit-learn, {}", cloud.name()), Whose::Peers, &grown);
    }
    Ok(())
}

/// Theirs and ours in turns. They agree, but for so many border points.
struct Compared {
    turns: Turns<2>,
    clusters: usize,
    borders: usize,
}

/// # Errors
///
/// [`GivenUp`], or that the clusterings are not one by the definition.
fn compare(
    python: &Path,
    script: &Path,
    points: &Points,
    parameters: DbscanParameters,
    algorithm: &str,
) -> Result<Compared> {
    let folder = tempfile::tempdir()?;
    let file = PointFile::write(folder.path(), points, parameters)?;
    let labels_file = folder.path().join("labels.i64");
    let mut command = Command::new(python);
    command.arg(script).args(file.arguments()).arg(algorithm).arg(&labels_file);
    for threads in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"] {
        command.env(threads, "1");
    }
    let mut peer = Peer::start(&command, true)?;
    let turns = take_turns([&mut || peer.turn("cluster"), &mut || on_one_thread(points, parameters)])?;
    let theirs = Theirs::read(&labels_file, points.len())?;
    let borders = differing_borders(points, parameters, &labels(points, parameters), &theirs)?;
    Ok(Compared { turns, clusters: theirs.clusters(), borders })
}

fn said(borders: usize, clusters: usize) -> String {
    match borders {
        0 => format!("the same labels ({clusters} clusters)"),
        _ => format!("the same labels ({clusters} clusters) but for {borders} border points between two"),
    }
}
