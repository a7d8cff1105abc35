//! Reading CSV.

use std::cell::RefCell;

use anyhow::Result;
use goalgraph_bench::recordings::{File, nine_files, one_file, read, read_digested};
use rayon::ThreadPool;
use sha2::{Digest, Sha256};

use crate::Options;
use crate::measure::{seconds, take_turns, threads};
use crate::report::{Report, figures, times};

/// Copies are too quick for a clock where files are small: so many readings are one measurement.
const SMALL_BYTES: usize = 20_000_000;

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    measure(report, "nine files of 300 frames", &nine_files())?;
    let megabytes = if options.up_to.is_some_and(|most| most < 1_000_000) { 10 } else { 100 };
    measure(report, &format!("one file of {megabytes} MB"), &[one_file(megabytes)])
}

fn measure(report: &mut Report, what: &str, files: &[File]) -> Result<()> {
    let bytes: usize = files.iter().map(|file| file.text.len()).sum();
    let again = (SMALL_BYTES / bytes).max(1);
    let every = |work: &dyn Fn(&File)| seconds(|| (0..again).for_each(|_| files.iter().for_each(work)));
    // Written before: a copy does not pay for new pages.
    let copy = RefCell::new(vec![1_u8; files.iter().map(|file| file.text.len()).max().unwrap_or(0)]);
    let (one, all) = (threads(1)?, threads(0)?);
    let reading = |pool: &ThreadPool| pool.install(|| every(&|file| drop(std::hint::black_box(read(file)))));
    let turns = take_turns([
        &mut || Ok(reading(&one)),
        &mut || Ok(every(&|file| copy_into(&mut copy.borrow_mut(), file))),
        &mut || {
            Ok(every(&|file| {
                std::hint::black_box(Sha256::digest(file.text.as_bytes()));
            }))
        },
        &mut || Ok(reading(&all)),
        &mut || Ok(one.install(|| every(&|file| drop(std::hint::black_box(read_digested(file)))))),
    ])?;
    let rate = |side| format!("{} MB/s", figures((bytes * again) as f64 / turns.seconds(side) / 1e6));
    report.row(format!("{what}, against copying"), format!("{}, {}", times(turns.ratio(0, 1)), rate(0)));
    report.row(format!("{what}, against SHA-256"), times(turns.ratio(0, 2)));
    report.row(
        format!("{what} with a known SHA-256, against copying"),
        format!("{}, {}", times(turns.ratio(4, 1)), rate(4)),
    );
    let count = all.current_num_threads();
    report.row(
        format!("{what}, one thread against {count}"),
        format!("{}, {}", times(turns.ratio(0, 3)), rate(3)),
    );
    Ok(())
}

fn copy_into(copy: &mut [u8], file: &File) {
    copy[..file.text.len()].copy_from_slice(file.text.as_bytes());
    std::hint::black_box(copy);
}
