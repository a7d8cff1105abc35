//! The last stage: from what was found in every subset to the specification.

use super::alphabet::Alphabet;
use super::subset_study::Found;
use super::{InferRequest, Inference};
use crate::demonstration::Demonstration;
use crate::pdfa::{Pdfa, Word};
use crate::specification::{DemonstrationWord, Specification};

/// The specification that follows from what was `found` in every subset, in their order: alphabet, words and automaton.
///
/// # Complexity
///
/// O(F log F + F · A) for F frames in which any of the A sub-goals holds.
pub fn conclude(demonstrations: &[Demonstration], request: &InferRequest, found: &[&Found]) -> Inference {
    let mut alphabet = Alphabet::default();
    for found in found {
        alphabet.add_subset(found);
    }
    let completions = (0..demonstrations.len()).map(|index| alphabet.completions(index));
    let (words, completed): (Vec<Word>, Vec<Vec<usize>>) =
        completions.map(|completions| completions.into_iter().unzip()).unzip();
    let specification = Specification {
        name: request.name.clone(),
        semantics: request.semantics,
        features: demonstrations.first().map_or_else(Vec::new, |first| first.features().to_vec()),
        subsets: found.iter().map(|found| found.search.parameters.clone()).collect(),
        sub_goals: alphabet.sub_goals,
        pdfa: Pdfa::from_words(&words),
        demonstrations: demonstrations.iter().zip(words).map(demonstrated).collect(),
    };
    let eliminated = found.iter().flat_map(|found| found.search.eliminated.iter().cloned()).collect();
    let notes = found.iter().flat_map(|found| notes(found, demonstrations.len())).collect();
    Inference { specification, completed, eliminated, notes }
}

fn demonstrated((demonstration, word): (&Demonstration, Word)) -> DemonstrationWord {
    DemonstrationWord {
        name: demonstration.name().to_owned(),
        sha256: demonstration.sha256().to_owned(),
        frames: demonstration.frames(),
        word,
    }
}

/// What an expert should know about a subset in which nothing was found.
fn notes(found: &Found, demonstrations: usize) -> Vec<String> {
    let name = &found.search.parameters.name;
    let mut notes = Vec::new();
    if found.unobserved > 0 {
        let unobserved = found.unobserved;
        notes.push(format!("{name} is never observed in {unobserved} of {demonstrations} demonstrations"));
    }
    if found.search.found.is_empty() && found.unobserved < demonstrations {
        notes.push(match found.search.eliminated.len() {
            0 => format!("{name} comes to rest nowhere but where it starts: no sub-goal"),
            count => format!("{name} has no sub-goal: all {count} clusters are eliminated"),
        });
    }
    notes
}
