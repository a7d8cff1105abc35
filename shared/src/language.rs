//! The words of an automaton as a distribution, and what a change of the automaton does to them.
//!
//! Everything here reads weights by [`Semantics::MaximumLikelihood`], the only reading under which the probabilities of
//! words add up. A word is accepted when its probability is above zero: a way that an expert gave the weight zero is no
//! way.

pub(crate) mod chain;
pub(crate) mod linear;
pub(crate) mod product;
mod words;

use crate::pdfa::{Pdfa, Probabilities, Semantics, Symbol, Word};

use self::chain::Chain;
use self::product::{Pair, Product, Step};

/// An automaton with the probabilities of its words.
#[derive(Clone, Debug)]
pub struct WordDistribution<'a> {
    pdfa: &'a Pdfa,
    probabilities: Probabilities,
    /// What ends: states and ways of probability zero, and those that lead to no end, are left out.
    chain: Chain,
}

impl<'a> WordDistribution<'a> {
    /// The distribution over the words of `pdfa`.
    ///
    /// # Complexity
    ///
    /// O((Q + T) log T) for Q states and T transitions.
    pub fn of(pdfa: &'a Pdfa) -> Self {
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        let chain = Chain::new(pdfa, &probabilities).trimmed();
        Self { pdfa, probabilities, chain }
    }

    /// The automaton.
    pub fn pdfa(&self) -> &'a Pdfa {
        self.pdfa
    }

    /// The probabilities of its transitions and ends.
    pub fn probabilities(&self) -> &Probabilities {
        &self.probabilities
    }

    /// Probability of `word`; zero when it is not accepted.
    ///
    /// # Complexity
    ///
    /// O(n log T) for a word of n symbols and T transitions.
    pub fn probability(&self, word: &[Symbol]) -> f64 {
        self.pdfa.word_probability(word, &self.probabilities)
    }

    /// The probabilities of all words together, from 0 to 1: below 1 when a run may get into a state from which it
    /// never ends.
    ///
    /// # Complexity
    ///
    /// As [`language_effect`].
    pub fn total(&self) -> f64 {
        match self.chain.initial {
            Some(initial) if self.chain.endless_mass() > 0.0 => self.chain.ending()[initial],
            Some(_) => 1.0,
            None => 0.0,
        }
    }

    pub(crate) fn chain(&self) -> &Chain {
        &self.chain
    }
}

/// How the accepted words change.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct LanguageEffect {
    /// The words that are accepted afterwards and were not before.
    pub gained: WordSet,
    /// The words that were accepted before and are not afterwards.
    pub lost: WordSet,
}

/// A set of words.
#[derive(Clone, Debug, PartialEq)]
pub struct WordSet {
    /// Their probability together, under the distribution that accepts them: after the change for what is gained,
    /// before it for what is lost.
    pub mass: f64,
    /// How many they are: none when infinitely many, `u64::MAX` also for more than that.
    pub number: Option<u64>,
    /// The first of them, shortest first, then in the order of the alphabet, each with its probability.
    pub examples: Vec<(Word, f64)>,
}

impl Default for WordSet {
    /// No words.
    fn default() -> Self {
        Self { mass: 0.0, number: Some(0), examples: Vec::new() }
    }
}

/// The words that a change from `before` to `after` adds and takes away, with at most `examples` written out each.
///
/// Both are walked together, in pairs of states (Hopcroft and Ullman's product automaton, with a dead state for either).
/// Pairs from which no word of the set can be completed are not looked at again, so what is equal in both costs one look.
/// Masses are exact up to rounding, through a linear system where there are cycles ([`linear`]). No example is given
/// that is so long that more than four million (pair, length) combinations would have to be kept to find it.
///
/// # Complexity
///
/// O(P log P + L · S) for P reachable pairs with S steps between them and a longest example of L symbols; P is at most
/// (Q + 1) · (Q' + 1), and near Q when the automata agree on most of their states. A strongly connected component of C
/// pairs costs O(C³) for C up to 300.
///
/// # Example
///
/// ```
/// use goalgraph::language::{WordDistribution, language_effect};
/// use goalgraph::pdfa::{Pdfa, Symbol};
///
/// let (a, b) = (Symbol(0), Symbol(1));
/// let before = Pdfa::from_words(&[vec![a, b]]);
/// let after = Pdfa::from_words(&[vec![a, b], vec![b, a]]);
/// let effect = language_effect(&WordDistribution::of(&before), &WordDistribution::of(&after), 5);
/// assert_eq!(effect.gained.examples, [(vec![b, a], 0.5)]);
/// assert_eq!(effect.lost.number, Some(0));
/// ```
pub fn language_effect(
    before: &WordDistribution,
    after: &WordDistribution,
    examples: usize,
) -> LanguageEffect {
    let (before, after) = (before.chain(), after.chain());
    let product = Product::of(before, after);
    let end_before = |pair: Pair| pair.left.map_or(0.0, |state| before.ends[state]);
    let end_after = |pair: Pair| pair.right.map_or(0.0, |state| after.ends[state]);
    let only = |here: f64, there: f64| if there > 0.0 { 0.0 } else { here };
    LanguageEffect {
        gained: words::word_set(
            &product,
            |pair| only(end_after(pair), end_before(pair)),
            |step: &Step| step.right,
            examples,
        ),
        lost: words::word_set(
            &product,
            |pair| only(end_before(pair), end_after(pair)),
            |step: &Step| step.left,
            examples,
        ),
    }
}
