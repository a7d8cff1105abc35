//! How clustering grows with the number of points, and with the dimension.

use anyhow::Result;
use goalgraph::dbscan::{DbscanParameters, dbscan};
use goalgraph::points::Points;
use goalgraph_bench::clouds::Cloud;

use crate::Options;
use crate::measure::{Turns, exponent, seconds, take_turns, threads};
use crate::report::{Bar, Report, Whose, figures, power, times};

/// The steepest growth that is near enough to linear.
const STEEPEST: f64 = 1.1;

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    for cloud in Cloud::ALL {
        let mut grown = Vec::new();
        for points in options.sizes() {
            let turns = cluster(cloud, points, 3)?;
            let per_point = turns.seconds(0) / points as f64 * 1e9;
            let measured = format!("{}, {} ns a point", times(turns.ratio(0, 1)), figures(per_point));
            report.row(format!("{} {} points", power(points), cloud.name()), measured);
            grown.push((points, turns.seconds(0)));
        }
        report.curve(cloud.name(), Whose::Ours, &grown);
        if let (Some(&(first, _)), Some(&(last, _)), true) = (grown.first(), grown.last(), grown.len() > 1) {
            let fitted = exponent(&grown);
            let what = format!("growth exponent of {}, {} to {}", cloud.name(), power(first), power(last));
            let bar = Bar::at_most(STEEPEST, fitted, "");
            match cloud {
                Cloud::Resting => report.row_with_bar(what, format!("{fitted:.2}"), bar),
                _ => report.row(what, format!("{fitted:.2}")),
            }
        }
    }
    for dimension in [2, 3, 6] {
        for cloud in [Cloud::Uniform, Cloud::Blobs] {
            let turns = cluster(cloud, 100_000, dimension)?;
            report.row(format!("10^5 {} points in {dimension}-D", cloud.name()), times(turns.ratio(0, 1)));
        }
    }
    Ok(())
}

/// Clustering, then sorting.
fn cluster(cloud: Cloud, points: usize, dimension: usize) -> Result<Turns<2>> {
    let parameters = cloud.parameters(points, dimension);
    let points = cloud.points(points, dimension);
    let one = threads(1)?;
    take_turns([&mut || Ok(one.install(|| seconds(|| dbscan(&points, parameters)))), &mut || {
        Ok(seconds(|| sorted(&points)))
    }])
}

fn sorted(points: &Points) -> Vec<f64> {
    let mut first: Vec<f64> = points.iter().map(|point| point[0]).collect();
    first.sort_unstable_by(f64::total_cmp);
    first
}

/// Seconds that we need on one thread.
pub(super) fn on_one_thread(points: &Points, parameters: DbscanParameters) -> Result<f64> {
    Ok(threads(1)?.install(|| seconds(|| dbscan(points, parameters))))
}
