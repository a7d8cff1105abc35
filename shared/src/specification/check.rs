//! What is wrong, or may be wrong, with a specification.

mod automaton;
mod problem;
mod sub_goals;

use super::Specification;

pub use problem::{Place, Problem, ProblemKind, Severity};

impl Specification {
    /// The errors of [`check`](Self::check) alone: what keeps a robot from being given this.
    ///
    /// # Complexity
    ///
    /// O(Q + T) for Q states and T transitions.
    pub fn errors(&self) -> Vec<Problem> {
        let mut problems = automaton::Automaton::new(self).state_problems();
        problems.retain(|problem| problem.severity == Severity::Error);
        problems
    }

    /// All problems, errors first, each group in the order of states, transitions and sub-goals, cycles last.
    ///
    /// Errors: nothing is accepted, a state cannot be reached, or is a dead end: no word ends there or further on.
    /// Warnings: an accepting state or a transition of probability zero, a sub-goal that no transition uses, sub-goals
    /// whose balls overlap, cycles (the language is infinite).
    ///
    /// # Complexity
    ///
    /// O(Q + T + S²) for Q states, T transitions and S sub-goals.
    pub fn check(&self) -> Vec<Problem> {
        let automaton = automaton::Automaton::new(self);
        let mut problems = automaton.state_problems();
        problems.extend(automaton.transition_problems());
        problems.extend(sub_goals::sub_goal_problems(self));
        problems.extend(automaton.cycles());
        problems.sort_by_key(|problem| problem.severity);
        problems
    }
}
