//! Instructions of small fixed workloads. They do not depend on what else the machine does.

use std::env;
use std::hint::black_box;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use goalgraph::dbscan::{DbscanParameters, dbscan};
use goalgraph::pdfa::{Pdfa, Word};
use goalgraph::points::Points;
use goalgraph_bench::clouds::Cloud;
use goalgraph_bench::recordings::{File, one_file, read_digested};
use goalgraph_bench::words::words;

/// A workload that is counted.
pub(crate) struct Counted {
    pub(crate) name: &'static str,
    /// What its instructions are divided by.
    pub(crate) per: &'static str,
    prepare: fn() -> (Work, usize),
}

/// Work that is prepared: preparing it is not counted.
enum Work {
    Cluster(Points, DbscanParameters),
    Read(File),
    Infer(Vec<Word>),
}

/// All of them, in the order of the table.
pub(crate) const COUNTED: [Counted; 5] = [
    Counted { name: "rests", per: "point", prepare: || cluster(Cloud::Resting) },
    Counted { name: "uniform", per: "point", prepare: || cluster(Cloud::Uniform) },
    Counted { name: "blobs", per: "point", prepare: || cluster(Cloud::Blobs) },
    Counted { name: "csv", per: "byte", prepare: csv },
    Counted { name: "words", per: "symbol", prepare: symbols },
];

const POINTS: usize = 30_000;
const SYMBOLS: usize = 240_000;

fn cluster(cloud: Cloud) -> (Work, usize) {
    (Work::Cluster(cloud.points(POINTS, 3), cloud.parameters(POINTS, 3)), POINTS)
}

fn csv() -> (Work, usize) {
    let file = one_file(1);
    let bytes = file.text.len();
    (Work::Read(file), bytes)
}

fn symbols() -> (Work, usize) {
    (Work::Infer(words(SYMBOLS)), SYMBOLS)
}

/// Runs the workload of this name on this thread and prints what its instructions are to be divided by.
///
/// # Errors
///
/// When there is no such workload.
pub(crate) fn run(name: &str) -> Result<()> {
    let counted = COUNTED.iter().find(|counted| counted.name == name).context("there is no such workload")?;
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global()?;
    let (work, divisor) = (counted.prepare)();
    instructions_of_goalgraph(&work);
    println!("{divisor}");
    Ok(())
}

/// What is counted: Callgrind finds this function by its name.
#[inline(never)]
fn instructions_of_goalgraph(work: &Work) {
    match work {
        Work::Cluster(points, parameters) => drop(black_box(dbscan(points, *parameters))),
        // Valgrind's processor has no instructions for SHA-256: the digest would be most of what is counted.
        Work::Read(file) => drop(black_box(read_digested(file))),
        Work::Infer(words) => drop(black_box(Pdfa::from_words(words))),
    }
}

/// Instructions per point, byte or symbol, counted by Callgrind in a process of its own; none where there is no Valgrind.
///
/// # Errors
///
/// When Valgrind is there and fails.
pub(crate) fn instructions(counted: &Counted) -> Result<Option<f64>> {
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    valgrind.arg("--toggle-collect=*instructions_of_goalgraph*");
    valgrind.arg(env::current_exe()?).args(["count", counted.name]);
    let Ok(output) = valgrind.output() else {
        return Ok(None);
    };
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    ensure!(output.status.success(), "valgrind failed:\n{said}");
    let collected = said.lines().find_map(|line| line.split_once("Collected :"));
    let instructions: f64 = collected.context("valgrind did not say what it collected")?.1.trim().parse()?;
    let divisor: f64 = String::from_utf8(output.stdout)?.trim().parse()?;
    Ok(Some(instructions / divisor))
}
