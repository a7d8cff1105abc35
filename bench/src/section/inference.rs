//! The whole way from demonstrations to a specification, stage by stage.

use std::time::Instant;

use anyhow::Result;
use goalgraph::demonstration::Demonstration;
use goalgraph::infer::{InferRequest, Progress, Study, infer};
use goalgraph_bench::recordings::{File, frames_in_one_file, read};

use crate::Options;
use crate::measure::{exponent, median, seconds, take_turns, threads};
use crate::report::{Report, figures, power, times};

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    let mut grown = Vec::new();
    for frames in options.sizes().into_iter().filter(|&frames| frames <= 1_000_000) {
        let file = frames_in_one_file(frames);
        let demonstrations = read(&file)?;
        let taken = measure(report, frames, &file, &demonstrations)?;
        measure_one_more(report, frames, &demonstrations)?;
        grown.push((frames, taken));
        if taken > 30.0 {
            report.row("more frames", "left out: this would take minutes");
            break;
        }
    }
    if grown.len() > 1 {
        report.row("growth exponent", format!("{:.2}", exponent(&grown)));
    }
    Ok(())
}

/// Gives the seconds of one inference.
fn measure(report: &mut Report, frames: usize, file: &File, demonstrations: &[Demonstration]) -> Result<f64> {
    let one = threads(1)?;
    let mut stages: Vec<Vec<(String, f64)>> = Vec::new();
    let turns = take_turns([
        &mut || {
            let started = Instant::now();
            stages.push(one.install(|| stage_seconds(demonstrations)));
            Ok(started.elapsed().as_secs_f64())
        },
        &mut || Ok(one.install(|| seconds(|| read(file)))),
    ])?;
    let taken = turns.seconds(0);
    report.row(
        format!("{} frames", power(frames)),
        format!("{}, {} ns a frame", times(turns.ratio(0, 1)), figures(taken / frames as f64 * 1e9)),
    );
    let shares: Vec<String> = (0..stages[0].len())
        .map(|stage| {
            let share =
                |run: &Vec<(String, f64)>| run[stage].1 / run.iter().map(|(_, seconds)| seconds).sum::<f64>();
            let share = median(&stages.iter().map(share).collect::<Vec<_>>());
            format!("{} {:.0} %", stages[0][stage].0.to_lowercase(), 100.0 * share)
        })
        .collect();
    report.row(format!("{} frames, by stage", power(frames)), shares.join(", "));
    Ok(taken)
}

/// The last of the demonstrations after the others, against all of them from scratch.
fn measure_one_more(report: &mut Report, frames: usize, demonstrations: &[Demonstration]) -> Result<()> {
    let one = threads(1)?;
    let request = InferRequest::default();
    let quiet = || |_: &Progress| {};
    let others = &demonstrations[..demonstrations.len().saturating_sub(1)];
    let mut known = Study::default();
    one.install(|| known.infer(others, &request, &mut quiet()))?;
    let turns = take_turns([
        &mut || {
            let mut study = known.clone();
            Ok(one.install(|| seconds(|| study.infer(demonstrations, &request, &mut quiet()))))
        },
        &mut || Ok(one.install(|| seconds(|| infer(demonstrations, &request, &mut quiet())))),
    ])?;
    let one_more = format!("{} frames, one demonstration more, against from scratch", power(frames));
    report.row(one_more, times(turns.ratio(0, 1)));
    Ok(())
}

/// The stages that the engine tells of, with their seconds.
fn stage_seconds(demonstrations: &[Demonstration]) -> Vec<(String, f64)> {
    let mut begun: Vec<(String, Instant)> = Vec::new();
    let inferred = infer(demonstrations, &InferRequest::default(), &mut |progress| {
        begun.push((progress.stage.clone(), Instant::now()));
    });
    drop(inferred);
    let seconds =
        |pair: &[(String, Instant)]| (pair[0].0.clone(), pair[1].1.duration_since(pair[0].1).as_secs_f64());
    begun.windows(2).map(seconds).collect()
}
