//! The whole way from demonstrations to a specification, stage by stage.

use std::time::Instant;

use anyhow::Result;
use goalgraph::demonstration::Demonstration;
use goalgraph::infer::{InferRequest, Progress, Study, infer};
use goalgraph_bench::recordings::{File, frames_in_one_file, read, scattered_in_one_file};

use crate::Options;
use crate::measure::{exponent, median, seconds, take_turns, threads};
use crate::report::{Report, figures, power, times};

/// More frames than this would take minutes.
const MOST_FRAMES: usize = 1_000_000;

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    let sizes: Vec<usize> = options.sizes().into_iter().filter(|&frames| frames <= MOST_FRAMES).collect();
    grow(report, &sizes, "", |report, what, frames| {
        let file = frames_in_one_file(frames);
        let demonstrations = read(&file)?;
        let taken = measure(report, what, &file, &demonstrations)?;
        measure_one_more(report, what, &demonstrations)?;
        Ok(taken)
    })?;
    // As many clusters as rests: whatever is done cluster by cluster shows here.
    grow(report, &sizes, " of scattered rests", |report, what, frames| {
        let file = scattered_in_one_file(frames);
        measure(report, what, &file, &read(&file)?)
    })
}

/// Measures frames of a `kind`, in numbers from the smallest on, as long as none takes long, and tells how the seconds grow.
fn grow(
    report: &mut Report,
    sizes: &[usize],
    kind: &str,
    measure: impl Fn(&mut Report, &str, usize) -> Result<f64>,
) -> Result<()> {
    let mut grown = Vec::new();
    for &frames in sizes {
        let what = format!("{} frames{kind}", power(frames));
        let taken = measure(report, &what, frames)?;
        grown.push((frames, taken));
        if taken > 30.0 {
            report.row(format!("more frames{kind}"), "left out: this would take minutes");
            break;
        }
    }
    if grown.len() > 1 {
        report.row(format!("growth exponent{kind}"), format!("{:.2}", exponent(&grown)));
    }
    Ok(())
}

/// Gives the seconds of one inference.
fn measure(report: &mut Report, what: &str, file: &File, demonstrations: &[Demonstration]) -> Result<f64> {
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
    let frames: usize = demonstrations.iter().map(Demonstration::frames).sum();
    report.row(
        what,
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
    report.row(format!("{what}, by stage"), shares.join(", "));
    Ok(taken)
}

/// The last of the demonstrations after the others, against all of them from scratch.
fn measure_one_more(report: &mut Report, what: &str, demonstrations: &[Demonstration]) -> Result<()> {
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
    report.row(format!("{what}, one demonstration more, against from scratch"), times(turns.ratio(0, 1)));
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
