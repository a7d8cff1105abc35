//! How demonstrations went on from each state, and from which states they could have gone on like that.

use std::collections::{BTreeMap, BTreeSet};

use super::positions;
use crate::pdfa::{Pdfa, Symbol};
use crate::specification::Specification;

/// (Distinct rests) · (states) stays below this.
const LARGEST: usize = 2_000_000;

/// The rests of demonstrations, and which states accept them.
pub(super) struct Continuations {
    /// For each rest, by state: whether it is accepted from there.
    accepted: Vec<Vec<bool>>,
    /// For each state the different rests that went on from there, each with the first demonstration that did; in the
    /// order of the demonstrations.
    went_on: Vec<Vec<(usize, usize)>>,
}

impl Continuations {
    pub(super) fn of(specification: &Specification) -> Self {
        let automaton = Automaton::of(&specification.pdfa);
        let mut rests = Rests { accepted: vec![automaton.accepting.clone()], longer: BTreeMap::new() };
        let mut went_on = vec![Vec::new(); automaton.accepting.len()];
        let mut known = BTreeSet::new();
        for (index, demonstration) in specification.demonstrations.iter().enumerate() {
            let word = &demonstration.word;
            let passed = automaton.passed(word);
            if passed.len() != word.len() + 1 || !passed.last().is_some_and(|&last| automaton.accepting[last])
            {
                continue;
            }
            if (rests.accepted.len() + word.len()).saturating_mul(automaton.accepting.len()) > LARGEST {
                break;
            }
            let mut rest = 0;
            for (position, &state) in passed.iter().enumerate().rev() {
                if let Some(&symbol) = word.get(position) {
                    rest = rests.before(symbol, rest, &automaton);
                }
                if known.insert((state, rest)) {
                    went_on[state].push((rest, index));
                }
            }
        }
        Self { accepted: rests.accepted, went_on }
    }

    /// The first demonstration whose rest from one of the states is accepted there, but not from the other.
    pub(super) fn distinguishing(&self, a: usize, b: usize) -> Option<usize> {
        self.only(a, b).into_iter().chain(self.only(b, a)).min()
    }

    /// The first demonstration that went on from `from` as is not accepted from `other`.
    fn only(&self, from: usize, other: usize) -> Option<usize> {
        let first = self.went_on[from].iter().find(|&&(rest, _)| !self.accepted[rest][other]);
        first.map(|&(_, demonstration)| demonstration)
    }
}

/// The automaton over numbered states, with ways and ends of weight zero left out.
struct Automaton {
    initial: Option<usize>,
    accepting: Vec<bool>,
    ways: Vec<BTreeMap<Symbol, usize>>,
}

impl Automaton {
    fn of(pdfa: &Pdfa) -> Self {
        let positions = positions(pdfa.states.keys().copied());
        let ways = pdfa.states.values().map(|state| {
            let taken = state.transitions.iter().filter(|(_, way)| way.weight > 0.0);
            taken.filter_map(|(&symbol, way)| Some((symbol, *positions.get(&way.target)?))).collect()
        });
        Self {
            initial: positions.get(&pdfa.initial).copied(),
            accepting: pdfa.states.values().map(|state| state.accepting && state.end_weight > 0.0).collect(),
            ways: ways.collect(),
        }
    }

    /// The states that `word` passes, as far as there are ways for it.
    fn passed(&self, word: &[Symbol]) -> Vec<usize> {
        let mut passed: Vec<usize> = self.initial.into_iter().collect();
        for symbol in word {
            let Some(&next) = passed.last().and_then(|&state| self.ways[state].get(symbol)) else {
                break;
            };
            passed.push(next);
        }
        passed
    }
}

/// The distinct rests; the first is the empty one.
struct Rests {
    accepted: Vec<Vec<bool>>,
    /// By first symbol and what follows it.
    longer: BTreeMap<(Symbol, usize), usize>,
}

impl Rests {
    /// The rest that is `symbol` and then `rest`.
    fn before(&mut self, symbol: Symbol, rest: usize, automaton: &Automaton) -> usize {
        let next = self.accepted.len();
        let longer = *self.longer.entry((symbol, rest)).or_insert(next);
        if longer == next {
            let accepts = |ways: &BTreeMap<Symbol, usize>| {
                ways.get(&symbol).is_some_and(|&target| self.accepted[rest][target])
            };
            let accepted = automaton.ways.iter().map(accepts).collect();
            self.accepted.push(accepted);
        }
        longer
    }
}
