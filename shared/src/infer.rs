//! From demonstrations to a specification: the whole pipeline.

mod alphabet;
mod from_words;
mod objections;
mod reading;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::demonstration::Demonstration;
use crate::parallel;
use crate::pdfa::{Pdfa, Semantics, Word};
use crate::specification::{DemonstrationWord, Specification};
use crate::sub_goal::{SubGoalSearch, find_sub_goals};
use crate::subset::{SubsetRequest, propose_subsets};
use alphabet::Alphabet;
use objections::{check_same_features, check_subsets};
use reading::Reading;

pub use crate::sub_goal::{Eliminated, Method, RadiusRule};
pub use from_words::infer_words;
pub use reading::read_words;

/// What to infer and how.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InferRequest {
    /// What the task is called.
    pub name: String,
    /// The feature subsets; when there are none, those of [`propose_subsets`].
    pub subsets: Vec<SubsetRequest>,
    /// How weights are read as probabilities.
    pub semantics: Semantics,
    /// Which frames are clustered.
    pub method: Method,
    /// How large balls are.
    pub radius: RadiusRule,
}

/// What came out: the specification, and what was found on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Inference {
    /// The learned specification.
    pub specification: Specification,
    /// For each demonstration the frames in which the symbols of its word were completed, in their order; none where
    /// only words were given.
    pub completed: Vec<Vec<usize>>,
    /// Clusters that are no sub-goals, with the reason.
    pub eliminated: Vec<Eliminated>,
    /// Clear sentences on what an expert should know: nothing found in a subset, a subset never observed.
    pub notes: Vec<String>,
}

/// How far the inference is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// What is being done, such as `Clustering red`.
    pub stage: String,
    /// Steps done.
    pub done: usize,
    /// Steps in all.
    pub total: usize,
}

/// Why nothing can be inferred.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum InferError {
    /// There are no demonstrations.
    #[error("there are no demonstrations")]
    NoDemonstrations,
    /// A demonstration has other features than the first.
    #[error("{name}: its features are not those of {first}: {difference}")]
    DifferentFeatures {
        /// The demonstration.
        name: String,
        /// The first demonstration.
        first: String,
        /// A feature that only one of them has.
        difference: String,
    },
    /// A subset names a feature that is not there.
    #[error("subset {subset}: there is no feature {feature:?}; there are: {known}")]
    UnknownFeature {
        /// The subset.
        subset: String,
        /// The feature it names.
        feature: String,
        /// The features that there are.
        known: String,
    },
    /// A subset cannot be searched.
    #[error("subset {subset}: {message}")]
    Subset {
        /// The subset.
        subset: String,
        /// What is wrong.
        message: String,
    },
}

/// Infers a specification from demonstrations, which must have the same features (in any order).
///
/// The result is valid whatever is found: a subset that is never observed or shows no sub-goal is said in the notes, and
/// without any sub-goal the automaton is its initial state, where every demonstration ends.
///
/// # Errors
///
/// When there are no demonstrations, their features differ, or a subset is no subset of the features.
///
/// # Complexity
///
/// O(n log n) in the observed partial states where things rest in heaps; see [`crate::dbscan::dbscan`].
pub fn infer(
    demonstrations: &[Demonstration],
    request: &InferRequest,
    progress: &mut dyn FnMut(&Progress),
) -> Result<Inference, InferError> {
    let first = demonstrations.first().ok_or(InferError::NoDemonstrations)?;
    check_same_features(demonstrations)?;
    let features = first.features();
    let subsets =
        if request.subsets.is_empty() { propose_subsets(features) } else { request.subsets.clone() };
    check_subsets(&subsets, features)?;
    let total = 3;
    let mut report = |stage: String, done: usize| progress(&Progress { stage, done, total });

    report("Looking for rests".to_owned(), 0);
    let parts: Vec<(&str, &[String])> =
        subsets.iter().map(|subset| (subset.name.as_str(), subset.features.as_slice())).collect();
    let reading = Reading::new(demonstrations, &parts, request.method);

    report(clustering(&subsets), 1);
    let searches = parallel::map(subsets.len(), |index| {
        let (recording, stays) = reading.subset(index);
        find_sub_goals(recording, stays, &subsets[index], request.radius)
    });
    report("Reading words".to_owned(), 2);
    let notes = notes(&reading, &searches);
    let mut eliminated = Vec::new();
    let (mut parameters, mut alphabet) = (Vec::new(), Alphabet::default());
    for (index, search) in searches.into_iter().enumerate() {
        alphabet.add_subset(&reading, index, search.found);
        eliminated.extend(search.eliminated);
        parameters.push(search.parameters);
    }
    let completions = (0..demonstrations.len()).map(|index| alphabet.completions(index));
    let (words, completed): (Vec<Word>, Vec<Vec<usize>>) =
        completions.map(|completions| completions.into_iter().unzip()).unzip();
    let specification = Specification {
        name: request.name.clone(),
        semantics: request.semantics,
        features: features.to_vec(),
        subsets: parameters,
        sub_goals: alphabet.sub_goals,
        pdfa: Pdfa::from_words(&words),
        demonstrations: demonstrations.iter().zip(words).map(demonstrated).collect(),
    };
    report("Done".to_owned(), total);
    Ok(Inference { specification, completed, eliminated, notes })
}

/// What is clustered, as a stage of the progress.
fn clustering(subsets: &[SubsetRequest]) -> String {
    match subsets {
        [only] => format!("Clustering {}", only.name),
        _ => format!("Clustering {} subsets", subsets.len()),
    }
}

fn demonstrated((demonstration, word): (&Demonstration, Word)) -> DemonstrationWord {
    DemonstrationWord {
        name: demonstration.name().to_owned(),
        sha256: demonstration.sha256().to_owned(),
        frames: demonstration.frames(),
        word,
    }
}

/// What an expert should know about subsets in which nothing was found.
fn notes(reading: &Reading, searches: &[SubGoalSearch]) -> Vec<String> {
    let mut notes = Vec::new();
    for (index, search) in searches.iter().enumerate() {
        let (recording, _) = reading.subset(index);
        let unobserved = recording.tracks.iter().filter(|track| track.is_empty()).count();
        let all = recording.tracks.len();
        if unobserved > 0 {
            notes.push(format!(
                "{} is never observed in {unobserved} of {all} demonstrations",
                recording.name
            ));
        }
        if search.found.is_empty() && unobserved < all {
            notes.push(match search.eliminated.len() {
                0 => format!("{} comes to rest nowhere but where it starts: no sub-goal", recording.name),
                count => format!("{} has no sub-goal: all {count} clusters are eliminated", recording.name),
            });
        }
    }
    notes
}
