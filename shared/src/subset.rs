//! Feature subsets: in which features together sub-goals are searched.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::demonstration::Feature;

/// A parameter that the expert fixes or leaves to the engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Setting<T> {
    /// The engine chooses from the data.
    #[default]
    Auto,
    /// This value.
    Fixed(T),
}

impl<T> Setting<T> {
    /// The fixed value, or the one that the engine has `chosen`.
    pub fn or(self, chosen: T) -> T {
        match self {
            Self::Auto => chosen,
            Self::Fixed(value) => value,
        }
    }
}

/// A feature subset in which sub-goals are to be searched.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SubsetRequest {
    /// What it is called, such as the object that its features describe.
    pub name: String,
    /// Names of its features, in the order of a partial state's coordinates.
    pub features: Vec<String>,
    /// DBSCAN's neighborhood radius, in the unit of the features.
    pub epsilon: Setting<f64>,
    /// DBSCAN's smallest neighborhood of a core point, itself included.
    pub min_points: Setting<usize>,
    /// Points, one coordinate per feature, in eliminated clusters that the expert takes for sub-goals all the same.
    #[serde(default)]
    pub restored: Vec<Vec<f64>>,
}

/// Proposes one subset per object: features that share their name up to the last `.` or `_` and an axis
/// (`red.x red.y red.z` give `red`), in the order of their first feature.
///
/// An axis is one of `x y z w`, `roll pitch yaw`, `q` or `j` with a number, or a number. A feature without an axis stays
/// alone. When no feature has an axis there is no structure: one subset `all` with every feature.
///
/// # Complexity
///
/// O(n log n) for n features.
///
/// # Example
///
/// ```
/// use goalgraph::demonstration::Feature;
/// use goalgraph::subset::propose_subsets;
///
/// let features = ["red.x", "red.y", "blue.x", "blue.y"].map(Feature::new);
/// let names: Vec<String> = propose_subsets(&features).into_iter().map(|subset| subset.name).collect();
/// assert_eq!(names, ["red", "blue"]);
/// ```
pub fn propose_subsets(features: &[Feature]) -> Vec<SubsetRequest> {
    let subset = |name: &str, features: Vec<String>| SubsetRequest {
        name: name.to_owned(),
        features,
        ..SubsetRequest::default()
    };
    if features.iter().all(|feature| object_of(&feature.name).is_none()) {
        return vec![subset("all", features.iter().map(|feature| feature.name.clone()).collect())];
    }
    let mut subsets: Vec<SubsetRequest> = Vec::new();
    let mut position = BTreeMap::new();
    for feature in features {
        let object = object_of(&feature.name).unwrap_or(&feature.name);
        let index = *position.entry(object).or_insert(subsets.len());
        match subsets.get_mut(index) {
            Some(known) => known.features.push(feature.name.clone()),
            None => subsets.push(subset(object, vec![feature.name.clone()])),
        }
    }
    subsets
}

/// What stands before the axis of a feature name.
fn object_of(name: &str) -> Option<&str> {
    let (object, axis) = name.rsplit_once(['.', '_'])?;
    (!object.is_empty() && is_axis(axis)).then_some(object)
}

fn is_axis(text: &str) -> bool {
    let text = text.to_ascii_lowercase();
    let named =
        ["x", "y", "z", "w", "qx", "qy", "qz", "qw", "rx", "ry", "rz", "roll", "pitch", "yaw", "theta"];
    let number = text.strip_prefix(['q', 'j']).unwrap_or(&text);
    named.contains(&text.as_str()) || (!number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn proposed(names: &[&str]) -> Vec<(String, Vec<String>)> {
        let features: Vec<Feature> = names.iter().map(|name| Feature::new(*name)).collect();
        propose_subsets(&features).into_iter().map(|subset| (subset.name, subset.features)).collect()
    }

    fn subset(name: &str, features: &[&str]) -> (String, Vec<String>) {
        (name.to_owned(), features.iter().map(|&feature| feature.to_owned()).collect())
    }

    #[test]
    fn features_that_share_a_prefix_up_to_the_axis_are_one_object() {
        let expected =
            [subset("red", &["red.x", "red.y"]), subset("left_arm", &["left_arm_q1", "left_arm_q2"])];
        assert_eq!(proposed(&["red.x", "left_arm_q1", "red.y", "left_arm_q2"]), expected);
    }

    #[test]
    fn a_feature_without_an_axis_stays_alone_among_objects() {
        let expected = [subset("red", &["red_x", "red_y"]), subset("door_open", &["door_open"])];
        assert_eq!(proposed(&["red_x", "door_open", "red_y"]), expected);
    }

    #[test]
    fn without_structure_there_is_one_subset_of_everything() {
        assert_eq!(proposed(&["height", "speed"]), [subset("all", &["height", "speed"])]);
        assert_eq!(proposed(&["x", "y"]), [subset("all", &["x", "y"])]);
        assert_eq!(proposed(&[]), [subset("all", &[])]);
    }
}
