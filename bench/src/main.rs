//! `goalgraph-bench`: measures the engine and prints tables of ratios. `cargo xtask bench` builds and calls it.
//!
//! What is slow on a machine is slow for everything on it, and for no two seconds alike: so nothing is timed alone. The
//! two sides of a ratio take turns in one run, a ratio is that of two neighbors in time, and the median of the ratios
//! stands in the table with the least and the greatest. The frameworks for micro-benchmarks time one thing after the
//! other, which is why the runner is our own; `cargo bench -p goalgraph-bench` has single passes in one of them.
//!
//! Modules in the order in which a run uses them:
//!
//! - [`measure`]: turns, medians and growth
//! - [`peer`]: other programs that take turns with us
//! - [`report`]: rows, tables, the chart, the page in `docs/`
//! - [`section`]: what is measured, one file a section
//! - [`count`]: instructions, where noise would drown a time

#[cfg(feature = "peers")]
mod another;
mod count;
mod measure;
mod peer;
mod report;
mod section;

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, Parser, Subcommand};

/// Measures the engine.
#[derive(Parser)]
#[command(name = "goalgraph-bench")]
struct CommandLine {
    #[command(subcommand)]
    subcommand: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Measure, and print the tables
    Report(Options),
    /// Run one small fixed workload, for counting its instructions
    Count {
        /// Its name
        workload: String,
    },
    /// Take turns at clustering the points of a file with another Rust crate
    #[cfg(feature = "peers")]
    Another(peer::PointFile),
}

/// What to measure, and with what.
#[derive(Args)]
struct Options {
    /// The root of the source
    #[arg(long, default_value = ".")]
    root: PathBuf,
    /// Measure only these sections
    #[arg(long, value_delimiter = ',', value_name = "SECTION,..")]
    only: Vec<String>,
    /// The largest number of points; without it ten million where there are 6 GB of free memory
    #[arg(long, value_name = "POINTS")]
    up_to: Option<usize>,
    /// Python with the packages of bench/peers/requirements.txt
    #[arg(long, value_name = "PROGRAM")]
    python: Option<PathBuf>,
    /// The release build of goalgraph, with the app in it
    #[arg(long, value_name = "PROGRAM")]
    goalgraph: Option<PathBuf>,
    /// Chromium
    #[arg(long, value_name = "PROGRAM")]
    chromium: Option<PathBuf>,
    /// The folder with this crate as WebAssembly
    #[arg(long, value_name = "FOLDER")]
    webassembly: Option<PathBuf>,
    /// Put the tables into docs/performance.md, and the chart beside it where clustering was measured
    #[arg(long)]
    write_docs: bool,
}

impl Options {
    /// The numbers of points, ten times as many each.
    fn sizes(&self) -> Vec<usize> {
        let enough = measure::available_memory().is_none_or(|bytes| bytes > 6_000_000_000);
        let most = self.up_to.unwrap_or(if enough { 10_000_000 } else { 1_000_000 });
        [10_000, 100_000, 1_000_000, 10_000_000].into_iter().filter(|&points| points <= most).collect()
    }

    /// A script in `bench/peers/`.
    fn script(&self, name: &str) -> PathBuf {
        self.root.join("bench/peers").join(name)
    }
}

fn main() -> Result<()> {
    match CommandLine::parse().subcommand {
        Command::Report(options) => {
            let report = section::measure(&options)?;
            println!("\n{}", report.markdown());
            if options.write_docs {
                report.write(&options.root.join("docs")).context("cannot write docs/performance")?;
            }
            Ok(())
        }
        Command::Count { workload } => count::run(&workload),
        #[cfg(feature = "peers")]
        Command::Another(file) => another::take_turns(&file),
    }
}
