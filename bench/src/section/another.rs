//! Another Rust crate's DBSCAN beside ours.

use std::env;
use std::process::Command;

use anyhow::Result;
use goalgraph_bench::clouds::Cloud;

use super::clustering::on_one_thread;
use crate::Options;
use crate::measure::take_turns;
use crate::peer::{GivenUp, Peer, PointFile};
use crate::report::{Report, Whose, power, times};

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    for cloud in [Cloud::Resting, Cloud::Scattered, Cloud::Uniform] {
        let mut grown = Vec::new();
        for points in super::scikit_learn::sizes(cloud, options) {
            let what = format!("{} {} points", power(points), cloud.name());
            match measure(report, &what, cloud, points) {
                Ok(seconds) => grown.push((points, seconds)),
                Err(error) => {
                    let given_up: GivenUp = error.downcast()?;
                    report.row(what, given_up.to_string());
                    break;
                }
            }
        }
        report.curve(format!("petal-clustering, {}", cloud.name()), Whose::Peers, &grown);
    }
    Ok(())
}

/// Gives the peer's seconds.
fn measure(report: &mut Report, what: &str, cloud: Cloud, points: usize) -> Result<f64> {
    let folder = tempfile::tempdir()?;
    let parameters = cloud.parameters(points, 3);
    let points = cloud.points(points, 3);
    let file = PointFile::write(folder.path(), &points, parameters)?;
    let mut peer =
        Peer::start(Command::new(env::current_exe()?).arg("another").args(file.arguments()), true)?;
    let turns = take_turns([&mut || peer.turn("cluster"), &mut || on_one_thread(&points, parameters)])?;
    report.row(what, times(turns.ratio(0, 1)));
    Ok(turns.seconds(0))
}
