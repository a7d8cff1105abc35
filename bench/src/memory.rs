//! `goalgraph-bench-memory CLOUD POINTS DIMENSION`: the most bytes that are live at once while a cloud is clustered, the
//! points included, and the bytes of the points.
//!
//! A program of its own: counting costs time, so what is timed does without.

use std::env;

use anyhow::{Context, Result};
use goalgraph::dbscan::dbscan;
use goalgraph_bench::clouds::Cloud;
use peak_alloc::PeakAlloc;

#[global_allocator]
static COUNTED: PeakAlloc = PeakAlloc;

fn main() -> Result<()> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [cloud, points, dimension] = arguments.as_slice() else {
        anyhow::bail!("expected CLOUD POINTS DIMENSION");
    };
    let cloud = Cloud::named(cloud).context("no such cloud")?;
    let (points, dimension): (usize, usize) = (points.parse()?, dimension.parse()?);
    // One thread: others would hold scratch of their own.
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global()?;
    let parameters = cloud.parameters(points, dimension);
    let before = COUNTED.current_usage();
    let points = cloud.points(points, dimension);
    let of_points = points.len() * dimension * size_of::<f64>();
    COUNTED.reset_peak_usage();
    let labels = dbscan(&points, parameters);
    println!("{} {of_points}", COUNTED.peak_usage() - before);
    drop(labels);
    Ok(())
}
