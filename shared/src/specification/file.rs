//! The file `*.goalgraph.json`: the one place where the specification's outer shape is written down.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{DemonstrationWord, Specification, SubGoal, SubsetParameters};
use crate::demonstration::Feature;
use crate::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition};

const FORMAT: &str = "goalgraph-specification";
const VERSION: u32 = 1;

/// How far a written probability may be from the one that the weights give.
pub(super) const PROBABILITY_TOLERANCE: f64 = 1e-4;

/// Why bytes are no specification.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReadError {
    /// The text is no JSON, or not of this shape.
    #[error("line {line}, column {column}: {message}")]
    Json {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What was found and expected.
        message: String,
    },
    /// It is another kind of file.
    #[error("format: {found:?} instead of {FORMAT:?}")]
    Format {
        /// What the file says it is.
        found: String,
    },
    /// It is of a version that this program does not know.
    #[error("version: {found}, but this program reads version {VERSION}")]
    Version {
        /// The version that the file says.
        found: u32,
    },
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
    pub(super) format: String,
    pub(super) version: u32,
    pub(super) name: String,
    pub(super) semantics: Semantics,
    pub(super) features: Vec<Feature>,
    pub(super) subsets: Vec<SubsetEntry>,
    pub(super) sub_goals: Vec<SubGoalEntry>,
    pub(super) automaton: AutomatonEntry,
    pub(super) demonstrations: Vec<DemonstrationEntry>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct SubsetEntry {
    pub(super) name: String,
    pub(super) features: Vec<String>,
    pub(super) epsilon: Number,
    pub(super) min_points: usize,
    #[serde(default = "published_min_dwell")]
    pub(super) min_dwell: usize,
}

fn published_min_dwell() -> usize {
    1
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct SubGoalEntry {
    pub(super) id: Symbol,
    pub(super) name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) subset: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) features: Option<Vec<String>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) center: Option<Vec<Number>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) radius: Option<Number>,
    pub(super) frames: usize,
    pub(super) demonstrations: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct AutomatonEntry {
    pub(super) initial: StateId,
    pub(super) states: Vec<StateEntry>,
    pub(super) transitions: Vec<TransitionEntry>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct StateEntry {
    pub(super) id: StateId,
    pub(super) completed: Vec<Symbol>,
    pub(super) accepting: bool,
    pub(super) end_count: u64,
    pub(super) end_weight: Number,
    pub(super) final_probability: Number,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct TransitionEntry {
    pub(super) source: StateId,
    pub(super) symbol: Symbol,
    pub(super) target: StateId,
    pub(super) count: u64,
    pub(super) weight: Number,
    pub(super) probability: Number,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct DemonstrationEntry {
    pub(super) name: String,
    pub(super) sha256: String,
    pub(super) frames: usize,
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
    pub fn from_json(text: &str) -> Result<Self, ReadError> {
        let kind: Kind = serde_json::from_str(text).map_err(|error| json_error(&error))?;
        if kind.format != FORMAT {
            return Err(ReadError::Format { found: kind.format });
        }
        if kind.version != VERSION {
            return Err(ReadError::Version { found: kind.version });
        }
        let file: SpecificationFile = serde_json::from_str(text).map_err(|error| json_error(&error))?;
        file.into_specification()
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

/// What a file says of itself, read before anything else so that a file of another version is named as such.
#[derive(Deserialize)]
struct Kind {
    format: String,
    version: u32,
}

fn json_error(error: &serde_json::Error) -> ReadError {
    let text = error.to_string();
    let message = text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message);
    ReadError::Json { line: error.line(), column: error.column(), message: message.to_owned() }
}

impl From<&Specification> for SpecificationFile {
    fn from(specification: &Specification) -> Self {
        let demonstration_entry = |demonstration: &DemonstrationWord| DemonstrationEntry {
            name: demonstration.name.clone(),
            sha256: demonstration.sha256.clone(),
            frames: demonstration.frames,
            word: demonstration.word.clone(),
        };
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
            features: specification.features.clone(),
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
    }
}

fn automaton_entry(pdfa: &Pdfa, semantics: Semantics) -> AutomatonEntry {
    let probabilities = pdfa.probabilities(semantics);
    let state_entry = |(&id, state): (&StateId, &State)| StateEntry {
        id,
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
