//! What speaks against inferring at all.

use std::collections::BTreeSet;

use super::{InferError, InferRequest};
use crate::demonstration::{Demonstration, Feature, LARGEST_VALUE};
use crate::subset::{Setting, SubsetRequest, propose_subsets};

/// The square of a smaller epsilon would lose digits.
const LEAST_EPSILON: f64 = 1e-100;

/// The subsets that `request` asks for, or those that the features propose where it names none.
///
/// # Errors
///
/// Those of [`infer`](super::infer).
pub fn requested_subsets(
    demonstrations: &[Demonstration],
    request: &InferRequest,
) -> Result<Vec<SubsetRequest>, InferError> {
    let first = demonstrations.first().ok_or(InferError::NoDemonstrations)?;
    check_same_features(demonstrations)?;
    let features = first.features();
    let subsets = match request.subsets.as_slice() {
        [] => propose_subsets(features),
        subsets => subsets.to_vec(),
    };
    check_subsets(&subsets, features)?;
    Ok(subsets)
}

/// All demonstrations must have the features of the first, in any order.
fn check_same_features(demonstrations: &[Demonstration]) -> Result<(), InferError> {
    let names = |demonstration: &Demonstration| -> BTreeSet<String> {
        demonstration.features().iter().map(|feature| feature.name.clone()).collect()
    };
    let first = names(&demonstrations[0]);
    for demonstration in &demonstrations[1..] {
        let other = names(demonstration);
        let difference = match (first.difference(&other).next(), other.difference(&first).next()) {
            (Some(missing), _) => format!("{missing:?} is missing"),
            (None, Some(added)) => format!("{added:?} is new"),
            (None, None) => continue,
        };
        let (name, first) = (demonstration.name().to_owned(), demonstrations[0].name().to_owned());
        return Err(InferError::DifferentFeatures { name, first, difference });
    }
    Ok(())
}

/// Every subset must be one of the features, with parameters that DBSCAN takes.
fn check_subsets(subsets: &[SubsetRequest], features: &[Feature]) -> Result<(), InferError> {
    let known: BTreeSet<&str> = features.iter().map(|feature| feature.name.as_str()).collect();
    let mut names = BTreeSet::new();
    for subset in subsets {
        if let Some(feature) = subset.features.iter().find(|name| !known.contains(name.as_str())) {
            let known = features.iter().map(|feature| feature.name.as_str()).collect::<Vec<_>>().join(", ");
            return Err(InferError::UnknownFeature {
                subset: subset.name.clone(),
                feature: feature.clone(),
                known,
            });
        }
        if let Some(message) = objection(subset, &mut names) {
            return Err(InferError::Subset { subset: subset.name.clone(), message });
        }
    }
    Ok(())
}

/// Why a subset cannot be searched, if it cannot.
fn objection<'a>(subset: &'a SubsetRequest, names: &mut BTreeSet<&'a str>) -> Option<String> {
    let distinct: BTreeSet<&String> = subset.features.iter().collect();
    if subset.features.is_empty() {
        return Some("it has no features".to_owned());
    }
    if distinct.len() < subset.features.len() {
        return Some("it names a feature twice".to_owned());
    }
    if !names.insert(&subset.name) {
        return Some("there are two subsets of this name".to_owned());
    }
    if subset.restored.iter().any(|point| point.len() != subset.features.len()) {
        return Some(format!(
            "a restored point needs {} coordinates, one per feature",
            subset.features.len()
        ));
    }
    match (subset.epsilon, subset.min_points) {
        (Setting::Fixed(epsilon), _) if !(LEAST_EPSILON..=LARGEST_VALUE).contains(&epsilon) => Some(format!(
            "epsilon is {epsilon:?}, but must be a number from {LEAST_EPSILON:e} to {LARGEST_VALUE:e}"
        )),
        (_, Setting::Fixed(0)) => Some("min_points is 0, but must be at least 1".to_owned()),
        _ => None,
    }
}
