//! An automaton with its probabilities as a Markov chain over numbered states.

use std::collections::BTreeSet;

use super::linear::{Components, Row, solve};
use crate::pdfa::{Pdfa, Probabilities, StateId, Symbol};

/// A way of probability above zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    pub(crate) symbol: Symbol,
    /// Index of the state it leads to.
    pub(crate) target: usize,
    pub(crate) probability: f64,
}

/// States are numbered in the order of their ids; all lists have one entry per state.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// Where words start; none when the automaton has no such state, or (trimmed) no word ends.
    pub(crate) initial: Option<usize>,
    pub(crate) ids: Vec<StateId>,
    /// Probability of ending in each state.
    pub(crate) ends: Vec<f64>,
    /// The ways out of each state, by symbol.
    pub(crate) ways: Vec<Vec<Way>>,
    /// Probability of leaving each state for one from which no end can be reached; zero before [`Chain::trimmed`].
    pub(crate) leaks: Vec<f64>,
}

impl Chain {
    /// Ways of probability zero, and ways to states that do not exist, are left out.
    pub(crate) fn new(pdfa: &Pdfa, probabilities: &Probabilities) -> Self {
        Self::without(pdfa, probabilities, &BTreeSet::new())
    }

    /// As [`Chain::new`], and without the ways of the `unavailable` symbols; the others keep their probabilities.
    pub(crate) fn without(
        pdfa: &Pdfa,
        probabilities: &Probabilities,
        unavailable: &BTreeSet<Symbol>,
    ) -> Self {
        let ids: Vec<StateId> = pdfa.states.keys().copied().collect();
        let index = |id: StateId| ids.binary_search(&id).ok();
        let ways_of = |(&source, state): (&StateId, &crate::pdfa::State)| {
            let way = |(&symbol, way): (&Symbol, &crate::pdfa::Transition)| {
                let probability = probabilities.transition(source, symbol);
                let taken = probability > 0.0 && !unavailable.contains(&symbol);
                index(way.target).filter(|_| taken).map(|target| Way { symbol, target, probability })
            };
            state.transitions.iter().filter_map(way).collect()
        };
        Self {
            initial: index(pdfa.initial),
            ends: ids.iter().map(|&id| probabilities.end(id).max(0.0)).collect(),
            ways: pdfa.states.iter().map(ways_of).collect(),
            leaks: vec![0.0; ids.len()],
            ids,
        }
    }

    /// Which states an end can be reached from.
    pub(crate) fn live(&self) -> Vec<bool> {
        let mut sources = vec![Vec::new(); self.ids.len()];
        for (source, ways) in self.ways.iter().enumerate() {
            for way in ways {
                sources[way.target].push(source);
            }
        }
        reaching(&sources, self.ends.iter().map(|&end| end > 0.0).collect())
    }

    /// Without the states from which no end can be reached: they keep their numbers, but no way leads there.
    pub(crate) fn trimmed(mut self) -> Self {
        let live = self.live();
        for (ways, leak) in self.ways.iter_mut().zip(&mut self.leaks) {
            *leak = ways.iter().filter(|way| !live[way.target]).map(|way| way.probability).sum();
            ways.retain(|way| live[way.target]);
        }
        for (state, _) in live.iter().enumerate().filter(|(_, live)| !**live) {
            self.ways[state].clear();
        }
        self.initial = self.initial.filter(|&state| live[state]);
        self
    }

    /// Probability, from each state of a trimmed chain, that the run ends.
    pub(crate) fn ending(&self) -> Vec<f64> {
        self.solve(self.ends.clone()).into_iter().map(|probability| probability.min(1.0)).collect()
    }

    /// Probability, from the initial state of a trimmed chain, that the run never ends.
    pub(crate) fn endless_mass(&self) -> f64 {
        let Some(initial) = self.initial else {
            return 1.0;
        };
        if self.leaks.iter().all(|&leak| leak == 0.0) {
            0.0
        } else {
            self.solve(self.leaks.clone())[initial].min(1.0)
        }
    }

    fn solve(&self, constants: Vec<f64>) -> Vec<f64> {
        let row = |ways: &Vec<Way>| -> Row { ways.iter().map(|way| (way.target, way.probability)).collect() };
        let rows: Vec<Row> = self.ways.iter().map(row).collect();
        solve(Components::of(&rows).sinks_first(), &rows, constants)
    }
}

/// Which nodes one of the `marked` can be reached from; `sources` lists the predecessors of each node.
pub(crate) fn reaching(sources: &[Vec<usize>], mut marked: Vec<bool>) -> Vec<bool> {
    let mut open: Vec<usize> = (0..marked.len()).filter(|&node| marked[node]).collect();
    while let Some(node) = open.pop() {
        for &source in &sources[node] {
            if !marked[source] {
                marked[source] = true;
                open.push(source);
            }
        }
    }
    marked
}
