//! Placing the automaton.

use anyhow::Result;
use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import};
use goalgraph::infer::{InferRequest, infer};
use goalgraph::layout::drawing::layout_request;
use goalgraph::layout::layout;
use goalgraph_bench::recordings::{blocks, nine_files, read};

use crate::Options;
use crate::measure::{seconds, take_turns, threads};
use crate::report::{Report, times};

pub(super) fn run(_: &Options, report: &mut Report) -> Result<()> {
    let nine = nine_files().iter().map(read).collect::<Result<Vec<_>, _>>()?.concat();
    measure(report, "nine demonstrations", &nine)?;
    let task = blocks(200).csv_all();
    measure(report, "two hundred demonstrations", &import("blocks.csv", task.as_bytes(), Header::Detect)?)
}

fn measure(report: &mut Report, what: &str, demonstrations: &[Demonstration]) -> Result<()> {
    let infer = || infer(demonstrations, &InferRequest::default(), &mut |_| ());
    let specification = infer()?.specification;
    let request = layout_request(&specification);
    let one = threads(1)?;
    let turns = take_turns([&mut || Ok(one.install(|| seconds(|| layout(&request)))), &mut || {
        Ok(one.install(|| seconds(infer)))
    }])?;
    let (states, transitions) = (request.nodes.len(), request.edges.len());
    report.row(format!("{what}: {states} states, {transitions} transitions"), times(turns.ratio(0, 1)));
    Ok(())
}
