//! The most memory that clustering needs at once.

use std::process::Command;

use anyhow::{Context, Result, ensure};
use goalgraph_bench::clouds::Cloud;

use crate::Options;
use crate::report::{Bar, Report, figures, power};

/// How many times the points' own size is enough.
const ENOUGH: f64 = 3.0;

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    let sizes = options.sizes();
    for cloud in Cloud::ALL {
        for &points in &sizes {
            let times = peak(cloud, points)?;
            let what = format!("{} {} points", power(points), cloud.name());
            let measured = format!("{}x", figures(times));
            match cloud {
                Cloud::Resting => report.row_with_bar(what, measured, Bar::at_most(ENOUGH, times, "x")),
                _ => report.row(what, measured),
            }
        }
    }
    Ok(())
}

/// Measured in a program that counts what it allocates, which lies beside this one.
fn peak(cloud: Cloud, points: usize) -> Result<f64> {
    let program = std::env::current_exe()?.with_file_name("goalgraph-bench-memory");
    let mut counted = Command::new(&program);
    counted.args([cloud.name(), &points.to_string(), "3"]);
    let output = counted.output().with_context(|| format!("cannot start {}", program.display()))?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = String::from_utf8(output.stdout)?;
    let (peak, own) = printed.trim().split_once(' ').context("expected two numbers of bytes")?;
    Ok(peak.parse::<f64>()? / own.parse::<f64>()?)
}
