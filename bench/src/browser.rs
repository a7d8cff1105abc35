//! The workloads as a page calls them; `bench/peers/webassembly.mjs` does.

use goalgraph::dbscan::{DbscanParameters, dbscan};
use goalgraph::points::Points;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::clouds::Cloud;
use crate::recordings::{File, one_file, read_digested};

/// A cloud of points in 3-D, ready to be clustered.
#[wasm_bindgen]
pub struct Clustering {
    points: Points,
    parameters: DbscanParameters,
}

#[wasm_bindgen]
impl Clustering {
    /// Makes the cloud of this name; one of that name must be there.
    #[wasm_bindgen(constructor)]
    pub fn new(cloud: &str, points: usize) -> Self {
        let cloud = Cloud::named(cloud).unwrap_or(Cloud::Resting);
        Self { points: cloud.points(points, 3), parameters: cloud.parameters(points, 3) }
    }

    /// Clusters it and gives the number of labels.
    pub fn run(&self) -> usize {
        dbscan(&self.points, self.parameters).len()
    }
}

/// A CSV file, ready to be read.
#[wasm_bindgen]
pub struct Reading {
    file: File,
}

#[wasm_bindgen]
impl Reading {
    /// Makes a file of so many megabytes.
    #[wasm_bindgen(constructor)]
    pub fn new(megabytes: usize) -> Self {
        Self { file: one_file(megabytes) }
    }

    /// Reads it and gives the number of demonstrations.
    pub fn run(&self) -> usize {
        read_digested(&self.file).map_or(0, |demonstrations| demonstrations.len())
    }
}
