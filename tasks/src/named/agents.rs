//! Agents that place nothing: they stop at poses by intention.

use super::{object, on_the_table, order, site};
use crate::layout::Layout;
use crate::manner::{Route, Timing};
use crate::task::Task;

/// A drone that visits three places, stopping for about two seconds at each, in four orders.
///
/// One subset, `drone`; in metres. All four words are there from four demonstrations on.
pub fn drone(seed: u64, demonstrations: usize) -> Task {
    let layout = Layout {
        objects: vec![object("drone", [0.0, 0.0, 0.1], 0.3)],
        sites: vec![
            site("window", 0, [2.5, -1.0, 1.5]),
            site("shelf", 0, [1.5, 1.5, 1.0]),
            site("door", 0, [3.5, 1.0, 1.2]),
        ],
        orders: vec![order(5, &[0, 1, 2]), order(3, &[0, 2, 1]), order(2, &[1, 0, 2]), order(2, &[2, 1, 0])],
    };
    let mut recipe = on_the_table("drone", layout, demonstrations);
    recipe.description = format!("drone: {demonstrations} flights");
    recipe.manner.route = Route::Arc;
    recipe.manner.speed = (0.7, 1.0);
    recipe.manner.lift = 0.3;
    recipe.manner.jitter = 0.01;
    recipe.manner.is_airborne = true;
    recipe.manner.clearance = 0.3;
    recipe.manner.timing = Timing { lead: (0.5, 1.0), dwell: (1.6, 2.4), tail: (1.5, 2.0) };
    recipe.sensing.noise = 0.003;
    recipe.record(seed)
}

/// A two-jointed arm that goes through three poses clockwise or counter-clockwise and ends in the same fourth.
///
/// One subset, `arm` with the joint angles `arm.q1` and `arm.q2` in radians; two words, six demonstrations in ten
/// clockwise.
pub fn arm(seed: u64, demonstrations: usize) -> Task {
    let layout = Layout {
        objects: vec![object("arm", [0.6, 0.1, 0.0], 0.05)],
        sites: vec![
            site("left", 0, [-0.1, 0.9, 0.0]),
            site("up", 0, [0.6, 1.7, 0.0]),
            site("right", 0, [1.3, 0.9, 0.0]),
            site("center", 0, [0.6, 0.9, 0.0]),
        ],
        orders: vec![order(3, &[0, 1, 2, 3]), order(2, &[2, 1, 0, 3])],
    };
    let mut recipe = on_the_table("arm", layout, demonstrations);
    recipe.description = format!("arm: {demonstrations} motions");
    recipe.manner.route = Route::Straight;
    recipe.manner.speed = (0.6, 0.9);
    recipe.manner.jitter = 0.005;
    recipe.manner.is_airborne = true;
    recipe.manner.clearance = 0.15;
    recipe.sensing.noise = 0.002;
    recipe.notation =
        crate::recipe::Notation { separator: ".", axes: &["q1", "q2"], unit: crate::task::Unit::Radian };
    recipe.record(seed)
}
