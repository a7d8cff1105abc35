//! States and transitions that no word uses, and cycles.

use std::collections::BTreeSet;

use petgraph::Direction;
use petgraph::algo::kosaraju_scc;
use petgraph::graphmap::DiGraphMap;
use petgraph::visit::Bfs;

use super::{Problem, ProblemKind, Severity};
use crate::pdfa::{Pdfa, Probabilities, StateId, Symbol, Transition};
use crate::specification::Specification;

/// An automaton with its probabilities.
pub(super) struct Automaton<'a> {
    specification: &'a Specification,
    pdfa: &'a Pdfa,
    probabilities: Probabilities,
    /// All states, and the transitions of probability above zero.
    taken: DiGraphMap<StateId, ()>,
}

impl<'a> Automaton<'a> {
    pub(super) fn new(specification: &'a Specification) -> Self {
        let pdfa = &specification.pdfa;
        let probabilities = pdfa.probabilities(specification.semantics);
        let taken = |&(source, symbol, _): &(StateId, Symbol, &Transition)| {
            probabilities.transition(source, symbol) > 0.0
        };
        let taken = graph(pdfa, pdfa.transitions().filter(taken));
        Self { specification, pdfa, probabilities, taken }
    }

    pub(super) fn state_problems(&self) -> Vec<Problem> {
        let reachable = self.reachable();
        let ends = |id: StateId| self.probabilities.end(id) > 0.0;
        let live =
            live_states(self.pdfa.states.keys().copied().filter(|&id| ends(id)).collect(), &self.taken);
        let initial = self.pdfa.initial;
        let mut problems = Vec::new();
        if !live.contains(&initial) {
            let message = format!("no words: nothing is accepted, for no way leads from {initial} to an end");
            let kind = ProblemKind::NothingAccepted(initial);
            problems.push(Problem { severity: Severity::Error, kind, message });
        }
        for (&id, state) in &self.pdfa.states {
            let (severity, kind, message) = if !reachable.contains(&id) {
                let message = format!("{id} cannot be reached from the initial state {initial}");
                (Severity::Error, ProblemKind::Unreachable(id), message)
            } else if !live.contains(&id) && state.accepting {
                let message = format!("{id} is accepting, but of weight 0: no word ends there or further on");
                (Severity::Error, ProblemKind::NoWeight(id), message)
            } else if !live.contains(&id) {
                let message = format!("{id} is a dead end: no accepting state can be reached from it");
                (Severity::Error, ProblemKind::DeadEnd(id), message)
            } else if state.accepting && !ends(id) {
                let message = format!("{id} is accepting, but with probability 0: no word ends there");
                (Severity::Warning, ProblemKind::NeverEnds(id), message)
            } else {
                continue;
            };
            problems.push(Problem { severity, kind, message });
        }
        problems
    }

    pub(super) fn transition_problems(&self) -> Vec<Problem> {
        let probability = |source, symbol| self.probabilities.transition(source, symbol);
        let never = self.pdfa.transitions().filter(|&(source, symbol, _)| probability(source, symbol) == 0.0);
        never
            .map(|(source, symbol, transition)| Problem {
                severity: Severity::Warning,
                kind: ProblemKind::NeverTaken(source, symbol, transition.target),
                message: format!(
                    "{} from {source} has probability 0 and is never taken",
                    self.specification.name_of(symbol)
                ),
            })
            .collect()
    }

    /// One problem for every strongly connected part with a cycle.
    pub(super) fn cycles(&self) -> Vec<Problem> {
        let mut parts = kosaraju_scc(&self.taken);
        parts.retain(|part| part.len() > 1 || part.iter().any(|&id| self.taken.contains_edge(id, id)));
        for part in &mut parts {
            part.sort_unstable();
        }
        parts.sort_unstable();
        let problem = |states: Vec<StateId>| {
            let message =
                format!("a cycle through {}: the automaton accepts words of any length", listed(&states));
            Problem { severity: Severity::Warning, kind: ProblemKind::Cycle(states), message }
        };
        parts.into_iter().map(problem).collect()
    }

    fn reachable(&self) -> BTreeSet<StateId> {
        let all = graph(self.pdfa, self.pdfa.transitions());
        let mut reachable = BTreeSet::new();
        let mut forward = Bfs::new(&all, self.pdfa.initial);
        while let Some(id) = forward.next(&all) {
            reachable.insert(id);
        }
        reachable
    }
}

/// All states, and of the transitions those given.
fn graph<'a>(
    pdfa: &Pdfa,
    transitions: impl Iterator<Item = (StateId, Symbol, &'a Transition)>,
) -> DiGraphMap<StateId, ()> {
    let mut graph = DiGraphMap::new();
    for &id in pdfa.states.keys() {
        graph.add_node(id);
    }
    for (source, _, transition) in transitions {
        graph.add_edge(source, transition.target, ());
    }
    graph
}

/// The states from which one of `ends` can be reached.
fn live_states(mut ends: Vec<StateId>, graph: &DiGraphMap<StateId, ()>) -> BTreeSet<StateId> {
    let mut live = BTreeSet::new();
    while let Some(id) = ends.pop() {
        if live.insert(id) {
            ends.extend(graph.neighbors_directed(id, Direction::Incoming));
        }
    }
    live
}

/// The first few states, and how many more there are.
fn listed(states: &[StateId]) -> String {
    const SHOWN: usize = 8;
    let shown: Vec<String> = states.iter().take(SHOWN).map(StateId::to_string).collect();
    match states.len().saturating_sub(SHOWN) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}
