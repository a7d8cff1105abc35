//! How far two automata are apart as distributions over words.

mod divergence;
mod variation;

use crate::language::WordDistribution;
use crate::language::product::Product;

/// A number that is known to lie between two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// It is at least this.
    pub low: f64,
    /// It is at most this; the same as `low` when it is known exactly.
    pub high: f64,
}

/// Two distances between distributions over words.
///
/// Where runs may get into a state from which they never end, "it does not end" counts as one more outcome beside the
/// words, so that probabilities always sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// The Kullback-Leibler divergence in nats: how much more surprising the words of the first are to whoever expects
    /// the second. Infinite where the second lacks a word of the first.
    pub kl_divergence: f64,
    /// Half the sum of all differences of probabilities, from 0 to 1: how much of the probability went to other words.
    pub total_variation: Bounds,
}

/// The distances of `to` from `from`.
///
/// The divergence is exact up to rounding: over all pairs of states that the same word leads to, the expected number of
/// visits by words of `from`, times the local divergence (Carrasco 1997, *Accurate computation of the relative entropy
/// between stochastic regular grammars*).
///
/// The total variation is NP-hard to compute in general (Lyngsø and Pedersen 2002). Prefixes are followed in order of
/// length, those with the same futures in the same proportion together, and where the futures are equal in both, or one
/// side is dead, no further. After about 20,000 prefixes the rest enters the bounds. Prefixes count as in the same
/// proportion when that differs by less than one in 10^12.
///
/// # Complexity
///
/// As [`crate::language::language_effect`], and up to 20,000 looks at the steps out of a pair.
///
/// # Example
///
/// ```
/// use goalgraph::distance::{Bounds, distance};
/// use goalgraph::language::WordDistribution;
/// use goalgraph::pdfa::{Pdfa, Symbol};
///
/// let (a, b) = (Symbol(0), Symbol(1));
/// let from = Pdfa::from_words(&[vec![a]]);
/// let to = Pdfa::from_words(&[vec![a], vec![b]]);
/// let distance = distance(&WordDistribution::of(&from), &WordDistribution::of(&to));
/// assert_eq!(distance.kl_divergence, 2.0_f64.ln());
/// assert_eq!(distance.total_variation, Bounds { low: 0.5, high: 0.5 });
/// ```
pub fn distance(from: &WordDistribution, to: &WordDistribution) -> Distance {
    let product = Product::of(from.chain(), to.chain());
    Distance {
        kl_divergence: divergence::kl_divergence(&product, from.chain(), to.chain()),
        total_variation: variation::total_variation(&product, from.chain(), to.chain()),
    }
}
