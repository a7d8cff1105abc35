//! The test itself: frequencies against Hoeffding's bound.

use std::collections::BTreeSet;

use super::positions;
use crate::pdfa::{Pdfa, StateId, Symbol};

/// What words did, state by state; states are numbered in the order of their ids.
pub(super) struct Evidence {
    ids: Vec<StateId>,
    observed: Vec<Observed>,
    /// sqrt(ln(2/alpha)/2).
    confidence: f64,
}

/// What words did in one state.
struct Observed {
    /// How many passed or ended.
    words: u64,
    ended: u64,
    /// Symbol, how many took it, and where it leads when that state exists; by symbol.
    ways: Vec<(Symbol, u64, Option<usize>)>,
}

/// What a comparison of two states found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Comparison {
    /// Largest difference divided by its bound; the states are compatible below 1.
    pub(super) score: f64,
    /// How many outcomes were compared.
    pub(super) outcomes: usize,
}

impl Evidence {
    pub(super) fn of(pdfa: &Pdfa, alpha: f64) -> Self {
        let positions = positions(pdfa.states.keys().copied());
        let mut observed = Vec::with_capacity(positions.len());
        for state in pdfa.states.values() {
            let ways = state.transitions.iter();
            let ways: Vec<_> =
                ways.map(|(&symbol, way)| (symbol, way.count, positions.get(&way.target).copied())).collect();
            let words = ways.iter().fold(state.end_count, |sum, &(_, count, _)| sum.saturating_add(count));
            observed.push(Observed { words, ended: state.end_count, ways });
        }
        let confidence = ((2.0 / alpha).ln() / 2.0).max(0.0).sqrt();
        Self { ids: pdfa.states.keys().copied().collect(), observed, confidence }
    }

    pub(super) fn id(&self, state: usize) -> StateId {
        self.ids[state]
    }

    /// How many words passed `state` or ended there.
    pub(super) fn seen(&self, state: usize) -> u64 {
        self.observed[state].words
    }

    /// The states that words passed, in order; of more than `number` those that most passed.
    pub(super) fn most_seen(&self, number: usize) -> Vec<usize> {
        let mut states: Vec<usize> = (0..self.ids.len()).filter(|&state| self.seen(state) > 0).collect();
        states.sort_by_key(|&state| (std::cmp::Reverse(self.seen(state)), state));
        states.truncate(number);
        states.sort_unstable();
        states
    }

    /// Compares the outcomes of two states, not where they lead.
    pub(super) fn compare_once(&self, a: usize, b: usize) -> Comparison {
        let (a, b) = (&self.observed[a], &self.observed[b]);
        if a.words == 0 || b.words == 0 {
            return Comparison::default();
        }
        let (words_a, words_b) = (a.words as f64, b.words as f64);
        let mut largest = (a.ended as f64 / words_a - b.ended as f64 / words_b).abs();
        let mut outcomes = 1;
        for_each_symbol(a, b, |way_a, way_b| {
            let frequency = |way: Option<&Taken>, words: f64| way.map_or(0.0, |way| way.1 as f64 / words);
            largest = largest.max((frequency(way_a, words_a) - frequency(way_b, words_b)).abs());
            outcomes += 1;
        });
        let bound = self.confidence * (1.0 / words_a.sqrt() + 1.0 / words_b.sqrt());
        let score = if largest == 0.0 { 0.0 } else { largest / bound };
        Comparison { score, outcomes }
    }

    /// Compares two states and all that the same words lead to from both, each pair once, while `budget` lasts.
    pub(super) fn compare(&self, a: usize, b: usize, budget: &mut usize) -> Comparison {
        let mut all = Comparison::default();
        let mut compared = BTreeSet::new();
        let mut open = vec![(a, b)];
        while let Some((a, b)) = open.pop() {
            let pair = (a.min(b), a.max(b));
            if a == b || *budget == 0 || self.seen(a) == 0 || self.seen(b) == 0 || !compared.insert(pair) {
                continue;
            }
            *budget -= 1;
            let here = self.compare_once(a, b);
            all.score = all.score.max(here.score);
            all.outcomes += here.outcomes;
            for_each_symbol(&self.observed[a], &self.observed[b], |way_a, way_b| {
                if let (Some((_, _, Some(to_a))), Some((_, _, Some(to_b)))) = (way_a, way_b) {
                    open.push((*to_a, *to_b));
                }
            });
        }
        all
    }
}

type Taken = (Symbol, u64, Option<usize>);

/// Calls `compare` for every symbol that leads out of one of the two, in order.
fn for_each_symbol(a: &Observed, b: &Observed, mut compare: impl FnMut(Option<&Taken>, Option<&Taken>)) {
    let (mut a, mut b) = (a.ways.iter().peekable(), b.ways.iter().peekable());
    loop {
        let next = a.peek().map(|way| way.0).into_iter().chain(b.peek().map(|way| way.0)).min();
        let Some(symbol) = next else {
            return;
        };
        compare(a.next_if(|way| way.0 == symbol), b.next_if(|way| way.0 == symbol));
    }
}
