//! The Kullback-Leibler divergence, pair of states by pair of states.

use crate::language::chain::Chain;
use crate::language::linear::{Components, Row, solve};
use crate::language::product::Product;

/// In nats; the chains are trimmed, the product is theirs.
pub(super) fn kl_divergence(product: &Product, from: &Chain, to: &Chain) -> f64 {
    let ending = from.ending();
    let visits = visits(product);
    let mut divergence = term(from.endless_mass(), to.endless_mass());
    for (index, pair) in product.pairs.iter().enumerate() {
        let Some(state) = pair.left else {
            continue;
        };
        let there = pair.right.map_or(0.0, |right| to.ends[right]);
        let mut local = term(from.ends[state], there);
        for step in &product.steps[index] {
            if let Some(target) = product.pairs[step.target].left {
                local += term(step.left, step.right) * ending[target].max(f64::MIN_POSITIVE);
            }
        }
        if local.is_infinite() {
            return f64::INFINITY;
        }
        if local != 0.0 {
            divergence += visits[index] * local;
        }
    }
    divergence.max(0.0)
}

/// How often a run of the first automaton passes each pair, before it ends or gets where it never ends.
///
/// Every state of a trimmed chain leads to an end, so the sum over all ways converges.
fn visits(product: &Product) -> Vec<f64> {
    let forward: Vec<Row> = product
        .steps
        .iter()
        .map(|steps| {
            let taken = steps.iter().filter(|step| step.left > 0.0);
            taken.map(|step| (step.target, step.left)).collect()
        })
        .collect();
    let mut backward = vec![Row::new(); forward.len()];
    for (source, row) in forward.iter().enumerate() {
        for &(target, probability) in row {
            backward[target].push((source, probability));
        }
    }
    let mut once = vec![0.0; forward.len()];
    once.iter_mut().take(1).for_each(|start| *start = 1.0);
    solve(Components::of(&forward).sources_first(), &backward, once)
}

/// p ln(p / q).
fn term(p: f64, q: f64) -> f64 {
    if p <= 0.0 {
        0.0
    } else if q <= 0.0 {
        f64::INFINITY
    } else {
        p * (p / q).ln()
    }
}
