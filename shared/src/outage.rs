//! What remains possible when sub-goals are unavailable.

use std::collections::BTreeSet;

use crate::language::chain::Chain;
use crate::language::linear::{Components, Row, solve};
use crate::pdfa::{Pdfa, Probabilities, StateId, Symbol};

/// The prospects from a state.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Success {
    /// Probability that a word from here on needs none of what is unavailable, from 0 to 1. Under
    /// [`crate::pdfa::Semantics::Published`] the probabilities of words may sum to more than 1: then it is 1.
    pub words: f64,
    /// Probability that a run ends in an accepting state when it chooses at each state among what is available (ending
    /// included), in proportion to the probabilities, from 0 to 1.
    pub walk: f64,
    /// The states that can be reached now, but from which no accepting state can be reached now, by id.
    pub stranded: Vec<StateId>,
}

/// The prospects from `from` while the symbols `unavailable` cannot be completed. Transitions and ends of probability
/// zero are not taken. All zero when there is no state `from`.
///
/// Both probabilities are exact up to rounding, through a linear system where there are cycles.
///
/// # Complexity
///
/// O((Q + T) log T) for Q states and T transitions; O(C³) for a strongly connected component of C states, up to 300.
///
/// # Example
///
/// ```
/// use goalgraph::outage::success;
/// use goalgraph::pdfa::{Pdfa, Semantics, Symbol};
///
/// let (a, b) = (Symbol(0), Symbol(1));
/// let pdfa = Pdfa::from_words(&[vec![a], vec![a], vec![a], vec![b]]);
/// let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
/// let prospects = success(&pdfa, &probabilities, pdfa.initial, &[b].into());
/// assert_eq!((prospects.words, prospects.walk), (0.75, 1.0));
/// ```
pub fn success(
    pdfa: &Pdfa,
    probabilities: &Probabilities,
    from: StateId,
    unavailable: &BTreeSet<Symbol>,
) -> Success {
    let chain = Chain::without(pdfa, probabilities, unavailable);
    let Ok(from) = chain.ids.binary_search(&from) else {
        return Success::default();
    };
    let live = chain.live();
    let reached = reached(&chain, from);
    let stranded = (0..live.len()).filter(|&state| reached[state] && !live[state]);
    let stranded = stranded.map(|state| chain.ids[state]).collect();
    Success {
        words: ending(&chain, &live, |_| 1.0)[from],
        walk: ending(&chain, &live, |state| available(&chain, state))[from],
        stranded,
    }
}

/// Probability of what is available in `state`, ending included.
fn available(chain: &Chain, state: usize) -> f64 {
    chain.ends[state] + chain.ways[state].iter().map(|way| way.probability).sum::<f64>()
}

/// Probability of ending from each state, all probabilities in it divided by `total`.
fn ending(chain: &Chain, live: &[bool], total: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut ends = Vec::with_capacity(live.len());
    let mut rows: Vec<Row> = Vec::with_capacity(live.len());
    for (state, ways) in chain.ways.iter().enumerate() {
        let total = if live[state] { total(state) } else { 1.0 };
        ends.push(if live[state] { chain.ends[state] / total } else { 0.0 });
        let ways = ways.iter().filter(|way| live[state] && live[way.target]);
        rows.push(ways.map(|way| (way.target, way.probability / total)).collect());
    }
    let solution = solve(Components::of(&rows).sinks_first(), &rows, ends);
    solution.into_iter().map(|probability| probability.clamp(0.0, 1.0)).collect()
}

/// Which states can be reached from `from`, itself included.
fn reached(chain: &Chain, from: usize) -> Vec<bool> {
    let mut reached = vec![false; chain.ids.len()];
    let mut open = vec![from];
    while let Some(state) = open.pop() {
        if !std::mem::replace(&mut reached[state], true) {
            open.extend(chain.ways[state].iter().map(|way| way.target));
        }
    }
    reached
}
