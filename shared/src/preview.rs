//! What edits would do, before they are done.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::conformance::{Conformance, follow};
use crate::distance::{Distance, distance};
use crate::edit::{Edit, EditError};
use crate::language::{LanguageEffect, WordDistribution, language_effect};
use crate::pdfa::{StateId, Symbol};
use crate::specification::{DemonstrationWord, Specification};

/// How many gained and lost words a preview writes out, at most, of each.
pub const EXAMPLES: usize = 5;

/// What edits would do.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    /// The specification after them.
    pub specification: Arc<Specification>,
    /// States that would be gone, with the state that each would be part of.
    pub folded: BTreeMap<StateId, StateId>,
    /// States that would be gone altogether.
    pub removed: BTreeSet<StateId>,
    /// New states.
    pub added: BTreeSet<StateId>,
    /// Words that would be accepted, and would be no longer, with at most [`EXAMPLES`] of each.
    pub effect: LanguageEffect,
    /// Positions of demonstrations that are accepted and would be no longer.
    pub lost_demonstrations: Vec<usize>,
    /// Positions of demonstrations that are not accepted and would be.
    pub gained_demonstrations: Vec<usize>,
    /// Natural logarithm of the probability of all demonstrations together that are accepted before and after, by the
    /// one and by the other; none when there is no such demonstration.
    pub log_likelihood: (Option<f64>, Option<f64>),
    /// How far the words after are from those before.
    pub distance: Distance,
}

/// What `edits`, one after the other, would do to `before`.
///
/// Weights are read by maximum likelihood, whatever the semantics of the specification: the only reading under which
/// words have a distribution. A demonstration is judged by the word that is read from it before and after.
///
/// # Errors
///
/// That of the first edit that cannot be done.
///
/// # Complexity
///
/// That of the edits, of [`language_effect`] and of [`distance`], and O(S log T) for S symbols of all demonstrations
/// and T transitions.
pub fn preview(before: &Specification, edits: &[Edit]) -> Result<Preview, EditError> {
    let mut after = before.clone();
    let mut folded = BTreeMap::new();
    for edit in edits {
        follow_folds(&mut folded, edit.perform(&mut after)?);
    }
    let (old, new) = (&before.pdfa.states, &after.pdfa.states);
    folded.retain(|gone, stays| old.contains_key(gone) && !new.contains_key(gone) && new.contains_key(stays));
    let removed =
        old.keys().filter(|id| !new.contains_key(id) && !folded.contains_key(id)).copied().collect();
    let added = new.keys().filter(|id| !old.contains_key(id)).copied().collect();
    let (from, to) = (WordDistribution::of(&before.pdfa), WordDistribution::of(&after.pdfa));
    let effect = language_effect(&from, &to, EXAMPLES);
    let distance = distance(&from, &to);
    let judged = judge(&before.demonstrations, &from, &after.demonstrations, &to);
    let specification = Arc::new(after);
    let Judged { lost_demonstrations, gained_demonstrations, log_likelihood } = judged;
    Ok(Preview {
        specification,
        folded,
        removed,
        added,
        effect,
        lost_demonstrations,
        gained_demonstrations,
        log_likelihood,
        distance,
    })
}

/// Adds the folds of one more edit to those of the edits before it.
fn follow_folds(folded: &mut BTreeMap<StateId, StateId>, next: BTreeMap<StateId, StateId>) {
    for stays in folded.values_mut() {
        *stays = next.get(stays).copied().unwrap_or(*stays);
    }
    folded.extend(next);
}

/// How the demonstrations fare.
#[derive(Default)]
struct Judged {
    lost_demonstrations: Vec<usize>,
    gained_demonstrations: Vec<usize>,
    log_likelihood: (Option<f64>, Option<f64>),
}

fn judge(
    before: &[DemonstrationWord],
    from: &WordDistribution,
    after: &[DemonstrationWord],
    to: &WordDistribution,
) -> Judged {
    let mut judged = Judged::default();
    for (position, shown) in before.iter().enumerate() {
        // Another specification may come with other demonstrations: then the word is what it was.
        let same = |other: &&DemonstrationWord| other.name == shown.name && other.sha256 == shown.sha256;
        let reread = after.get(position).filter(same).unwrap_or(shown);
        match (log_likelihood(from, &shown.word), log_likelihood(to, &reread.word)) {
            (Some(old), Some(new)) => {
                let (all_old, all_new) = judged.log_likelihood;
                judged.log_likelihood =
                    (Some(all_old.unwrap_or(0.0) + old), Some(all_new.unwrap_or(0.0) + new));
            }
            (Some(_), None) => judged.lost_demonstrations.push(position),
            (None, Some(_)) => judged.gained_demonstrations.push(position),
            (None, None) => {}
        }
    }
    judged
}

/// Natural logarithm of the word's probability, if it is accepted.
fn log_likelihood(distribution: &WordDistribution, word: &[Symbol]) -> Option<f64> {
    let word: Vec<Option<Symbol>> = word.iter().copied().map(Some).collect();
    match follow(distribution.pdfa(), distribution.probabilities(), &word) {
        Conformance::Accepted { log_likelihood } => Some(log_likelihood),
        Conformance::Deviates { .. } | Conformance::EndsEarly { .. } => None,
    }
}
