//! Generated tasks as demonstrations, and whether what was inferred is their truth.

use std::collections::BTreeMap;
use std::sync::Arc;

use goalgraph::demonstration::{Demonstration, DemonstrationError, Feature};
use goalgraph::infer::Inference;
use goalgraph::pdfa::{Pdfa, Symbol, Word};
use goalgraph::points::distance;
use goalgraph_tasks::{Place, Task};

/// The recordings of a task as the engine takes them.
pub(crate) fn demonstrations(task: &Task) -> Result<Vec<Demonstration>, DemonstrationError> {
    let features: Arc<[Feature]> = task.features.iter().map(|name| Feature::new(name.clone())).collect();
    let recordings = task.demonstrations.iter();
    recordings
        .map(|recording| {
            Demonstration::new(&*recording.name, "", features.clone(), recording.frames.concat())
        })
        .collect()
}

/// How the inference differs from the truth; `None` when sub-goals, every word and the automaton are exactly right.
///
/// A place is found when one sub-goal of its subset, and only one, is nearer to it than half the distance between any
/// two places, and every sub-goal is a place.
pub(crate) fn difference(task: &Task, inference: &Inference) -> Option<String> {
    let found = &inference.specification;
    let mut place_of: BTreeMap<Symbol, usize> = BTreeMap::new();
    for (index, place) in task.places.iter().enumerate() {
        let hits = sub_goals_at(task, place, inference);
        match hits[..] {
            [hit] => place_of.insert(hit, index),
            _ => return Some(format!("{} has {} sub-goals", place.name, hits.len())),
        };
    }
    if let Some(extra) = found.sub_goals.iter().find(|sub_goal| !place_of.contains_key(&sub_goal.id)) {
        return Some(format!("{} is no place", extra.name));
    }
    let symbol_of: BTreeMap<usize, Symbol> = place_of.into_iter().map(|(id, place)| (place, id)).collect();
    let mut words: Vec<Word> = Vec::new();
    for (recording, read) in task.demonstrations.iter().zip(&found.demonstrations) {
        let word: Word = recording.word.iter().map(|place| symbol_of[place]).collect();
        if word != read.word {
            return Some(format!("{}: {:?} instead of {word:?}", recording.name, read.word));
        }
        words.push(word);
    }
    (found.pdfa != Pdfa::from_words(&words)).then(|| "the automaton is not that of the words".to_owned())
}

fn sub_goals_at(task: &Task, place: &Place, inference: &Inference) -> Vec<Symbol> {
    let reach = task.separation().map_or(f64::INFINITY, |separation| separation / 2.0);
    let sub_goals = inference.specification.sub_goals.iter().filter(|sub_goal| {
        let ball = sub_goal.ball.as_ref();
        ball.is_some_and(|ball| ball.subset == place.subset && distance(&ball.center, &place.center) <= reach)
    });
    sub_goals.map(|sub_goal| sub_goal.id).collect()
}
