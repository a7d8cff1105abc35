//! How different the words from a pair of states on can be at most.

use crate::distance::Bounds;
use crate::language::chain::Chain;
use crate::language::linear::{Components, Row, solve};
use crate::language::product::Product;

/// What is known of the words from a pair of states on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Future {
    /// Probability of ending, in the first automaton.
    from: f64,
    /// Probability of ending, in the second one.
    to: f64,
    /// The sum of the differences of all words' probabilities is at most this: zero exactly when the futures are equal.
    apart: f64,
}

impl Future {
    /// Bounds on the sum of |`from` P(w) - `to` P'(w)| over all words w from here on.
    ///
    /// Below: the difference of the sums. Above: `from` P - `to` P' = (`from` - `to`) P + `to` (P - P'), or the other
    /// way round.
    pub(super) fn difference(self, from: f64, to: f64) -> Bounds {
        let apart = (from - to).abs();
        if self.apart == 0.0 {
            let exactly = apart * self.from;
            return Bounds { low: exactly, high: exactly };
        }
        let (ends_from, ends_to) = (from * self.from, to * self.to);
        if ends_from <= 0.0 || ends_to <= 0.0 {
            let exactly = ends_from.max(ends_to);
            return Bounds { low: exactly, high: exactly };
        }
        let low = (ends_from - ends_to).abs();
        let by_first = apart * self.from + to * self.apart;
        let by_second = apart * self.to + from * self.apart;
        Bounds { low, high: by_first.min(by_second).min(ends_from + ends_to).max(low) }
    }
}

/// One future per pair.
///
/// How far apart they are at most solves D = |e - e'| + sum of |p - p'| E + min(p, p') D(next) over the steps, where E is
/// the probability of ending after the step in the automaton where the step is more probable.
pub(super) fn futures(product: &Product, from: &Chain, to: &Chain) -> Vec<Future> {
    let (ending_from, ending_to) = (from.ending(), to.ending());
    let of = |list: &[f64], state: Option<usize>| state.map_or(0.0, |state| list[state]);
    let mut constants = Vec::with_capacity(product.pairs.len());
    let mut rows: Vec<Row> = Vec::with_capacity(product.pairs.len());
    for (pair, steps) in product.pairs.iter().zip(&product.steps) {
        let mut constant = (of(&from.ends, pair.left) - of(&to.ends, pair.right)).abs();
        let mut row = Row::new();
        for step in steps {
            let target = product.pairs[step.target];
            let ends = if step.left > step.right {
                of(&ending_from, target.left)
            } else {
                of(&ending_to, target.right)
            };
            constant += (step.left - step.right).abs() * ends;
            let shared = step.left.min(step.right);
            if shared > 0.0 {
                row.push((step.target, shared));
            }
        }
        constants.push(constant);
        rows.push(row);
    }
    let apart = solve(Components::of(&rows).sinks_first(), &rows, constants);
    let future = |(pair, apart): (&crate::language::product::Pair, f64)| {
        let (from, to) = (of(&ending_from, pair.left), of(&ending_to, pair.right));
        Future { from, to, apart: apart.min(from + to) }
    };
    product.pairs.iter().zip(apart).map(future).collect()
}
