//! The specification: everything that is approved and handed to a robot, and its file format.
//!
//! [`Specification::to_json`] and [`Specification::from_json`] are the file `*.goalgraph.json`; its shape is in [`file`].

mod check;
mod file;
mod validate;

use serde::{Deserialize, Serialize};

use crate::demonstration::Feature;
use crate::pdfa::{Pdfa, Semantics, Symbol, Word};
use crate::points::distance;

pub use check::{Place, Problem, ProblemKind, Severity};
#[cfg(feature = "schema")]
pub use file::json_schema;
pub use file::{ReadError, SpecificationFile};

/// How many colors an expert can choose from for a sub-goal: the page's palette.
pub const COLORS: u8 = 8;

/// A task: its features, sub-goals, the words of its demonstrations and the automaton over them.
#[derive(Clone, Debug, PartialEq)]
pub struct Specification {
    /// What the task is called.
    pub name: String,
    /// How weights are read as probabilities.
    pub semantics: Semantics,
    /// The features that demonstrations of the task have.
    pub features: Vec<Feature>,
    /// The feature subsets in which sub-goals were searched.
    pub subsets: Vec<SubsetParameters>,
    /// The alphabet, in its order.
    pub sub_goals: Vec<SubGoal>,
    /// The automaton.
    pub pdfa: Pdfa,
    /// What was demonstrated.
    pub demonstrations: Vec<DemonstrationWord>,
}

/// A feature subset with the parameters that its sub-goals were found with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SubsetParameters {
    /// What the subset is called, such as the object that its features describe.
    pub name: String,
    /// Names of its features, in the order of a partial state's coordinates.
    pub features: Vec<String>,
    /// DBSCAN's neighborhood radius, in the unit of the features.
    pub epsilon: f64,
    /// DBSCAN's smallest neighborhood of a core point, itself included.
    pub min_points: usize,
    /// For how many observed frames a partial state stays in a ball before the sub-goal counts as reached; 1 is the
    /// published Algorithm 1.
    pub min_dwell: usize,
}

/// A sub-goal: a place that a demonstration has reached once its partial state rests within the ball.
#[derive(Clone, Debug, PartialEq)]
pub struct SubGoal {
    /// Its symbol in words.
    pub id: Symbol,
    /// What people call it.
    pub name: String,
    /// The place; none when words were given instead of recordings.
    pub ball: Option<Ball>,
    /// How many frames of all demonstrations were clustered into it.
    pub frames: usize,
    /// How many demonstrations reached it.
    pub demonstrations: usize,
    /// The color that an expert has given it, below [`COLORS`]; none leaves the choice to whoever draws.
    pub color: Option<u8>,
}

/// A ball in the space of a feature subset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ball {
    /// Name of the subset.
    pub subset: String,
    /// Names of the subset's features, one per coordinate.
    pub features: Vec<String>,
    /// Center, one coordinate per feature, in the unit of the features.
    pub center: Vec<f64>,
    /// Radius in the unit of the features.
    pub radius: f64,
}

impl Ball {
    /// Whether `point` (one coordinate per feature) is in the ball, its surface included. An undefined (NaN) coordinate
    /// is in no ball.
    pub fn contains(&self, point: &[f64]) -> bool {
        point.len() == self.center.len() && distance(&self.center, point) <= self.radius
    }
}

/// A demonstration as the specification remembers it.
#[derive(Clone, Debug, PartialEq)]
pub struct DemonstrationWord {
    /// Its name.
    pub name: String,
    /// Hexadecimal SHA-256 of its file.
    pub sha256: String,
    /// How many frames it has; zero when only its word was given.
    pub frames: usize,
    /// The sub-goals that it completed, in order.
    pub word: Word,
}

impl Specification {
    /// The sub-goal with the symbol `id`.
    pub fn sub_goal(&self, id: Symbol) -> Option<&SubGoal> {
        self.sub_goals.iter().find(|sub_goal| sub_goal.id == id)
    }

    /// Name of the sub-goal `id`; its id when there is no such sub-goal.
    pub fn name_of(&self, id: Symbol) -> String {
        self.sub_goal(id).map_or_else(|| id.to_string(), |sub_goal| sub_goal.name.clone())
    }
}
