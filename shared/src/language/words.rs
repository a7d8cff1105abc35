//! A set of words that lead to some of the pairs: how much, how many, and the first of them.

use super::WordSet;
use super::chain::reaching;
use super::linear::{Components, Row, is_cyclic, solve};
use super::product::{Pair, Product, Step};
use crate::pdfa::Word;

/// How many (pair, length) combinations are kept at most to find examples.
const KEPT: usize = 1 << 22;

/// The words that end in a pair for which `end` is above zero, each step taken with `probability`.
pub(super) fn word_set(
    product: &Product,
    end: impl Fn(Pair) -> f64,
    probability: impl Fn(&Step) -> f64,
    examples: usize,
) -> WordSet {
    let ends: Vec<f64> = product.pairs.iter().map(|&pair| end(pair)).collect();
    let sources = product.sources(|step| probability(step) > 0.0);
    let useful = reaching(&sources, ends.iter().map(|&end| end > 0.0).collect());
    if !useful.first().is_some_and(|&useful| useful) {
        return WordSet::default();
    }
    let part = Part { product, useful: &useful, ends: &ends, probability: &probability };
    let rows = part.rows();
    let components = Components::of(&rows);
    WordSet {
        mass: solve(components.sinks_first(), &rows, ends.clone())[0].clamp(0.0, 1.0),
        number: number(&components, &rows, &ends),
        examples: part.first(examples, &sources),
    }
}

/// How many ways there are from the first node to ends; none when infinitely many.
fn number(components: &Components, rows: &[Row], ends: &[f64]) -> Option<u64> {
    let mut numbers: Vec<u64> = ends.iter().map(|&end| u64::from(end > 0.0)).collect();
    for component in components.sinks_first() {
        if is_cyclic(component, rows) {
            return None;
        }
        for &node in component {
            numbers[node] = rows[node]
                .iter()
                .fold(numbers[node], |sum, &(target, _)| sum.saturating_add(numbers[target]));
        }
    }
    numbers.first().copied()
}

/// The pairs from which a word of the set can be completed.
struct Part<'a, P> {
    product: &'a Product,
    useful: &'a [bool],
    ends: &'a [f64],
    probability: &'a P,
}

impl<P: Fn(&Step) -> f64> Part<'_, P> {
    fn steps(&self, pair: usize) -> impl Iterator<Item = &Step> {
        let taken = |step: &&Step| self.useful[step.target] && (self.probability)(step) > 0.0;
        self.product.steps[pair].iter().filter(taken)
    }

    /// All steps between them; none from the other pairs.
    fn rows(&self) -> Vec<Row> {
        let row = |pair: usize| -> Row {
            let steps = self.steps(pair).map(|step| (step.target, (self.probability)(step)));
            if self.useful[pair] { steps.collect() } else { Vec::new() }
        };
        (0..self.useful.len()).map(row).collect()
    }

    /// The first words, shortest first, then in the order of the alphabet.
    ///
    /// `within[n]` holds the pairs from which a word of the set can be completed with exactly n symbols. A walk that
    /// goes only to `within[n - 1]` next never has to turn back, so no frontier of half words is kept.
    fn first(&self, examples: usize, sources: &[Vec<usize>]) -> Vec<(Word, f64)> {
        let ending = (0..self.ends.len()).filter(|&pair| self.ends[pair] > 0.0);
        let mut within: Vec<Vec<usize>> = vec![ending.collect()];
        let mut found = Vec::new();
        let mut kept = 0;
        while let Some(last) = within.last().filter(|last| !last.is_empty() && found.len() < examples) {
            if last.binary_search(&0).is_ok() {
                self.walk(&within, examples, &mut found);
            }
            kept += last.len();
            if kept > KEPT {
                break;
            }
            let mut next: Vec<usize> = last.iter().flat_map(|&pair| sources[pair].iter().copied()).collect();
            next.sort_unstable();
            next.dedup();
            within.push(next);
        }
        found
    }

    /// Adds the words with as many symbols as `within` has steps, until there are `examples`.
    fn walk(&self, within: &[Vec<usize>], examples: usize, found: &mut Vec<(Word, f64)>) {
        let length = within.len() - 1;
        let next = |pair: usize, remaining: usize| {
            let leads_on = move |step: &&Step| within[remaining - 1].binary_search(&step.target).is_ok();
            let steps: Vec<Step> = self.steps(pair).filter(leads_on).copied().collect();
            steps.into_iter()
        };
        if length == 0 {
            found.push((Word::new(), self.ends[0]));
            return;
        }
        let mut path: Vec<(Step, f64)> = Vec::new();
        let mut open = vec![next(0, length)];
        while let Some(steps) = open.last_mut() {
            let Some(step) = steps.next() else {
                open.pop();
                path.pop();
                continue;
            };
            let so_far = path.last().map_or(1.0, |&(_, probability)| probability);
            path.push((step, so_far * (self.probability)(&step)));
            if path.len() < length {
                open.push(next(step.target, length - path.len()));
                continue;
            }
            let word = path.iter().map(|(step, _)| step.symbol).collect();
            let probability = path.last().map_or(1.0, |&(_, probability)| probability);
            found.push((word, probability * self.ends[step.target]));
            path.pop();
            if found.len() >= examples {
                return;
            }
        }
    }
}
