//! petal-clustering as a [peer](crate::peer).

use std::io::{BufRead, stdin};

use anyhow::Result;
use ndarray::Array2;
use petal_clustering::{Dbscan, Fit};

use crate::measure::{seconds, threads};
use crate::peer::PointFile;

/// Takes turns at clustering the points of `file` on one thread.
///
/// # Errors
///
/// When the file cannot be read.
pub(crate) fn take_turns(file: &PointFile) -> Result<()> {
    let coordinates = file.read()?;
    let shape = (coordinates.len() / file.dimension, file.dimension);
    let points = Array2::from_shape_vec(shape, coordinates)?;
    let one = threads(1)?;
    println!("ready");
    for _ in stdin().lock().lines() {
        let mut clustering = Dbscan { eps: file.epsilon, min_samples: file.min_points, ..Dbscan::default() };
        println!("{}", one.install(|| seconds(|| clustering.fit(&points, None))));
    }
    Ok(())
}
