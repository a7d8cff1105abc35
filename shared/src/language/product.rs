//! Two automata walked together: pairs of states that the same word leads to.

use std::collections::BTreeMap;

use super::chain::{Chain, Way};
use crate::pdfa::Symbol;

/// What the same word leads to in both; none where it has left the automaton.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Pair {
    pub(crate) left: Option<usize>,
    pub(crate) right: Option<usize>,
}

/// A step from a pair to another, with its probability in both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) symbol: Symbol,
    /// Index of the pair it leads to.
    pub(crate) target: usize,
    pub(crate) left: f64,
    pub(crate) right: f64,
}

/// All pairs that words lead to, the empty word's first; a pair that is dead on both sides is left out.
#[derive(Clone, Debug)]
pub(crate) struct Product {
    pub(crate) pairs: Vec<Pair>,
    /// The steps out of each pair, by symbol.
    pub(crate) steps: Vec<Vec<Step>>,
}

impl Product {
    /// # Complexity
    ///
    /// O(P + S log P) for P pairs and S steps between them.
    pub(crate) fn of(left: &Chain, right: &Chain) -> Self {
        let start = Pair { left: left.initial, right: right.initial };
        let mut product = Self { pairs: Vec::new(), steps: Vec::new() };
        if start.left.is_none() && start.right.is_none() {
            return product;
        }
        product.pairs.push(start);
        let mut index = BTreeMap::from([(start, 0)]);
        while let Some(&pair) = product.pairs.get(product.steps.len()) {
            let ways = |chain: &'_ Chain, state: Option<usize>| -> Vec<Way> {
                state.map_or_else(Vec::new, |state| chain.ways[state].clone())
            };
            let mut steps = Vec::new();
            for (symbol, in_left, in_right) in by_symbol(&ways(left, pair.left), &ways(right, pair.right)) {
                let to = Pair { left: in_left.map(|way| way.target), right: in_right.map(|way| way.target) };
                let target = *index.entry(to).or_insert_with(|| {
                    product.pairs.push(to);
                    product.pairs.len() - 1
                });
                let probability = |way: Option<Way>| way.map_or(0.0, |way| way.probability);
                steps.push(Step { symbol, target, left: probability(in_left), right: probability(in_right) });
            }
            product.steps.push(steps);
        }
        product
    }

    /// The pairs that steps lead from, for each pair; only the steps for which `taken` holds.
    pub(crate) fn sources(&self, taken: impl Fn(&Step) -> bool) -> Vec<Vec<usize>> {
        let mut sources = vec![Vec::new(); self.pairs.len()];
        for (source, steps) in self.steps.iter().enumerate() {
            steps.iter().filter(|step| taken(step)).for_each(|step| sources[step.target].push(source));
        }
        sources
    }
}

/// Merges the ways of both sides by symbol.
fn by_symbol(left: &[Way], right: &[Way]) -> Vec<(Symbol, Option<Way>, Option<Way>)> {
    let mut merged = Vec::with_capacity(left.len().max(right.len()));
    let (mut left, mut right) = (left.iter().copied().peekable(), right.iter().copied().peekable());
    loop {
        let next =
            left.peek().map(|way| way.symbol).into_iter().chain(right.peek().map(|way| way.symbol)).min();
        let Some(symbol) = next else {
            return merged;
        };
        merged.push((
            symbol,
            left.next_if(|way| way.symbol == symbol),
            right.next_if(|way| way.symbol == symbol),
        ));
    }
}
