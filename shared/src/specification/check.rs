//! What is wrong, or may be wrong, with a specification.

use std::collections::BTreeSet;

use petgraph::Direction;
use petgraph::algo::toposort;
use petgraph::graphmap::DiGraphMap;
use petgraph::visit::Bfs;

use super::{Ball, Specification};
use crate::pdfa::{Pdfa, Probabilities, StateId, Symbol, Transition};

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
    /// Errors: a state cannot be reached, or is a dead end: no word ends there or further on. Warnings: an accepting
    /// state or a transition of probability zero, a sub-goal that no transition uses, sub-goals whose balls overlap, a
    /// cycle (the language is infinite).
    ///
    /// # Complexity
    ///
    /// O(Q + T + S²) for Q states, T transitions and S sub-goals.
    pub fn check(&self) -> Vec<Problem> {
        let probabilities = self.pdfa.probabilities(self.semantics);
        let taken = |&(source, symbol, _): &(StateId, Symbol, &Transition)| {
            probabilities.transition(source, symbol) > 0.0
        };
        let taken = graph(&self.pdfa, self.pdfa.transitions().filter(taken));
        let mut problems = state_problems(&self.pdfa, &probabilities, &taken);
        problems.extend(self.transition_problems(&probabilities));
        problems.extend(self.sub_goal_problems());
        if toposort(&taken, None).is_err() {
            let message = "a cycle: the automaton accepts words of any length".to_owned();
            let place = self.pdfa.initial.to_string();
            problems.push(Problem { severity: Severity::Warning, place, message });
        }
        problems.sort_by_key(|problem| problem.severity);
        problems
    }

    fn transition_problems(&self, probabilities: &Probabilities) -> Vec<Problem> {
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

/// `taken` holds the transitions of probability above zero.
fn state_problems(
    pdfa: &Pdfa,
    probabilities: &Probabilities,
    taken: &DiGraphMap<StateId, ()>,
) -> Vec<Problem> {
    let all = graph(pdfa, pdfa.transitions());
    let mut reachable = BTreeSet::new();
    let mut forward = Bfs::new(&all, pdfa.initial);
    while let Some(id) = forward.next(&all) {
        reachable.insert(id);
    }
    let ends = |id: StateId| probabilities.end(id) > 0.0;
    let live = live_states(pdfa.states.keys().copied().filter(|&id| ends(id)).collect(), taken);
    let mut problems = Vec::new();
    for (&id, state) in &pdfa.states {
        let (severity, message) = if !reachable.contains(&id) {
            (Severity::Error, format!("{id} cannot be reached from the initial state {}", pdfa.initial))
        } else if !live.contains(&id) && state.accepting {
            (Severity::Error, format!("{id} is accepting, but of weight 0: no word ends there or further on"))
        } else if !live.contains(&id) {
            (Severity::Error, format!("{id} is a dead end: no accepting state can be reached from it"))
        } else if state.accepting && !ends(id) {
            (Severity::Warning, format!("{id} is accepting, but with probability 0: no word ends there"))
        } else {
            continue;
        };
        problems.push(Problem { severity, place: id.to_string(), message });
    }
    problems
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

fn overlap(a: &Ball, b: &Ball) -> bool {
    if a.subset != b.subset {
        return false;
    }
    let squared: f64 = a.center.iter().zip(&b.center).map(|(x, y)| (x - y) * (x - y)).sum();
    squared.sqrt() < a.radius + b.radius
}
