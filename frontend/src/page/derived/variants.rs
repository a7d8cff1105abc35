//! The distinct words, and how the automaton as it is now takes them.

use std::collections::BTreeMap;

use goalgraph::conformance::{Conformance, follow};
use goalgraph::pdfa::{Pdfa, Probabilities, StateId, Symbol, Word};
use goalgraph::specification::Specification;

/// A distinct word.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variant {
    /// The word.
    pub(crate) word: Word,
    /// The names of its demonstrations.
    pub(crate) demonstrations: Vec<String>,
    /// How many demonstrations show it or a more frequent word.
    pub(crate) cumulative: usize,
    /// How it fares.
    pub(crate) conformance: Conformance,
}

/// How all demonstrations fare together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Fit {
    /// How many demonstrations there are.
    pub(crate) demonstrations: usize,
    /// How many are accepted.
    pub(crate) accepted: usize,
    /// Log-likelihood of the accepted ones.
    pub(crate) log_likelihood: f64,
}

/// The distinct words of the demonstrations, most frequent first, then in the order of the alphabet.
pub(super) fn variants(specification: &Specification, probabilities: &Probabilities) -> Vec<Variant> {
    let mut by_word: BTreeMap<&Word, Vec<String>> = BTreeMap::new();
    for demonstration in &specification.demonstrations {
        by_word.entry(&demonstration.word).or_default().push(demonstration.name.clone());
    }
    let variant = |(word, demonstrations): (&Word, _)| Variant {
        word: word.clone(),
        demonstrations,
        cumulative: 0,
        conformance: conformance(specification, probabilities, word),
    };
    let mut variants: Vec<Variant> = by_word.into_iter().map(variant).collect();
    variants.sort_by_key(|variant| std::cmp::Reverse(variant.demonstrations.len()));
    let mut cumulative = 0;
    for variant in &mut variants {
        cumulative += variant.demonstrations.len();
        variant.cumulative = cumulative;
    }
    variants
}

/// A symbol of no sub-goal is no way on.
fn conformance(specification: &Specification, probabilities: &Probabilities, word: &Word) -> Conformance {
    let known = |symbol: &Symbol| specification.sub_goal(*symbol).map(|_| *symbol);
    follow(&specification.pdfa, probabilities, &word.iter().map(known).collect::<Vec<_>>())
}

/// How all of `variants` fare together.
pub(super) fn fit(variants: &[Variant]) -> Fit {
    variants.iter().fold(Fit::default(), |fit, variant| {
        let number = variant.demonstrations.len();
        let fit = Fit { demonstrations: fit.demonstrations + number, ..fit };
        match variant.conformance {
            Conformance::Accepted { log_likelihood } => Fit {
                accepted: fit.accepted + number,
                log_likelihood: fit.log_likelihood + number as f64 * log_likelihood,
                ..fit
            },
            _ => fit,
        }
    })
}

/// The transitions that `word` takes, as far as it gets.
pub(crate) fn ways(pdfa: &Pdfa, word: &[Symbol]) -> Vec<(StateId, Symbol)> {
    let mut state = pdfa.initial;
    let mut ways = Vec::with_capacity(word.len());
    for &symbol in word {
        let Some(way) = pdfa.transition(state, symbol) else { break };
        ways.push((state, symbol));
        state = way.target;
    }
    ways
}
