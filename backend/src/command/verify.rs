//! `goalgraph verify`: whether everything that the server keeps is still what was stored.

use clap::Args;
use goalgraph_server::store::{Store, StoreOptions, VerifyReport};

use super::store_arguments::StoreArguments;
use crate::failure::Failure;
use crate::output::{self, count, list};
use crate::progress::Progress;

/// Arguments of `goalgraph verify`.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    store: StoreArguments,
}

/// Hashes everything again, and prints what was checked.
///
/// # Errors
///
/// One line for each thing that is wrong; or when there is nothing to check.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let options = StoreOptions { create: false, ..StoreOptions::default() };
    let progress = Progress::start();
    progress.stage("Hashing every revision and every demonstration file");
    let report = arguments.store.with_store(options, |store: Store| async move { store.verify().await })?;
    output::print(&format!("checked {}\n", checked(&report)))?;
    if report.faults.is_empty() { Ok(()) } else { Err(Failure::Input(report.faults)) }
}

fn checked(report: &VerifyReport) -> String {
    let of = |number: u64, noun| count(usize::try_from(number).unwrap_or(usize::MAX), noun);
    list(&[
        of(report.revisions, "revision"),
        of(report.approvals, "approval"),
        of(report.runs, "run"),
        of(report.events, "run event"),
        of(report.demonstrations, "demonstration file"),
    ])
}
