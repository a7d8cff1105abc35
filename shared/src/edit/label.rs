//! What an edit is called in the list of what was done.

use super::name::shortened;
use super::{Edit, Outcome, Pruned};
use crate::pdfa::{Semantics, StateId, Symbol};
use crate::specification::Specification;

impl Edit {
    /// What the edit does to `specification`, which is the one before it, in a few words: `Merge q3 into q2`,
    /// `Reweight red 1 from q0 to 0.4`. Names are shortened to 40 characters.
    pub fn label(&self, specification: &Specification) -> String {
        let state = |id: &StateId| {
            let name = specification.pdfa.states.get(id).and_then(|state| state.name.as_deref());
            name.map_or_else(|| id.to_string(), shortened)
        };
        let sub_goal = |symbol: &Symbol| shortened(&specification.name_of(*symbol));
        let words = |word: &[Symbol]| match word {
            [] => "the empty word".to_owned(),
            word => {
                // Forty characters show at most forty names.
                let names = word.iter().take(41).map(|symbol| specification.name_of(*symbol));
                shortened(&names.collect::<Vec<_>>().join(", "))
            }
        };
        match self {
            Self::RenameTask { name } => format!("Rename the task to {}", shortened(name)),
            Self::SetSemantics { semantics: Semantics::MaximumLikelihood } => {
                "Read weights by maximum likelihood".to_owned()
            }
            Self::SetSemantics { semantics: Semantics::Published } => "Read weights as published".to_owned(),
            Self::MergeStates { kept, merged } => format!("Merge {} into {}", state(merged), state(kept)),
            Self::PruneState { state: id, ways } => format!("Prune {}{}", state(id), past(*ways)),
            Self::PruneTransition { source, symbol, ways } => {
                format!("Prune {} from {}{}", sub_goal(symbol), state(source), past(*ways))
            }
            Self::Reweight { state: id, outcome, probability, .. } => {
                let outcome = match outcome {
                    Outcome::Transition(symbol) => format!("{} from {}", sub_goal(symbol), state(id)),
                    Outcome::End => format!("the end in {}", state(id)),
                };
                format!("Reweight {outcome} to {}", (probability * 1e4).round() / 1e4)
            }
            Self::ResetWeights { state: id } => format!("Reset the weights of {}", state(id)),
            Self::SetAccepting { state: id, accepting: true } => format!("Make {} accepting", state(id)),
            Self::SetAccepting { state: id, accepting: false } => format!("Make {} not accepting", state(id)),
            Self::AddState { id } => format!("Add {id}"),
            Self::AddTransition { source, symbol, target } => {
                format!("Add {} from {} to {}", sub_goal(symbol), state(source), state(target))
            }
            Self::MoveTransition { source, symbol, new_source, new_target } if source == new_source => {
                format!("Lead {} from {} to {}", sub_goal(symbol), state(source), state(new_target))
            }
            Self::MoveTransition { source, symbol, new_source, new_target } => {
                let (symbol, source) = (sub_goal(symbol), state(source));
                format!(
                    "Move {symbol} from {source}: now from {} to {}",
                    state(new_source),
                    state(new_target)
                )
            }
            Self::RenameState { state: id, name } if name.is_empty() => {
                format!("Take the name of {} away", state(id))
            }
            Self::RenameState { state: id, name } => format!("Name {} {}", state(id), shortened(name)),
            Self::RenameSubGoal { symbol, name } => {
                format!("Rename {} to {}", sub_goal(symbol), shortened(name))
            }
            Self::RecolorSubGoal { symbol, .. } => format!("Recolor {}", sub_goal(symbol)),
            Self::MergeSubGoals { kept, merged, .. } => {
                format!("Merge {} into {}", sub_goal(merged), sub_goal(kept))
            }
            Self::RemoveSubGoal { symbol, .. } => format!("Remove {}", sub_goal(symbol)),
            Self::AddWord { word, .. } => format!("Add {}", words(word)),
            Self::ForbidWord { word, .. } => format!("Forbid {}", words(word)),
            Self::Replace { .. } => "Replace the specification".to_owned(),
        }
    }
}

fn past(ways: Pruned) -> &'static str {
    match ways {
        Pruned::Cut => "",
        Pruned::Heal => ", keep the ways past it",
    }
}
