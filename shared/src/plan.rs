//! Plans: the order of sub-goals that a robot follows, with what is unavailable left out.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::pdfa::{Pdfa, Probabilities, StateId, Symbol, Word};

/// How a plan is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strategy {
    /// The paper's: at each state the available transition of highest probability, until an accepting state.
    #[default]
    Greedy,
    /// The most probable accepted word.
    MostProbable,
}

/// What to plan.
#[derive(Clone, Debug)]
pub struct PlanRequest {
    /// Where to start.
    pub from: StateId,
    /// Symbols that cannot be completed now.
    pub unavailable: BTreeSet<Symbol>,
    /// How to choose.
    pub strategy: Strategy,
}

/// An order of sub-goals from a state to an accepting one.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The sub-goals to complete, in order.
    pub word: Word,
    /// The states passed: one more than there are symbols, the first is where the plan starts.
    pub states: Vec<StateId>,
    /// Product of the probabilities of its transitions and of ending in its last state.
    pub probability: f64,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NoPlan {
    /// The state to start from does not exist.
    #[error("there is no state {0}")]
    UnknownState(StateId),
    /// No accepting state can be reached without the unavailable sub-goals.
    #[error("no plan: no accepting state can be reached from {from} with what is available")]
    OutOfReach {
        /// Where the plan would start.
        from: StateId,
        /// What can be done meanwhile: the furthest that the preferred order gets while keeping an accepting state in
        /// reach for when everything is available again. Its probability leaves out the end.
        meanwhile: Plan,
    },
}

/// Plans from a state with what is available, by the probabilities given. Transitions of probability zero are not taken.
///
/// When a greedy choice leads to a dead end the planner backs out of it and takes the next best. Ties go to the earlier
/// symbol.
///
/// # Errors
///
/// When the state does not exist, or no accepting state can be reached from it with what is available.
///
/// # Complexity
///
/// O((Q + T) log T) for Q states and T transitions; times the length of words for [`Strategy::MostProbable`], and Q times
/// that in the worst case for what can be done [meanwhile](NoPlan::OutOfReach).
///
/// # Example
///
/// ```
/// use goalgraph::pdfa::{Pdfa, Semantics, Symbol};
/// use goalgraph::plan::{PlanRequest, Strategy, plan};
///
/// let (a, b) = (Symbol(0), Symbol(1));
/// let pdfa = Pdfa::from_words(&[vec![a, b], vec![a, b], vec![b, a]]);
/// let request = PlanRequest { from: pdfa.initial, unavailable: [].into(), strategy: Strategy::Greedy };
/// let plan = plan(&pdfa, &pdfa.probabilities(Semantics::MaximumLikelihood), &request)?;
/// assert_eq!(plan.word, [a, b]);
/// # Ok::<(), goalgraph::plan::NoPlan>(())
/// ```
pub fn plan(pdfa: &Pdfa, probabilities: &Probabilities, request: &PlanRequest) -> Result<Plan, NoPlan> {
    if !pdfa.states.contains_key(&request.from) {
        return Err(NoPlan::UnknownState(request.from));
    }
    let search = Search { pdfa, probabilities, unavailable: &request.unavailable };
    let found = match request.strategy {
        Strategy::Greedy => search.greedy(request.from),
        Strategy::MostProbable => search.most_probable(request.from),
    };
    found.ok_or_else(|| NoPlan::OutOfReach { from: request.from, meanwhile: search.meanwhile(request.from) })
}

/// What all searches look at.
struct Search<'a> {
    pdfa: &'a Pdfa,
    probabilities: &'a Probabilities,
    unavailable: &'a BTreeSet<Symbol>,
}

/// One step on a way: the symbol taken and the state it leads to.
type Step = (Symbol, StateId);

impl Search<'_> {
    /// The available ways out of `source`, best first; ties go to the earlier symbol.
    fn ways(&self, source: StateId) -> Vec<Step> {
        let Some(state) = self.pdfa.states.get(&source) else {
            return Vec::new();
        };
        let probability = |symbol: Symbol| self.probabilities.transition(source, symbol);
        let mut ways: Vec<Step> = state
            .transitions
            .iter()
            .filter(|(symbol, _)| !self.unavailable.contains(symbol) && probability(**symbol) > 0.0)
            .map(|(&symbol, transition)| (symbol, transition.target))
            .collect();
        ways.sort_by(|a, b| probability(b.0).total_cmp(&probability(a.0)));
        ways
    }

    fn accepts(&self, state: StateId) -> bool {
        self.probabilities.end(state) > 0.0
    }

    /// Depth first along the best way; a state that was left without success is never entered again.
    fn greedy(&self, from: StateId) -> Option<Plan> {
        let mut entered = BTreeSet::from([from]);
        let mut path: Vec<Step> = Vec::new();
        let mut open = vec![self.ways(from).into_iter()];
        if self.accepts(from) {
            return Some(self.plan_of(from, &path, true));
        }
        while let Some(ways) = open.last_mut() {
            let Some((symbol, target)) = ways.next() else {
                open.pop();
                path.pop();
                continue;
            };
            if !entered.insert(target) {
                continue;
            }
            path.push((symbol, target));
            if self.accepts(target) {
                return Some(self.plan_of(from, &path, true));
            }
            open.push(self.ways(target).into_iter());
        }
        None
    }

    /// Best first over the product of probabilities (Dijkstra's algorithm over -ln p, without the logarithm).
    fn most_probable(&self, from: StateId) -> Option<Plan> {
        let start = Candidate { probability: Product::ONE, word: Vec::new(), state: from, end: false };
        let mut heap = BinaryHeap::from([start]);
        let mut settled = BTreeSet::new();
        while let Some(candidate) = heap.pop() {
            if candidate.end {
                return Some(self.plan_of(from, &self.steps(from, &candidate.word), true));
            }
            if !settled.insert(candidate.state) {
                continue;
            }
            for (symbol, target) in self.ways(candidate.state) {
                let probability =
                    candidate.probability.times(self.probabilities.transition(candidate.state, symbol));
                let word = candidate.word.iter().copied().chain([symbol]).collect();
                heap.push(Candidate { probability, word, state: target, end: false });
            }
            if self.accepts(candidate.state) {
                let probability = candidate.probability.times(self.probabilities.end(candidate.state));
                heap.push(Candidate { probability, end: true, ..candidate });
            }
        }
        None
    }

    /// The steps that `word` takes from `from`, as far as there are transitions for it.
    fn steps(&self, from: StateId, word: &[Symbol]) -> Vec<Step> {
        let mut source = from;
        let step = |&symbol: &Symbol| {
            source = self.pdfa.transition(source, symbol)?.target;
            Some((symbol, source))
        };
        word.iter().map_while(step).collect()
    }

    /// The longest simple way along available transitions that keeps an accepting state in reach of a future in which
    /// everything is available; of equally long ones the one that is preferred first. Where cycles make that a search
    /// through all ways, a state is only looked at again when it is reached by a longer way than before.
    fn meanwhile(&self, from: StateId) -> Plan {
        let live = self.live_when_all_is_available();
        let mut longest: Vec<Step> = Vec::new();
        let mut path: Vec<Step> = Vec::new();
        let mut on_path = BTreeSet::from([from]);
        let mut deepest = BTreeMap::from([(from, 0_usize)]);
        let mut open = vec![self.ways(from).into_iter()];
        while let Some(ways) = open.last_mut() {
            let Some((symbol, target)) = ways.next() else {
                if path.len() > longest.len() {
                    longest.clone_from(&path);
                }
                open.pop();
                if let Some((_, left)) = path.pop() {
                    on_path.remove(&left);
                }
                continue;
            };
            let depth = path.len() + 1;
            let known_as_deep = deepest.get(&target).is_some_and(|&known| known >= depth);
            if known_as_deep || on_path.contains(&target) || !live.contains(&target) {
                continue;
            }
            deepest.insert(target, depth);
            on_path.insert(target);
            path.push((symbol, target));
            open.push(self.ways(target).into_iter());
        }
        self.plan_of(from, &longest, false)
    }

    /// The states from which an accepting state can be reached when everything is available.
    fn live_when_all_is_available(&self) -> BTreeSet<StateId> {
        let mut sources: BTreeMap<StateId, Vec<StateId>> = BTreeMap::new();
        for (source, symbol, transition) in self.pdfa.transitions() {
            if self.probabilities.transition(source, symbol) > 0.0 {
                sources.entry(transition.target).or_default().push(source);
            }
        }
        let mut live = BTreeSet::new();
        let mut open: Vec<StateId> =
            self.pdfa.states.keys().copied().filter(|&id| self.accepts(id)).collect();
        while let Some(id) = open.pop() {
            if live.insert(id) {
                open.extend(sources.remove(&id).unwrap_or_default());
            }
        }
        live
    }

    /// The plan along `steps`; its probability counts the end when it is `complete`.
    fn plan_of(&self, from: StateId, steps: &[Step], complete: bool) -> Plan {
        let mut states = vec![from];
        let mut probability = 1.0;
        for &(symbol, target) in steps {
            let source = states[states.len() - 1];
            probability *= self.probabilities.transition(source, symbol);
            states.push(target);
        }
        if complete {
            probability *= self.probabilities.end(states[states.len() - 1]);
        }
        Plan { word: steps.iter().map(|&(symbol, _)| symbol).collect(), states, probability }
    }
}

/// An end of the search, ordered by probability, then by the earlier word.
#[derive(Clone, Debug, PartialEq)]
struct Candidate {
    probability: Product,
    word: Word,
    state: StateId,
    end: bool,
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.probability
            .cmp(&other.probability)
            .then_with(|| other.word.cmp(&self.word))
            .then_with(|| self.end.cmp(&other.end))
    }
}

/// A product of probabilities that long words do not make zero: `mantissa` / 2^(256 `scale`).
///
/// The mantissa is at least 2^-256, and below 1 unless `scale` is zero, so every number is written in one way.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Product {
    scale: u32,
    mantissa: f64,
}

impl Product {
    const ONE: Self = Self { scale: 0, mantissa: 1.0 };

    /// This product with one more factor, above 0 and at most 1. Scaling by powers of two rounds nothing.
    fn times(self, probability: f64) -> Self {
        let factor = Self { scale: 0, mantissa: probability }.normalized();
        let mantissa = self.mantissa * factor.mantissa;
        Self { scale: self.scale + factor.scale, mantissa }.normalized()
    }

    fn normalized(mut self) -> Self {
        const UNIT: f64 = 1.157_920_892_373_162e77;
        while self.mantissa > 0.0 && self.mantissa < 1.0 / UNIT {
            self.mantissa *= UNIT;
            self.scale += 1;
        }
        self
    }
}

impl Eq for Product {}

impl PartialOrd for Product {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Product {
    fn cmp(&self, other: &Self) -> Ordering {
        other.scale.cmp(&self.scale).then_with(|| self.mantissa.total_cmp(&other.mantissa))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_of_many_factors_keeps_its_order() {
        let product = |factors: &[f64]| factors.iter().fold(Product::ONE, |product, &p| product.times(p));
        let check = |larger: &[f64], smaller: &[f64]| assert!(product(larger) > product(smaller));
        check(&[1.0], &[0.5]);
        check(&vec![0.5; 5000], &vec![0.5; 5001]);
        check(&vec![0.1; 5000], &[&vec![0.1; 4999][..], &[0.099]].concat());
        check(&[1e-300, 1e-300], &[1e-320, 1e-300]);
        assert_eq!(product(&vec![0.5; 4096]), product(&vec![0.25; 2048]));
    }
}
