//! Tasks of which everything is drawn.

mod description;
mod knobs;
mod names;
mod scene;
mod space;

use crate::chance::Chance;
use crate::recipe::Recipe;
use crate::task::Task;
use knobs::{Kind, Knobs};

/// A task of which everything is drawn: what moves, where to, in which orders, how, and how well it is seen.
///
/// Never drawn is what would hide the truth: a true rest lasts at least 0.6 s and 4 frames, and 4 of these are seen
/// before the next thing is placed; places of one subset are at least 2.5 cm and six times the noise and jitter apart
/// (0.25 rad for an arm); nothing starts near a place of its own; each place is visited by two demonstrations or
/// more. A thing may pass quickly through places of its own, also through such as it is put at only later: the word is
/// the order of coming to rest. [`Task::description`] tells what was drawn.
pub fn random_task(seed: u64) -> Task {
    let mut chance = Chance::new(seed, 0);
    let kind = Kind::draw(&mut chance);
    let knobs = Knobs::draw(kind, &mut chance);
    let layout = scene::draw(&knobs, &mut chance);
    let recipe = Recipe {
        name: format!("random-{seed}"),
        description: knobs.description(seed, &layout),
        layout,
        manner: knobs.manner,
        sensing: knobs.sensing,
        notation: knobs.notation,
        demonstrations: knobs.demonstrations,
    };
    recipe.record(seed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::distance;

    #[test]
    fn places_and_starts_keep_the_distance_that_noise_and_jitter_ask_for() {
        for seed in 0..500 {
            let mut chance = Chance::new(seed, 0);
            let knobs = Knobs::draw(Kind::draw(&mut chance), &mut chance);
            let layout = scene::draw(&knobs, &mut chance);
            for (index, site) in layout.sites.iter().enumerate() {
                let start = layout.objects[site.object].start;
                assert!(distance(start, site.center) >= 0.05 * knobs.scale, "seed {seed}");
                for other in &layout.sites[..index] {
                    let apart = distance(site.center, other.center);
                    let is_enough = apart >= knobs.separation - 1e-9;
                    assert!(other.object != site.object || is_enough, "{apart} m, seed {seed}");
                }
            }
        }
    }
}
