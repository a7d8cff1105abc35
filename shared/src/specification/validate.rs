//! From the file's outer shape to a specification that keeps its invariants, or the place where it does not.

use std::collections::{BTreeMap, BTreeSet};

use super::file::{
    AutomatonEntry, FeatureEntry, PROBABILITY_TOLERANCE, ReadError, SpecificationFile, SubGoalEntry,
    SubsetEntry, contradiction,
};
use super::{Ball, COLORS, DemonstrationWord, Specification, SubGoal, SubsetParameters};
use crate::demonstration::Feature;
use crate::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition};

impl SpecificationFile {
    /// The specification that the file describes.
    ///
    /// # Errors
    ///
    /// [`ReadError::Contradiction`] with the first place that does not fit the rest.
    pub(super) fn into_specification(self) -> Result<Specification, ReadError> {
        let feature_names = unique("features", self.features.iter().map(|feature| feature.name.clone()))?;
        unique("subsets", self.subsets.iter().map(|subset| subset.name.clone()))?;
        let subsets = self.subsets.into_iter().map(|subset| subset_parameters(subset, &feature_names));
        let subsets = subsets.collect::<Result<Vec<_>, _>>()?;
        let symbols = unique("sub_goals", self.sub_goals.iter().map(|sub_goal| sub_goal.id))?;
        let by_name = subsets.iter().map(|subset| (subset.name.as_str(), subset)).collect();
        let sub_goals = self.sub_goals.into_iter().map(|entry| sub_goal(entry, &by_name));
        let sub_goals = sub_goals.collect::<Result<Vec<_>, _>>()?;
        let pdfa = pdfa(&self.automaton, &symbols)?;
        check_probabilities(&self.automaton, &pdfa, self.semantics)?;
        let mut demonstrations = Vec::new();
        for (index, entry) in self.demonstrations.into_iter().enumerate() {
            let place = format!("demonstrations[{index}].word");
            known(&place, entry.word.iter(), &symbols)?;
            let (name, sha256, frames) = (entry.name, entry.sha256, entry.frames);
            demonstrations.push(DemonstrationWord { name, sha256, frames, word: entry.word });
        }
        let feature = |entry: FeatureEntry| Feature { name: entry.name, unit: entry.unit };
        let features = self.features.into_iter().map(feature).collect();
        let (name, semantics) = (self.name, self.semantics);
        Ok(Specification { name, semantics, features, subsets, sub_goals, pdfa, demonstrations })
    }
}

/// The items as a set, or the place of the second of two equal ones.
fn unique<T: Ord + Clone + std::fmt::Display>(
    place: &str,
    items: impl Iterator<Item = T>,
) -> Result<BTreeSet<T>, ReadError> {
    let mut seen = BTreeSet::new();
    for (index, item) in items.enumerate() {
        if !seen.insert(item.clone()) {
            return Err(contradiction(format!("{place}[{index}]"), format!("{item} is there twice")));
        }
    }
    Ok(seen)
}

/// Every symbol must be a sub-goal's.
fn known<'a>(
    place: &str,
    symbols: impl Iterator<Item = &'a Symbol>,
    alphabet: &BTreeSet<Symbol>,
) -> Result<(), ReadError> {
    for symbol in symbols {
        if !alphabet.contains(symbol) {
            return Err(contradiction(place, format!("there is no sub-goal {symbol}")));
        }
    }
    Ok(())
}

/// `value` must be finite and not negative.
fn at_least_zero(place: impl Into<String>, value: f64) -> Result<f64, ReadError> {
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(contradiction(place, format!("{} must be a finite number not below 0", short(value))))
    }
}

/// `value` as people write it, without hundreds of digits.
fn short(value: f64) -> String {
    if value.abs() < 1e15 { value.to_string() } else { format!("{value:e}") }
}

/// The largest weight: any number of them has a finite sum.
const LARGEST_WEIGHT: f64 = 1e100;

/// `value` must be a weight.
fn weight(place: impl Into<String>, value: f64) -> Result<f64, ReadError> {
    if (0.0..=LARGEST_WEIGHT).contains(&value) {
        Ok(value)
    } else {
        Err(contradiction(place, format!("{} must be a number from 0 to {LARGEST_WEIGHT:e}", short(value))))
    }
}

fn subset_parameters(entry: SubsetEntry, features: &BTreeSet<String>) -> Result<SubsetParameters, ReadError> {
    let place = format!("subset {}", entry.name);
    if let Some(missing) = entry.features.iter().find(|name| !features.contains(*name)) {
        return Err(contradiction(place, format!("there is no feature {missing:?}")));
    }
    if entry.features.is_empty() {
        return Err(contradiction(place, "it has no features"));
    }
    unique(&format!("{place}: features"), entry.features.iter())?;
    let epsilon = at_least_zero(format!("{place}: epsilon"), entry.epsilon.0)?;
    if entry.min_points == 0 || entry.min_dwell == 0 {
        return Err(contradiction(place, "min_points and min_dwell must be at least 1"));
    }
    let (name, features) = (entry.name, entry.features);
    Ok(SubsetParameters { name, features, epsilon, min_points: entry.min_points, min_dwell: entry.min_dwell })
}

fn sub_goal(entry: SubGoalEntry, subsets: &BTreeMap<&str, &SubsetParameters>) -> Result<SubGoal, ReadError> {
    let place = format!("sub_goal {}", entry.id);
    let ball = match (entry.subset, entry.features, entry.center, entry.radius) {
        (None, None, None, None) => None,
        (Some(subset), Some(features), Some(center), Some(radius)) => {
            let Some(parameters) = subsets.get(subset.as_str()) else {
                return Err(contradiction(place, format!("there is no subset {subset:?}")));
            };
            if parameters.features != features {
                return Err(contradiction(place, format!("its features are not those of subset {subset:?}")));
            }
            if center.len() != features.len() {
                let message =
                    format!("center has {} coordinates for {} features", center.len(), features.len());
                return Err(contradiction(place, message));
            }
            let radius = at_least_zero(format!("{place}: radius"), radius.0)?;
            let center = center.into_iter().map(|number| number.0).collect();
            Some(Ball { subset, features, center, radius })
        }
        _ => {
            return Err(contradiction(place, "subset, features, center and radius go together"));
        }
    };
    if let Some(color) = entry.color.filter(|&color| color >= COLORS) {
        return Err(contradiction(place, format!("color: {color} must be below {COLORS}")));
    }
    let (frames, demonstrations, color) = (entry.frames, entry.demonstrations, entry.color);
    Ok(SubGoal { id: entry.id, name: entry.name, ball, frames, demonstrations, color })
}

fn pdfa(entry: &AutomatonEntry, symbols: &BTreeSet<Symbol>) -> Result<Pdfa, ReadError> {
    let ids = unique("automaton.states", entry.states.iter().map(|state| state.id))?;
    let mut states = BTreeMap::new();
    for state in &entry.states {
        let place = format!("state {}", state.id);
        known(&format!("{place}: completed"), state.completed.iter(), symbols)?;
        unique(&format!("{place}: completed"), state.completed.iter())?;
        let end_weight = weight(format!("{place}: end_weight"), state.end_weight.0)?;
        let completed = state.completed.iter().copied().collect();
        let (accepting, end_count) = (state.accepting, state.end_count);
        let (name, transitions) = (state.name.clone(), BTreeMap::new());
        states.insert(state.id, State { name, completed, accepting, end_count, end_weight, transitions });
    }
    let exists = |place: &str, id: StateId| {
        ids.contains(&id).then_some(()).ok_or_else(|| contradiction(place, format!("there is no state {id}")))
    };
    exists("automaton.initial", entry.initial)?;
    for transition in &entry.transitions {
        let place = format!("transition {} {} {}", transition.source, transition.symbol, transition.target);
        known(&place, std::iter::once(&transition.symbol), symbols)?;
        exists(&place, transition.source)?;
        exists(&place, transition.target)?;
        let weight = weight(format!("{place}: weight"), transition.weight.0)?;
        let way = Transition { target: transition.target, count: transition.count, weight };
        let ways = &mut states.entry(transition.source).or_default().transitions;
        if ways.insert(transition.symbol, way).is_some() {
            let message = format!("{} has a second transition by {}", transition.source, transition.symbol);
            return Err(contradiction(place, message));
        }
    }
    Ok(Pdfa { initial: entry.initial, states })
}

/// The probabilities that are written must be those that the weights give.
fn check_probabilities(entry: &AutomatonEntry, pdfa: &Pdfa, semantics: Semantics) -> Result<(), ReadError> {
    let probabilities = pdfa.probabilities(semantics);
    let agree = |place: String, written: f64, given: f64| {
        let agrees = (written - given).abs() <= PROBABILITY_TOLERANCE;
        let message = || format!("{} is written, but the weights give {given}", short(written));
        agrees.then_some(()).ok_or_else(|| contradiction(place, message()))
    };
    for state in &entry.states {
        let place = format!("state {}: final_probability", state.id);
        agree(place, state.final_probability.0, probabilities.end(state.id))?;
    }
    for transition in &entry.transitions {
        let (source, symbol, target) = (transition.source, transition.symbol, transition.target);
        let place = format!("transition {source} {symbol} {target}: probability");
        agree(place, transition.probability.0, probabilities.transition(source, symbol))?;
    }
    Ok(())
}
