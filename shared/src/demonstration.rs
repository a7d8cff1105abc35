//! Recorded demonstrations: sequences of frames of feature values.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// One measured quantity of the scene, such as the x coordinate of the red block.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Feature {
    /// Column name, unique within a demonstration.
    pub name: String,
    /// Unit of its values where the recording names one, such as `m`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
}

impl Feature {
    /// A feature without a unit.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), unit: None }
    }
}

/// One recording of the task: `frames` x `features` values, frames in the order of time.
///
/// An undefined value (object not detected in that frame) is NaN. No value is beyond 1e100, there is at least one
/// feature and at least one frame, and feature names are unique.
///
/// Its values are never copied once they are here: clones share them.
#[derive(Clone, Debug)]
pub struct Demonstration {
    name: String,
    sha256: String,
    features: Arc<[Feature]>,
    values: Arc<Vec<f64>>,
}

/// What can be squared and summed without overflow.
pub(crate) const LARGEST_VALUE: f64 = 1e100;

/// Why values do not make a demonstration.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum DemonstrationError {
    /// There is no feature at all.
    #[error("there are no feature columns")]
    NoFeatures,
    /// There is no frame at all.
    #[error("there are no frames")]
    NoFrames,
    /// Two features have one name.
    #[error("the feature {name:?} is there twice (columns {first} and {second})")]
    DuplicateFeature {
        /// The name that both have.
        name: String,
        /// Position of the first, from 1.
        first: usize,
        /// Position of the second, from 1.
        second: usize,
    },
    /// The number of values is no multiple of the number of features.
    #[error("{values} values are no whole number of frames of {features} features")]
    Ragged {
        /// How many values there are.
        values: usize,
        /// How many features a frame has.
        features: usize,
    },
    /// A value is infinite, or too large to calculate with.
    #[error("frame {frame}: {feature} is beyond 1e100; values must be finite, or empty where undefined")]
    TooLarge {
        /// The frame, from 0.
        frame: usize,
        /// Name of the feature.
        feature: String,
    },
}

impl Demonstration {
    /// A demonstration named `name`, read from a file with the hexadecimal digest `sha256`, with `values` in row-major
    /// order: frame by frame, in each frame one value per feature.
    ///
    /// # Errors
    ///
    /// When there are no features or frames, a feature name is there twice, the last frame is incomplete, or a value
    /// is beyond 1e100.
    pub fn new(
        name: impl Into<String>,
        sha256: impl Into<String>,
        features: Arc<[Feature]>,
        values: Vec<f64>,
    ) -> Result<Self, DemonstrationError> {
        check_features(&features)?;
        if values.is_empty() {
            return Err(DemonstrationError::NoFrames);
        }
        if !values.len().is_multiple_of(features.len()) {
            return Err(DemonstrationError::Ragged { values: values.len(), features: features.len() });
        }
        let is_too_large = |value: &f64| value.abs() > LARGEST_VALUE;
        // Mostly none is: all are looked at without asking after each, and only then for the first.
        if values.iter().fold(false, |any, value| any | is_too_large(value))
            && let Some(at) = values.iter().position(is_too_large)
        {
            let feature = features[at % features.len()].name.clone();
            return Err(DemonstrationError::TooLarge { frame: at / features.len(), feature });
        }
        Ok(Self { name: name.into(), sha256: sha256.into(), features, values: Arc::new(values) })
    }

    /// What the demonstration is called: its file, and its number where the file holds several.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Hexadecimal SHA-256 of the file it was read from.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// The features, one per column.
    pub fn features(&self) -> &Arc<[Feature]> {
        &self.features
    }

    /// How many frames there are; at least one.
    pub fn frames(&self) -> usize {
        self.values.len() / self.features.len()
    }

    /// All values in row-major order: frame by frame, in each frame one value per feature.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values of frame `index`, one per feature.
    ///
    /// # Panics
    ///
    /// When `index` is not below [`Demonstration::frames`].
    pub fn frame(&self, index: usize) -> &[f64] {
        let width = self.features.len();
        &self.values[index * width..(index + 1) * width]
    }

    /// Whether `other` is this recording: a clone that shares its values, whatever it is called.
    ///
    /// # Complexity
    ///
    /// O(1): values are not compared, so two readings of one file are two recordings.
    pub fn is_same_recording(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.values, &other.values)
    }

    /// Where its values are: the same for two demonstrations that are alive exactly if they are the
    /// [same recording](Self::is_same_recording).
    pub(crate) fn address(&self) -> usize {
        Arc::as_ptr(&self.values).addr()
    }

    /// Position of the feature called `name`.
    pub fn feature_index(&self, name: &str) -> Option<usize> {
        self.features.iter().position(|feature| feature.name == name)
    }
}

/// Feature names must be there and be unique.
fn check_features(features: &[Feature]) -> Result<(), DemonstrationError> {
    if features.is_empty() {
        return Err(DemonstrationError::NoFeatures);
    }
    let mut seen = std::collections::BTreeMap::new();
    for (index, feature) in features.iter().enumerate() {
        if let Some(first) = seen.insert(feature.name.as_str(), index) {
            return Err(DemonstrationError::DuplicateFeature {
                name: feature.name.clone(),
                first: first + 1,
                second: index + 1,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn demonstration(names: &[&str], values: &[f64]) -> Result<Demonstration, DemonstrationError> {
        Demonstration::new("a", "", names.iter().map(|name| Feature::new(*name)).collect(), values.to_vec())
    }

    #[test]
    fn frames_are_rows() {
        let demonstration = demonstration(&["x", "y"], &[1.0, 2.0, 3.0, f64::NAN]).unwrap();
        assert_eq!(demonstration.frames(), 2);
        assert_eq!(demonstration.frame(0), [1.0, 2.0]);
        assert!(demonstration.frame(1)[1].is_nan());
        assert_eq!(demonstration.feature_index("y"), Some(1));
    }

    #[test]
    fn a_clone_is_the_same_recording_and_another_reading_is_not() {
        let read = || demonstration(&["x"], &[1.0, 2.0]).unwrap();
        let first = read();
        assert!(first.is_same_recording(&first.clone()));
        assert!(!first.is_same_recording(&read()));
    }

    #[test]
    fn what_is_no_demonstration_is_refused_with_the_place() {
        let message = |names: &[&str], values: &[f64]| demonstration(names, values).unwrap_err().to_string();
        assert_eq!(message(&[], &[]), "there are no feature columns");
        assert_eq!(message(&["x"], &[]), "there are no frames");
        assert_eq!(message(&["x", "y", "x"], &[]), "the feature \"x\" is there twice (columns 1 and 3)");
        assert_eq!(message(&["x", "y"], &[1.0]), "1 values are no whole number of frames of 2 features");
        assert_eq!(
            message(&["x", "y"], &[0.0, 1.0, 2.0, f64::INFINITY]),
            "frame 1: y is beyond 1e100; values must be finite, or empty where undefined"
        );
    }
}
