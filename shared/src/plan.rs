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
/// O((Q + T) log T) for Q states and T transitions.
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
        let start = Candidate { probability: 1.0, word: Vec::new(), state: from, end: false };
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
                    candidate.probability * self.probabilities.transition(candidate.state, symbol);
                let word = candidate.word.iter().copied().chain([symbol]).collect();
                heap.push(Candidate { probability, word, state: target, end: false });
            }
            if self.accepts(candidate.state) {
                let probability = candidate.probability * self.probabilities.end(candidate.state);
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
    /// everything is available; of equally long ones the one that is preferred first.
    fn meanwhile(&self, from: StateId) -> Plan {
        let everything = BTreeSet::new();
        let later = Search { unavailable: &everything, ..*self };
        let mut longest: Vec<Step> = Vec::new();
        let mut path: Vec<Step> = Vec::new();
        let mut deepest = BTreeMap::from([(from, 0_usize)]);
        let mut open = vec![self.ways(from).into_iter()];
        while let Some(ways) = open.last_mut() {
            let Some((symbol, target)) = ways.next() else {
                open.pop();
                path.pop();
                continue;
            };
            let depth = path.len() + 1;
            let on_path = target == from || path.iter().any(|&(_, state)| state == target);
            let known_as_deep = deepest.get(&target).is_some_and(|&known| known >= depth);
            if on_path || known_as_deep || later.greedy(target).is_none() {
                continue;
            }
            deepest.insert(target, depth);
            path.push((symbol, target));
            if path.len() > longest.len() {
                longest.clone_from(&path);
            }
            open.push(self.ways(target).into_iter());
        }
        self.plan_of(from, &longest, false)
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
    probability: f64,
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
            .total_cmp(&other.probability)
            .then_with(|| other.word.cmp(&self.word))
            .then_with(|| self.end.cmp(&other.end))
    }
}
