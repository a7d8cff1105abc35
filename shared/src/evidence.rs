//! What a probability rests on: how sure the counts make it, and where it was demonstrated.

use statrs::function::beta::checked_beta_reg;

use crate::pdfa::{StateId, Symbol};
use crate::specification::Specification;

/// How many words the incomplete beta function can be computed for.
const MOST: f64 = 1e6;

/// Where a probability lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end, from 0.
    pub low: f64,
    /// Upper end, to 1.
    pub high: f64,
}

/// The equal-tailed 95 % credible interval of the probability of an outcome that was seen `count` times of `total`, in
/// a state where `outcomes` different ones were seen.
///
/// The posterior of all outcomes is Dirichlet with Jeffreys' prior, 1/2 for each of them and for one more that nobody
/// has shown; its marginal is Beta(`count` + 1/2, `total` - `count` + `outcomes` / 2). A `count` above `total` is taken
/// as `total`, no outcomes as one.
///
/// The quantiles are found by bisecting the regularized incomplete beta function, not by its inverse, which does not
/// always come to an end near 0; they are off by less than 1e-9. That function does not converge for very large counts:
/// of more than a million words the shares count as those of a million. The interval is then wider than it could be, but
/// below 0.002.
///
/// # Example
///
/// ```
/// use goalgraph::evidence::credible_interval;
///
/// let interval = credible_interval(6, 9, 2);
/// assert!(interval.low > 0.32 && interval.high < 0.88);
/// ```
pub fn credible_interval(count: u64, total: u64, outcomes: usize) -> Interval {
    let count = count.min(total);
    let scale = (MOST / (total as f64).max(MOST)).min(1.0);
    let a = count as f64 * scale + 0.5;
    let b = (total - count) as f64 * scale + (outcomes.max(1) as f64).min(MOST) / 2.0;
    Interval { low: beta_quantile(a, b, 0.025), high: beta_quantile(a, b, 0.975) }
}

/// The x for which Beta(`a`, `b`) is at most x with `probability`.
fn beta_quantile(a: f64, b: f64, probability: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        let below = checked_beta_reg(a, b, middle).unwrap_or(0.0);
        if below < probability { low = middle } else { high = middle }
    }
    f64::midpoint(low, high)
}

/// A place in a demonstration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Passage {
    /// Which demonstration, from 0.
    pub demonstration: usize,
    /// Where in its word: for a transition the position of its symbol, from 0; for a state how many symbols come before
    /// it, from 0 to the length of the word.
    pub position: usize,
}

/// Where the demonstrations pass `state`, in their order.
///
/// Their words are followed in the automaton as it is now, along all its transitions, those of weight zero too; a word
/// that deviates counts up to where it does.
///
/// # Complexity
///
/// O(S log T) for S symbols in all words and T transitions.
pub fn passages_of_state(specification: &Specification, state: StateId) -> Vec<Passage> {
    passages(specification, |visit| visit.state == state)
}

/// Where the demonstrations leave `source` by `symbol`, in their order; followed as by [`passages_of_state`].
///
/// # Complexity
///
/// As [`passages_of_state`].
pub fn passages_of_transition(
    specification: &Specification,
    source: StateId,
    symbol: Symbol,
) -> Vec<Passage> {
    passages(specification, |visit| visit.state == source && visit.leaves_by == Some(symbol))
}

/// A state on the way of a word, with the symbol that a transition follows by.
struct Visit {
    state: StateId,
    leaves_by: Option<Symbol>,
}

fn passages(specification: &Specification, wanted: impl Fn(&Visit) -> bool) -> Vec<Passage> {
    let mut passages = Vec::new();
    for (demonstration, shown) in specification.demonstrations.iter().enumerate() {
        for (position, visit) in visits(specification, &shown.word).iter().enumerate() {
            if wanted(visit) {
                passages.push(Passage { demonstration, position });
            }
        }
    }
    passages
}

/// The states that `word` passes, as far as there are transitions for it.
fn visits(specification: &Specification, word: &[Symbol]) -> Vec<Visit> {
    let pdfa = &specification.pdfa;
    let mut visits = Vec::with_capacity(word.len() + 1);
    let mut state = pdfa.initial;
    for &symbol in word {
        let Some(way) = pdfa.transition(state, symbol) else {
            break;
        };
        visits.push(Visit { state, leaves_by: Some(symbol) });
        state = way.target;
    }
    if pdfa.states.contains_key(&state) {
        visits.push(Visit { state, leaves_by: None });
    }
    visits
}
