//! From demonstrations to a specification: the whole pipeline.

mod alphabet;
mod cleaning;
mod conclusion;
mod from_words;
mod keys;
mod objections;
mod reading;
mod study;
mod subset_study;
mod track_study;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::demonstration::Demonstration;
use crate::pdfa::Semantics;
use crate::specification::Specification;
use crate::subset::SubsetRequest;

pub use crate::sub_goal::{Eliminated, Method, RadiusRule};
pub use conclusion::conclude;
pub use from_words::infer_words;
pub use keys::{DemonstrationKey, DemonstrationKeys};
pub use objections::requested_subsets;
pub use reading::read_words;
pub use study::Study;
pub use subset_study::{Found, Seen, SubsetStudy, tell};

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
/// O(n log n) for n observed partial states of few features where things rest, at places that demonstrations share or
/// not, and O(n · A) to see where A sub-goals hold. In many features, and without heaps, what
/// [`find_sub_goals`](crate::sub_goal::find_sub_goals) takes; and per demonstration the product of the numbers of dwells
/// of two subsets, as in [`stays`](crate::rest::stays).
pub fn infer(
    demonstrations: &[Demonstration],
    request: &InferRequest,
    progress: &mut dyn FnMut(&Progress),
) -> Result<Inference, InferError> {
    Study::default().infer(demonstrations, request, progress)
}
