//! How the checks ended, and the summary of them.

use std::process::ExitCode;
use std::time::Duration;

use super::tally::Tally;
use crate::progress::{duration, elapsed};

/// How a check ended.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    Ok,
    Failed,
    /// Something that it needs has failed.
    Skipped,
}

/// A check that has ended.
pub(super) struct Report {
    pub(super) name: &'static str,
    pub(super) outcome: Outcome,
    pub(super) tally: Tally,
    pub(super) time: Duration,
}

/// Prints a line for each check and one for all; gives the exit code.
pub(super) fn summarize(reports: &[Report]) -> ExitCode {
    println!();
    let mut total = Tally::default();
    for report in reports {
        println!("{}", line(report));
        total += report.tally;
    }
    let ok = reports.iter().filter(|it| it.outcome == Outcome::Ok).count();
    let all_ok = ok == reports.len();
    let verdict = if all_ok { "ok" } else { "FAILED" };
    let Tally { passed, failed, ignored } = total;
    println!();
    println!("checks: {ok} of {} ok, in {}", reports.len(), duration(elapsed()));
    println!("test result: {verdict}. {passed} passed; {failed} failed; {ignored} ignored");
    ExitCode::from(u8::from(!all_ok))
}

fn line(report: &Report) -> String {
    let outcome = match report.outcome {
        Outcome::Ok => "ok",
        Outcome::Failed => "FAILED",
        Outcome::Skipped => "skipped",
    };
    let line = format!("{:<14} {outcome:<8} {:>7}  {}", report.name, duration(report.time), report.tally);
    line.trim_end().to_owned()
}
