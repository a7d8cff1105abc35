//! Giving an outcome a probability.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use super::automaton::state_mut;
use super::fold::LARGEST_WEIGHT;
use super::{EditError, Outcome};
use crate::pdfa::{Semantics, State, StateId};
use crate::specification::Specification;

/// What is asked for.
pub(super) struct Request<'a> {
    pub(super) outcome: Outcome,
    pub(super) probability: f64,
    pub(super) locked: &'a BTreeSet<Outcome>,
}

/// An outcome of the state as it is.
#[derive(Clone, Copy)]
struct Present {
    count: u64,
    weight: f64,
    /// Of all weights.
    share: f64,
}

/// How far a sum of probabilities may be from 1.
const TOLERANCE: f64 = 1e-12;

/// Sums of weights that leave room for small probabilities and stay weights.
const SUMS: RangeInclusive<f64> = 1e-200..=LARGEST_WEIGHT;

/// Makes the outcome's probability what is asked for. The sum of the weights stays what it is, if it is one of [`SUMS`].
pub(super) fn reweight(
    specification: &mut Specification,
    id: StateId,
    request: &Request<'_>,
) -> Result<(), EditError> {
    if !(0.0..=1.0).contains(&request.probability) {
        return Err(EditError::Probability(request.probability));
    }
    let published = specification.semantics == Semantics::Published;
    let state = state_mut(&mut specification.pdfa, id)?;
    if request.outcome == Outcome::End && published {
        return Err(EditError::Derived(id));
    }
    let present = outcomes(state, published);
    if !present.contains_key(&request.outcome) {
        return Err(EditError::no_outcome(id, request.outcome));
    }
    let mut shares = shares(id, &present, request)?;
    let sum = Sum::of(&present);
    if sum.before > 0.0 && !SUMS.contains(&sum.before) {
        for (&outcome, part) in &present {
            shares.entry(outcome).or_insert(part.share);
        }
        state.end_weight = (state.end_weight / sum.before * sum.after).min(LARGEST_WEIGHT);
    }
    for (outcome, share) in shares {
        let weight = (share * sum.after).min(LARGEST_WEIGHT);
        match outcome {
            Outcome::End => state.end_weight = weight,
            Outcome::Transition(symbol) => {
                if let Some(way) = state.transitions.get_mut(&symbol) {
                    way.weight = weight;
                }
            }
        }
    }
    Ok(())
}

/// The outcomes among which probability is shared.
fn outcomes(state: &State, published: bool) -> BTreeMap<Outcome, Present> {
    let ways = state.transitions.iter();
    let mut parts: Vec<(Outcome, u64, f64)> =
        ways.map(|(&symbol, way)| (Outcome::Transition(symbol), way.count, way.weight)).collect();
    if state.accepting && !published {
        parts.push((Outcome::End, state.end_count, state.end_weight));
    }
    let sum: f64 = parts.iter().map(|&(_, _, weight)| weight).sum();
    let share = |weight: f64| if sum > 0.0 { weight / sum } else { 0.0 };
    let present = |(outcome, count, weight)| (outcome, Present { count, weight, share: share(weight) });
    parts.into_iter().map(present).collect()
}

/// The sum of the weights of all outcomes.
struct Sum {
    before: f64,
    after: f64,
}

impl Sum {
    /// Without weights, their sum becomes that of the counts, or 1.
    fn of(present: &BTreeMap<Outcome, Present>) -> Self {
        let before: f64 = present.values().map(|part| part.weight).sum();
        let count: f64 = present.values().map(|part| part.count as f64).sum();
        let after = if before >= *SUMS.start() {
            before.min(*SUMS.end())
        } else if count > 0.0 {
            count
        } else {
            1.0
        };
        Self { before, after }
    }
}

/// The new probabilities of the outcome and of those that are not locked.
fn shares(
    id: StateId,
    present: &BTreeMap<Outcome, Present>,
    request: &Request<'_>,
) -> Result<BTreeMap<Outcome, f64>, EditError> {
    let Request { outcome, probability, locked } = *request;
    let others = || present.iter().filter(|&(other, _)| *other != outcome);
    let free: BTreeMap<Outcome, Present> =
        others().filter(|(other, _)| !locked.contains(other)).map(|(&other, &part)| (other, part)).collect();
    let locked =
        others().filter(|(other, _)| locked.contains(other)).map(|(_, part)| part.share).sum::<f64>() + 0.0;
    let rest = 1.0 - probability - locked;
    if rest < -TOLERANCE {
        return Err(EditError::TooMuch { state: id, probability, locked });
    }
    if free.is_empty() && rest > TOLERANCE {
        return Err(EditError::NothingLeft { state: id, probability, locked });
    }
    let rest = rest.max(0.0);
    let weight: f64 = free.values().map(|part| part.share).sum();
    let count: f64 = free.values().map(|part| part.count as f64).sum();
    let part_of = |part: &Present| {
        if weight > 0.0 {
            part.share / weight
        } else if count > 0.0 {
            part.count as f64 / count
        } else {
            1.0 / free.len() as f64
        }
    };
    let mut shares: BTreeMap<Outcome, f64> =
        free.iter().map(|(&other, part)| (other, rest * part_of(part))).collect();
    shares.insert(outcome, probability);
    Ok(shares)
}
