//! One-click fixes: for a problem that [`Specification::check`] found, a transaction that makes it go away.

use crate::edit::{Edit, Pruned};
use crate::history::Transaction;
use crate::pdfa::{State, StateId, Symbol};
use crate::specification::{Problem, ProblemKind, Specification};

/// What makes `problem`, which `specification` has, go away; none where only an expert can tell what was meant, or where
/// the fix would do more harm than the problem.
///
/// - A state that cannot be reached is pruned, and so is a dead end; one in which demonstrations ended is made accepting
///   instead.
/// - Weights that leave no end go back to the counts; an end without any evidence gets the weight of one demonstration.
/// - A state that is accepting, but in which no word ends, is accepting no more.
/// - A transition that is never taken is pruned.
/// - A sub-goal that is not used is removed. Sub-goals of one subset whose balls overlap are merged: words and automaton are
///   read again then, so not without demonstrations.
/// - Nothing fixes an automaton that accepts nothing, and a cycle may be meant.
///
/// `next_state` is the first id for new states, as [`History::next_state`](crate::history::History::next_state) gives it.
///
/// # Complexity
///
/// O(S + T) for S sub-goals and the transitions T of one state; that of [`Specification::check`] on a copy where a state is
/// to be given an end.
pub fn fix(specification: &Specification, problem: &Problem, next_state: StateId) -> Option<Transaction> {
    let edit = match problem.kind {
        ProblemKind::Unreachable(state) => prune(specification, state)?,
        ProblemKind::DeadEnd(state) => dead_end(specification, problem, state)?,
        ProblemKind::NoWeight(state) => {
            let ways = [Edit::ResetWeights { state }, Edit::SetAccepting { state, accepting: true }];
            ways.into_iter().find(|edit| helps(specification, edit, problem))?
        }
        ProblemKind::NeverEnds(state) => Edit::SetAccepting { state, accepting: false },
        ProblemKind::NeverTaken(source, symbol, _) => {
            Edit::PruneTransition { source, symbol, ways: Pruned::Cut }
        }
        ProblemKind::Unused(symbol) => Edit::RemoveSubGoal { symbol, first_new: next_state },
        ProblemKind::Overlap(kept, merged) => overlap(specification, kept, merged, next_state)?,
        ProblemKind::NothingAccepted(_) | ProblemKind::Cycle(_) => return None,
    };
    Some(Transaction { label: edit.label(specification), edits: vec![edit] })
}

fn prune(specification: &Specification, state: StateId) -> Option<Edit> {
    (state != specification.pdfa.initial).then_some(Edit::PruneState { state, ways: Pruned::Cut })
}

fn dead_end(specification: &Specification, problem: &Problem, state: StateId) -> Option<Edit> {
    let ended = |state: &State| state.end_count > 0 || state.end_weight > 0.0;
    let accept = Edit::SetAccepting { state, accepting: true };
    if specification.pdfa.states.get(&state).is_some_and(ended) && helps(specification, &accept, problem) {
        return Some(accept);
    }
    prune(specification, state)
}

fn overlap(specification: &Specification, kept: Symbol, merged: Symbol, first_new: StateId) -> Option<Edit> {
    if specification.demonstrations.is_empty() {
        return None;
    }
    let subset = |symbol| Some(&specification.sub_goal(symbol)?.ball.as_ref()?.subset);
    let is_one = subset(kept)? == subset(merged)?;
    is_one.then_some(Edit::MergeSubGoals { kept, merged, first_new })
}

/// Whether the problem is gone after the edit.
fn helps(specification: &Specification, edit: &Edit, problem: &Problem) -> bool {
    let mut after = specification.clone();
    edit.apply(&mut after).is_ok() && after.check().iter().all(|other| other.kind != problem.kind)
}
