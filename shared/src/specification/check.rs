//! What is wrong, or may be wrong, with a specification.

use std::collections::BTreeSet;

use petgraph::Direction;
use petgraph::algo::toposort;
use petgraph::graphmap::DiGraphMap;
use petgraph::visit::Bfs;

use super::{Ball, Specification};
use crate::pdfa::{Pdfa, StateId};

/// How much a problem matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// A robot must not be given this.
    Error,
    /// Worth a look.
    Warning,
}

/// One finding, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// How much it matters.
    pub severity: Severity,
    /// The state, transition or sub-goal that it is about, such as `q3`, `q0 g1 q2` or `g1`.
    pub place: String,
    /// One sentence.
    pub message: String,
}

impl Specification {
    /// All problems, errors first, each group in the order of states, transitions and sub-goals.
    ///
    /// Errors: no accepting state can be reached, a state is unreachable or a dead end. Warnings: a transition of
    /// probability zero, a sub-goal that no transition uses, sub-goals whose balls overlap, a cycle (the language is
    /// infinite).
    ///
    /// # Complexity
    ///
    /// O(Q + T + S²) for Q states, T transitions and S sub-goals.
    pub fn check(&self) -> Vec<Problem> {
        let graph = graph(&self.pdfa);
        let mut problems = state_problems(&self.pdfa, &graph);
        problems.extend(self.transition_problems());
        problems.extend(self.sub_goal_problems());
        if toposort(&graph, None).is_err() {
            let message = "a cycle: the automaton accepts words of any length".to_owned();
            let place = self.pdfa.initial.to_string();
            problems.push(Problem { severity: Severity::Warning, place, message });
        }
        problems.sort_by_key(|problem| problem.severity);
        problems
    }

    fn transition_problems(&self) -> Vec<Problem> {
        let probabilities = self.pdfa.probabilities(self.semantics);
        let zero = self
            .pdfa
            .transitions()
            .filter(|&(source, symbol, _)| probabilities.transition(source, symbol) == 0.0);
        zero.map(|(source, symbol, transition)| Problem {
            severity: Severity::Warning,
            place: format!("{source} {symbol} {}", transition.target),
            message: format!("{} from {source} has probability 0 and is never taken", self.name_of(symbol)),
        })
        .collect()
    }

    fn sub_goal_problems(&self) -> Vec<Problem> {
        let used: BTreeSet<_> = self.pdfa.transitions().map(|(_, symbol, _)| symbol).collect();
        let mut problems = Vec::new();
        for (index, sub_goal) in self.sub_goals.iter().enumerate() {
            let place = sub_goal.id.to_string();
            let severity = Severity::Warning;
            if !used.contains(&sub_goal.id) {
                let message = format!("{} is used by no transition", sub_goal.name);
                problems.push(Problem { severity, place: place.clone(), message });
            }
            for other in &self.sub_goals[..index] {
                if let (Some(ball), Some(other_ball)) = (&sub_goal.ball, &other.ball)
                    && overlap(ball, other_ball)
                {
                    let message = format!("the balls of {} and {} overlap", other.name, sub_goal.name);
                    problems.push(Problem { severity, place: place.clone(), message });
                }
            }
        }
        problems
    }
}

fn graph(pdfa: &Pdfa) -> DiGraphMap<StateId, ()> {
    let mut graph = DiGraphMap::new();
    for &id in pdfa.states.keys() {
        graph.add_node(id);
    }
    for (source, _, transition) in pdfa.transitions() {
        graph.add_edge(source, transition.target, ());
    }
    graph
}

fn state_problems(pdfa: &Pdfa, graph: &DiGraphMap<StateId, ()>) -> Vec<Problem> {
    let mut reachable = BTreeSet::new();
    let mut forward = Bfs::new(graph, pdfa.initial);
    while let Some(id) = forward.next(graph) {
        reachable.insert(id);
    }
    let live = live_states(pdfa, graph);
    let mut problems = Vec::new();
    for &id in pdfa.states.keys() {
        let message = if !reachable.contains(&id) {
            format!("{id} cannot be reached from the initial state {}", pdfa.initial)
        } else if !live.contains(&id) {
            format!("{id} is a dead end: no accepting state can be reached from it")
        } else {
            continue;
        };
        problems.push(Problem { severity: Severity::Error, place: id.to_string(), message });
    }
    problems
}

/// The states from which an accepting state can be reached.
fn live_states(pdfa: &Pdfa, graph: &DiGraphMap<StateId, ()>) -> BTreeSet<StateId> {
    let mut live = BTreeSet::new();
    let mut stack: Vec<StateId> =
        pdfa.states.iter().filter(|(_, state)| state.accepting).map(|(&id, _)| id).collect();
    while let Some(id) = stack.pop() {
        if live.insert(id) {
            stack.extend(graph.neighbors_directed(id, Direction::Incoming));
        }
    }
    live
}

fn overlap(a: &Ball, b: &Ball) -> bool {
    if a.subset != b.subset {
        return false;
    }
    let squared: f64 = a.center.iter().zip(&b.center).map(|(x, y)| (x - y) * (x - y)).sum();
    squared.sqrt() < a.radius + b.radius
}
