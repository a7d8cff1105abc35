//! The file `*.goalgraph.json`: the one place where the specification's outer shape is written down.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{DemonstrationWord, Specification, SubGoal, SubsetParameters};
use crate::demonstration::Feature;
use crate::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition};
use crate::versioned::{VersionedError, read_versioned};

const FORMAT: &str = "goalgraph-specification";
const VERSION: u32 = 1;

/// How far a written probability may be from the one that the weights give.
pub(super) const PROBABILITY_TOLERANCE: f64 = 1e-4;

/// Why bytes are no specification.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReadError {
    /// It is no JSON of this shape, or of another format or version.
    #[error(transparent)]
    Versioned(#[from] VersionedError),
    /// It contradicts itself.
    #[error("{place}: {message}")]
    Contradiction {
        /// Where, as a path into the file.
        place: String,
        /// What is wrong.
        message: String,
    },
}

pub(super) fn contradiction(place: impl Into<String>, message: impl Into<String>) -> ReadError {
    ReadError::Contradiction { place: place.into(), message: message.into() }
}

/// A Goalgraph specification: a task as sub-goals and a probabilistic automaton over them.
//
// Field by field in the order in which they are written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SpecificationFile {
    /// What kind of file this is.
    #[cfg_attr(feature = "schema", schemars(extend("const" = FORMAT)))]
    pub(super) format: String,
    /// Version of the format.
    #[cfg_attr(feature = "schema", schemars(extend("const" = VERSION)))]
    pub(super) version: u32,
    /// What the task is called.
    pub(super) name: String,
    /// How weights are read as probabilities.
    pub(super) semantics: Semantics,
    /// The features that demonstrations of the task have, in the order of the columns; names are unique.
    pub(super) features: Vec<FeatureEntry>,
    /// The feature subsets in which sub-goals were searched; names are unique.
    pub(super) subsets: Vec<SubsetEntry>,
    /// The alphabet, in its order; ids are unique.
    pub(super) sub_goals: Vec<SubGoalEntry>,
    /// The automaton.
    pub(super) automaton: AutomatonEntry,
    /// What was demonstrated.
    pub(super) demonstrations: Vec<DemonstrationEntry>,
}

/// One measured quantity of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "Feature"))]
#[serde(deny_unknown_fields)]
pub(super) struct FeatureEntry {
    /// Name of the column.
    pub(super) name: String,
    /// Unit of its values, such as `m`; left out where the recording names none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) unit: Option<String>,
}

/// A feature subset with the parameters that its sub-goals were found with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "Subset"))]
#[serde(deny_unknown_fields)]
pub(super) struct SubsetEntry {
    /// What the subset is called, such as the object that its features describe.
    pub(super) name: String,
    /// Names of its features, at least one, each once.
    pub(super) features: Vec<String>,
    /// DBSCAN's neighborhood radius, in the unit of the features; not below 0.
    pub(super) epsilon: Number,
    /// DBSCAN's smallest neighborhood of a core point, itself included.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub(super) min_points: usize,
    /// For how many observed frames a partial state stays in a ball before the sub-goal counts as reached; 1, the
    /// published method, when it is left out.
    #[serde(default = "published_min_dwell")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub(super) min_dwell: usize,
}

fn published_min_dwell() -> usize {
    1
}

/// A sub-goal. `subset`, `features`, `center` and `radius` are its place: all four are there, or none when the
/// specification was inferred from words alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "SubGoal"))]
#[serde(deny_unknown_fields)]
pub(super) struct SubGoalEntry {
    /// Its symbol in words.
    pub(super) id: Symbol,
    /// What people call it.
    pub(super) name: String,
    /// Name of the subset that reaches it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) subset: Option<String>,
    /// The features of the subset, one per coordinate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) features: Option<Vec<String>>,
    /// Center of the ball, one coordinate per feature, in the unit of the features.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) center: Option<Vec<Number>>,
    /// Radius of the ball, its surface included, in the unit of the features; not below 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) radius: Option<Number>,
    /// How many frames of all demonstrations were clustered into it.
    pub(super) frames: usize,
    /// How many demonstrations reached it.
    pub(super) demonstrations: usize,
    /// Number of its color in the palette, below 8; chosen by whoever draws when it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(max = 7)))]
    pub(super) color: Option<u8>,
}

/// The probabilistic deterministic finite automaton.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "Automaton"))]
#[serde(deny_unknown_fields)]
pub(super) struct AutomatonEntry {
    /// Where every word starts.
    pub(super) initial: StateId,
    /// The states; ids are unique.
    pub(super) states: Vec<StateEntry>,
    /// The transitions, at most one per source and symbol.
    pub(super) transitions: Vec<TransitionEntry>,
}

/// A set of completed sub-goals.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "State"))]
#[serde(deny_unknown_fields)]
pub(super) struct StateEntry {
    /// Its id; never reused.
    pub(super) id: StateId,
    /// What an expert calls it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) name: Option<String>,
    /// The sub-goals that are completed here, each once.
    pub(super) completed: Vec<Symbol>,
    /// Whether the task may end here.
    pub(super) accepting: bool,
    /// How many words ended here: evidence, never edited.
    pub(super) end_count: u64,
    /// What decides the final probability, from 0 to 1e100; equal to `end_count` until an expert reweights.
    pub(super) end_weight: Number,
    /// Probability of ending here, as the weights give it under `semantics`.
    pub(super) final_probability: Number,
}

/// A way from one state to another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "Transition"))]
#[serde(deny_unknown_fields)]
pub(super) struct TransitionEntry {
    /// Where it starts.
    pub(super) source: StateId,
    /// The sub-goal that it completes.
    pub(super) symbol: Symbol,
    /// Where it leads.
    pub(super) target: StateId,
    /// How many words took it: evidence, never edited.
    pub(super) count: u64,
    /// What decides its probability, from 0 to 1e100; equal to `count` until an expert reweights.
    pub(super) weight: Number,
    /// Its probability, as the weights give it under `semantics`.
    pub(super) probability: Number,
}

/// A demonstration and the word that was read from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "Demonstration"))]
#[serde(deny_unknown_fields)]
pub(super) struct DemonstrationEntry {
    /// What it is called.
    pub(super) name: String,
    /// Hexadecimal SHA-256 of its file; empty when only its word was given.
    pub(super) sha256: String,
    /// How many frames it has; 0 when only its word was given.
    pub(super) frames: usize,
    /// The sub-goals that it completed, in order.
    pub(super) word: Vec<Symbol>,
}

/// A finite number that is written without a fraction when it has none: `6`, not `6.0`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(super) struct Number(pub(super) f64);

impl Serialize for Number {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;
        if self.0.fract() == 0.0 && self.0.abs() < LARGEST_EXACT {
            serializer.serialize_i64(self.0 as i64)
        } else {
            serializer.serialize_f64(self.0)
        }
    }
}

impl Specification {
    /// The file as text: indented JSON with a line feed at its end. Equal specifications give equal bytes.
    ///
    /// # Complexity
    ///
    /// Linear in the size of the text.
    pub fn to_json(&self) -> String {
        let file = SpecificationFile::from(self);
        // The file holds nothing that JSON cannot: no map keys but strings, no numbers that are not finite.
        let mut text = serde_json::to_string_pretty(&file).unwrap_or_default();
        text.push('\n');
        text
    }

    /// Reads a specification from the text of a file.
    ///
    /// # Errors
    ///
    /// When the text is no JSON of this shape, of another format or version, or contradicts itself: an id that is there
    /// twice or nowhere, a number out of its range, a probability other than the weights give.
    ///
    /// # Complexity
    ///
    /// O(n log n) for n bytes.
    pub fn from_json(text: &str) -> Result<Self, ReadError> {
        read_versioned::<SpecificationFile>(text, FORMAT, VERSION)?.into_specification()
    }
}

/// The JSON Schema (draft 2020-12) of the file, generated from the types above.
#[cfg(feature = "schema")]
pub fn json_schema() -> String {
    let schema = schemars::schema_for!(SpecificationFile);
    let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
    text.push('\n');
    text
}

impl From<&Specification> for SpecificationFile {
    fn from(specification: &Specification) -> Self {
        let demonstration_entry = |demonstration: &DemonstrationWord| DemonstrationEntry {
            name: demonstration.name.clone(),
            sha256: demonstration.sha256.clone(),
            frames: demonstration.frames,
            word: demonstration.word.clone(),
        };
        let feature_entry =
            |feature: &Feature| FeatureEntry { name: feature.name.clone(), unit: feature.unit.clone() };
        let subset_entry = |subset: &SubsetParameters| SubsetEntry {
            name: subset.name.clone(),
            features: subset.features.clone(),
            epsilon: Number(subset.epsilon),
            min_points: subset.min_points,
            min_dwell: subset.min_dwell,
        };
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            name: specification.name.clone(),
            semantics: specification.semantics,
            features: specification.features.iter().map(feature_entry).collect(),
            subsets: specification.subsets.iter().map(subset_entry).collect(),
            sub_goals: specification.sub_goals.iter().map(sub_goal_entry).collect(),
            automaton: automaton_entry(&specification.pdfa, specification.semantics),
            demonstrations: specification.demonstrations.iter().map(demonstration_entry).collect(),
        }
    }
}

fn sub_goal_entry(sub_goal: &SubGoal) -> SubGoalEntry {
    let ball = sub_goal.ball.as_ref();
    SubGoalEntry {
        id: sub_goal.id,
        name: sub_goal.name.clone(),
        subset: ball.map(|ball| ball.subset.clone()),
        features: ball.map(|ball| ball.features.clone()),
        center: ball.map(|ball| ball.center.iter().copied().map(Number).collect()),
        radius: ball.map(|ball| Number(ball.radius)),
        frames: sub_goal.frames,
        demonstrations: sub_goal.demonstrations,
        color: sub_goal.color,
    }
}

fn automaton_entry(pdfa: &Pdfa, semantics: Semantics) -> AutomatonEntry {
    let probabilities = pdfa.probabilities(semantics);
    let state_entry = |(&id, state): (&StateId, &State)| StateEntry {
        id,
        name: state.name.clone(),
        completed: state.completed.iter().copied().collect(),
        accepting: state.accepting,
        end_count: state.end_count,
        end_weight: Number(state.end_weight),
        final_probability: Number(probabilities.end(id)),
    };
    let transition_entry = |(source, symbol, transition): (StateId, Symbol, &Transition)| TransitionEntry {
        source,
        symbol,
        target: transition.target,
        count: transition.count,
        weight: Number(transition.weight),
        probability: Number(probabilities.transition(source, symbol)),
    };
    AutomatonEntry {
        initial: pdfa.initial,
        states: pdfa.states.iter().map(state_entry).collect(),
        transitions: pdfa.transitions().map(transition_entry).collect(),
    }
}
