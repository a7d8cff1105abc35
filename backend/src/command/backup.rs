//! `goalgraph backup`: a copy of everything that the server keeps, also while it runs.

use std::path::PathBuf;

use clap::Args;
use goalgraph_server::store::{Store, StoreOptions};

use super::store_arguments::StoreArguments;
use crate::failure::Failure;
use crate::output::{self, count};
use crate::progress::Progress;

/// Arguments of `goalgraph backup`.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    store: StoreArguments,
    /// The folder to make; `goalgraph serve --data FOLDER` serves it
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
}

/// Makes the copy and tells what is in it.
///
/// # Errors
///
/// When there is nothing to copy, or the folder is there already or cannot be written.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let options = StoreOptions { create: false, ..StoreOptions::default() };
    let progress = Progress::start();
    progress.stage(format!("Copying into {}", arguments.output.display()));
    let copy = |store: Store| async move { store.backup(&arguments.output).await };
    let report = arguments.store.with_store(options, copy)?;
    let files = count(usize::try_from(report.demonstrations).unwrap_or(usize::MAX), "demonstration file");
    let rows = count(usize::try_from(report.rows).unwrap_or(usize::MAX), "row");
    output::say(&format!("{}: {rows} and {files}", arguments.output.display()));
    Ok(())
}
