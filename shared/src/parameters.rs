//! Clustering parameters chosen from the data alone.

mod places;
mod spanning_tree;

use crate::dbscan::DbscanParameters;
use crate::rest::{Kind, SubsetStays};
use places::cut;
use spanning_tree::spanning_tree;

/// Chooses `epsilon` and `min_points` for the frames at rest of a subset, such that the rests of one place are one
/// cluster and those of different places are not.
///
/// Rests are joined to a minimum spanning tree, which is cut wherever the two sides lie apart by far more than each is
/// spread: people put a thing down at one place within some scatter, and different places differ by a multiple of it.
/// Epsilon is then between the longest edge that stays and the shortest one that is cut, with room for the sensor noise.
///
/// # Complexity
///
/// O(R log² R) for R rests in all demonstrations, in few features.
pub fn choose_parameters(stays: &SubsetStays, dimension: usize) -> DbscanParameters {
    let rests = rests(stays);
    let edges = spanning_tree(dimension, &rests.iter().map(|rest| rest.center).collect::<Vec<_>>());
    let kept = cut(&rests, &edges, stays);
    let heap = stays.scales.heap_radius(dimension);
    let within = kept.longest_kept.max(heap);
    let between = kept.shortest_between - 2.0 * heap;
    let epsilon = if between > within { (within * between).sqrt().min(1.5 * within) } else { within };
    DbscanParameters {
        epsilon: round_up(epsilon),
        min_points: (kept.fewest_frames / 2).clamp((dimension + 1).min(5), 20),
    }
}

/// A rest: where, and in which demonstration.
struct Rest<'a> {
    center: &'a [f64],
    demonstration: usize,
    frames: usize,
    is_left_alone: bool,
}

fn rests(stays: &SubsetStays) -> Vec<Rest<'_>> {
    let mut rests = Vec::new();
    for (demonstration, stays) in stays.demonstrations.iter().enumerate() {
        let at_rest = stays.iter().filter(|stay| stay.kind.is_rest());
        rests.extend(at_rest.map(|stay| Rest {
            center: &stay.dwell.center,
            demonstration,
            frames: stay.dwell.span.len(),
            is_left_alone: stay.kind == Kind::LeftAlone,
        }));
    }
    rests
}

/// Rounds up to three significant decimal digits: nobody reads more. Above zero whatever comes in.
fn round_up(value: f64) -> f64 {
    if !(value > 0.0 && value.is_finite()) {
        return 1e-6;
    }
    let mut unit = 1.0;
    while value / unit >= 1000.0 {
        unit *= 10.0;
    }
    while value / unit < 100.0 && unit > 1e-12 {
        unit /= 10.0;
    }
    // Multiplying by a negative power of ten would leave digits behind; dividing by its inverse does not.
    let steps = (value / unit).ceil();
    if unit < 1.0 { steps / (1.0 / unit).round() } else { steps * unit }
}
