//! The total variation: exact where the futures are equal, bounded where there are too many prefixes.

mod futures;

use std::collections::BTreeMap;

use super::Bounds;
use crate::language::chain::Chain;
use crate::language::product::Product;

use self::futures::{Future, futures};

/// How many prefixes are followed.
const FOLLOWED: usize = 20_000;

/// What is not worth following: the bounds are this near to each other, in all.
const NEAR: f64 = 1e-13;

/// The bits of a proportion that decide whether it is the same: 40 of the mantissa.
const SAME_PROPORTION: u64 = !((1 << 12) - 1);

/// The chains are trimmed, the product is theirs.
pub(super) fn total_variation(product: &Product, from: &Chain, to: &Chain) -> Bounds {
    let futures = futures(product, from, to);
    let mut sum = Bounds { low: 0.0, high: 0.0 };
    let mut followed = 0;
    let mut prefixes = Prefixes::default();
    if !product.pairs.is_empty() {
        prefixes.add(0, Weights { from: 1.0, to: 1.0 });
    }
    while !prefixes.0.is_empty() {
        let open = uncertain_first(std::mem::take(&mut prefixes), &futures);
        let uncertain: f64 = open.iter().map(|prefix| prefix.bounds.high - prefix.bounds.low).sum();
        let budget = if uncertain > NEAR { FOLLOWED.saturating_sub(followed).div_ceil(2) } else { 0 };
        for (rank, prefix) in open.into_iter().enumerate() {
            let exact = prefix.bounds.low >= prefix.bounds.high;
            if exact || rank >= budget {
                sum = sum.plus(prefix.bounds);
                continue;
            }
            followed += 1;
            let pair = product.pairs[prefix.pair];
            let end = |chain: &Chain, state: Option<usize>| state.map_or(0.0, |state| chain.ends[state]);
            let (here, there) = (end(from, pair.left), end(to, pair.right));
            sum = sum.plus_exact((prefix.weights.from * here - prefix.weights.to * there).abs());
            for step in &product.steps[prefix.pair] {
                let Weights { from, to } = prefix.weights;
                prefixes.add(step.target, Weights { from: from * step.left, to: to * step.right });
            }
        }
    }
    let sum = sum.plus_exact((from.endless_mass() - to.endless_mass()).abs());
    Bounds { low: (sum.low / 2.0).clamp(0.0, 1.0), high: (sum.high / 2.0).clamp(0.0, 1.0) }
}

impl Bounds {
    fn plus(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }

    fn plus_exact(self, value: f64) -> Self {
        self.plus(Self { low: value, high: value })
    }
}

/// Probability of a prefix, or of several together, in both automata.
#[derive(Clone, Copy, Debug, Default)]
struct Weights {
    from: f64,
    to: f64,
}

/// Prefixes of one length. Those that lead to the same pair in the same proportion are one: all their differences are
/// in that proportion, too.
#[derive(Default)]
struct Prefixes(BTreeMap<(usize, u64), Weights>);

impl Prefixes {
    fn add(&mut self, pair: usize, weights: Weights) {
        if weights.from + weights.to <= 0.0 {
            return;
        }
        let proportion = (weights.from / weights.to).to_bits() & SAME_PROPORTION;
        let together = self.0.entry((pair, proportion)).or_default();
        together.from += weights.from;
        together.to += weights.to;
    }
}

/// A prefix with what its continuations contribute.
struct Prefix {
    pair: usize,
    weights: Weights,
    bounds: Bounds,
}

/// The prefixes with the widest bounds first; ties as they come.
fn uncertain_first(prefixes: Prefixes, futures: &[Future]) -> Vec<Prefix> {
    let bounded = |((pair, _), weights): ((usize, u64), Weights)| {
        let bounds = futures[pair].difference(weights.from, weights.to);
        Prefix { pair, weights, bounds }
    };
    let mut open: Vec<Prefix> = prefixes.0.into_iter().map(bounded).collect();
    let width = |prefix: &Prefix| prefix.bounds.high - prefix.bounds.low;
    open.sort_by(|a, b| width(b).total_cmp(&width(a)));
    open
}
