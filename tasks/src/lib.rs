//! Recorded robot-demonstration tasks whose truth is known, for tests, samples and benchmarks.
//!
//! ```text
//! Layout (objects, places, orders) -perform-> true frames -sense-> Recording -collect-> Task
//!         Manner (how the hand moves) -^          ^- Sensing (noise, wild detections, occlusion)
//! ```
//!
//! The same seed gives the same bytes on every machine: the only source of chance is `ChaCha8`, and the
//! arithmetic is limited to what IEEE 754 fixes (`+ - * /` and the square root).
//!
//! ```
//! let task = goalgraph_tasks::tower(1, 9);
//! assert_eq!(task.places.len(), 3);
//! assert!(task.csv(0).starts_with("red.x,red.y,red.z,yellow.x"));
//! ```

mod task;

mod chance;
mod geometry;
mod layout;
mod orders;

mod manner;
mod motion;
mod perform;
mod stage;

mod recipe;
mod sensing;

mod named;
mod random;

mod csv;

mod other_hand;

mod clouds;
mod shuffled_words;

pub use clouds::{
    FRAMES_OF_A_DEMONSTRATION, resting_points, scattered_rests, shuffled_blobs, uniform_points,
};
pub use named::{arm, drone, four_blocks, four_places, rebuilt_stack, tower, two_stacks};
pub use other_hand::held_out_task;
pub use random::random_task;
pub use shuffled_words::shuffled_words;
pub use task::{Place, Recording, Rest, Task, TrueSubset, Unit};
