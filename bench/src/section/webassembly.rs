//! The same workloads as WebAssembly in Chromium and natively.

use std::process::Command;

use anyhow::{Context, Result};
use goalgraph_bench::clouds::Cloud;
use goalgraph_bench::recordings::{one_file, read_digested};

use super::clustering::on_one_thread;
use crate::Options;
use crate::measure::{seconds, take_turns, threads};
use crate::peer::Peer;
use crate::report::{Bar, Report, power, times};

/// How many times as long as natively is short enough.
const ENOUGH: f64 = 1.6;

const POINTS: usize = 300_000;
const MEGABYTES: usize = 20;

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    let mut peer = start(options)?;
    for cloud in Cloud::ALL {
        let order = format!("cluster {} {POINTS}", cloud.name());
        let parameters = cloud.parameters(POINTS, 3);
        let points = cloud.points(POINTS, 3);
        let turns = take_turns([&mut || peer.turn(&order), &mut || on_one_thread(&points, parameters)])?;
        let ratio = turns.ratio(0, 1);
        let what = format!("clustering {} {} points", power(POINTS), cloud.name());
        report.row_with_bar(what, times(ratio), Bar::at_most(ENOUGH, ratio.median, "x"));
    }
    let file = one_file(MEGABYTES);
    let one = threads(1)?;
    let order = format!("read {MEGABYTES}");
    let turns =
        take_turns([
            &mut || peer.turn(&order),
            &mut || Ok(one.install(|| seconds(|| read_digested(&file)))),
        ])?;
    let ratio = turns.ratio(0, 1);
    let what = format!("reading {MEGABYTES} MB of CSV with a known SHA-256");
    report.row_with_bar(what, times(ratio), Bar::at_most(ENOUGH, ratio.median, "x"));
    Ok(())
}

fn start(options: &Options) -> Result<Peer> {
    let mut node = Command::new("node");
    node.arg(options.script("webassembly.mjs")).arg(options.root.join("e2e"));
    node.arg(options.chromium.as_deref().context("no Chromium was given")?);
    node.arg(options.webassembly.as_deref().context("no WebAssembly was given")?);
    Peer::start(&node, false)
}
