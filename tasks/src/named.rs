//! The tasks that everybody knows, recorded by a steady hand and a good camera.

mod agents;
mod blocks;
mod cubes;

pub use agents::{arm, drone};
pub use blocks::{four_blocks, tower, two_stacks};
pub use cubes::{four_places, rebuilt_stack};

use crate::geometry::Point;
use crate::layout::{Layout, Object, Order, Site};
use crate::manner::{Hesitation, Manner, Route, Timing};
use crate::motion::Profile;
use crate::recipe::{Notation, Recipe};
use crate::sensing::Sensing;
use crate::task::Unit;

/// Blocks on a table: metres, 20 Hz, 0.7 mm of noise, put down within 2 mm, start places that vary by 4 cm.
fn on_the_table(name: &str, layout: Layout, demonstrations: usize) -> Recipe {
    Recipe {
        name: name.to_owned(),
        description: format!("{name}: {demonstrations} demonstrations on the table"),
        layout,
        manner: Manner {
            rate_hz: 20.0,
            route: Route::Bridge,
            profile: Profile::MinimumJerk,
            speed: (0.25, 0.35),
            lift: 0.12,
            hesitation: Hesitation::NONE,
            pass_probability: 0.0,
            jitter: 0.002,
            is_airborne: false,
            clearance: 0.04,
            timing: Timing { lead: (0.5, 1.0), dwell: (0.8, 1.4), tail: (1.0, 1.5) },
        },
        sensing: Sensing {
            noise: 0.0007,
            wild_probability: 0.0,
            wild_reach: 0.4,
            wild_clearance: 0.08,
            occlusions_per_second: 0.02,
            longest_occlusion: 0.4,
        },
        notation: Notation { separator: ".", axes: &["x", "y", "z"], unit: Unit::Metre },
        demonstrations,
    }
}

fn object(name: &str, start: Point, start_reach: f64) -> Object {
    Object { name: name.to_owned(), start, start_reach }
}

fn site(name: &str, object: usize, center: Point) -> Site {
    Site { name: name.to_owned(), object, center }
}

fn order(preference: usize, word: &[usize]) -> Order {
    Order { word: word.to_vec(), preference }
}
