//! What further threads bring.

use std::cell::RefCell;
use std::thread::available_parallelism;

use anyhow::Result;
use goalgraph::dbscan::dbscan;
use goalgraph::infer::{InferRequest, infer};
use goalgraph_bench::clouds::Cloud;
use goalgraph_bench::recordings::{frames_in_one_file, read};

use crate::Options;
use crate::measure::{Spread, seconds, take_turns, threads};
use crate::report::{Report, power, times};

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    let most = available_parallelism().map_or(1, usize::from);
    let largest = options.sizes().last().copied().unwrap_or(10_000).min(1_000_000);
    for cloud in Cloud::ALL {
        let parameters = cloud.parameters(largest, 3);
        let points = cloud.points(largest, 3);
        let ratio = one_against(most, &mut || drop(dbscan(&points, parameters)))?;
        report.row(format!("{} {} points, {most} threads", power(largest), cloud.name()), times(ratio));
    }
    let frames = largest.min(100_000);
    let demonstrations = read(&frames_in_one_file(frames))?;
    let request = InferRequest::default();
    let ratio = one_against(most, &mut || drop(infer(&demonstrations, &request, &mut |_| ())))?;
    report.row(format!("inference from {} frames, {most} threads", power(frames)), times(ratio));
    Ok(())
}

/// How many times as fast `most` threads are as one.
fn one_against(most: usize, work: &mut (dyn FnMut() + Send)) -> Result<Spread> {
    let (one, all) = (threads(1)?, threads(most)?);
    let work = RefCell::new(work);
    let timed = |pool: &rayon::ThreadPool| {
        let work: &mut (dyn FnMut() + Send) = &mut **work.borrow_mut();
        Ok(pool.install(|| seconds(work)))
    };
    let turns = take_turns([&mut || timed(&one), &mut || timed(&all)])?;
    Ok(turns.ratio(0, 1))
}
