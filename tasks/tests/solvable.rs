//! That a person could find the truth of every random task.

use goalgraph_tasks::{Recording, Task, random_task};

/// Longest stay, in seconds, near a place of the same thing, apart from the rests at that place.
///
/// A stay goes on over undefined frames and one or two wild detections; one that touches a rest there (a hand that hovers above it, recorded without
/// z) belongs to the rest.
fn longest_false_rest(task: &Task, demonstration: &Recording, place: usize) -> f64 {
    let columns = task.columns(&task.places[place].subset);
    let center = &task.places[place].center;
    let radius = task.separation().unwrap_or(f64::INFINITY) / 2.0;
    let radius = radius.min(0.02 * task.unit.per_base());
    let rests = demonstration.rests.iter().filter(|rest| rest.place == place);
    let is_rest = |frame: usize| rests.clone().any(|rest| rest.frames.contains(&frame));
    let (mut longest, mut stay, mut is_false, mut outside) = (0_u32, 0, true, 0);
    for (index, frame) in demonstration.frames.iter().enumerate() {
        let point = &frame[columns.clone()];
        let squares = point.iter().zip(center).map(|(a, b)| (a - b) * (a - b));
        let distance = squares.sum::<f64>().sqrt();
        if distance > radius {
            outside += 1;
            if outside == 3 {
                longest = longest.max(if is_false { stay } else { 0 });
                (stay, is_false) = (0, true);
            }
        } else if distance <= radius {
            stay += 1;
            outside = 0;
            is_false &= !is_rest(index);
        }
    }
    f64::from(longest) / task.rate_hz
}

#[test]
fn nothing_lingers_where_it_is_not_put() {
    for seed in 0..200 {
        let task = random_task(seed);
        for demonstration in &task.demonstrations {
            for place in 0..task.places.len() {
                let seconds = longest_false_rest(&task, demonstration, place);
                let name = &task.places[place].name;
                assert!(
                    seconds < 0.6,
                    "{seconds:.2} s at {name} in {}, {}",
                    demonstration.name,
                    task.description
                );
            }
        }
    }
}
