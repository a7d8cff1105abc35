//! Which function does which edit.

use super::{
    Edit, EditError, Folded, add_word, alphabet, automaton, forbid_word, merge, name, prune, reweight,
    sub_goals, transition,
};
use crate::specification::Specification;

impl Edit {
    /// Applies the edit to a specification that is thrown away when it fails.
    pub(crate) fn perform(&self, specification: &mut Specification) -> Result<Folded, EditError> {
        let pdfa = &mut specification.pdfa;
        match self {
            Self::RenameTask { name } => specification.name = name::visible(name)?,
            Self::SetSemantics { semantics } => specification.semantics = *semantics,
            Self::MergeStates { kept, merged } => return merge::merge_states(pdfa, *kept, *merged),
            Self::PruneState { state, ways } => return prune::prune_state(pdfa, *state, *ways),
            Self::PruneTransition { source, symbol, ways } => {
                return prune::prune_transition(pdfa, *source, *symbol, *ways);
            }
            Self::Reweight { state, outcome, probability, locked } => {
                let request = reweight::Request { outcome: *outcome, probability: *probability, locked };
                reweight::reweight(specification, *state, &request)?;
            }
            Self::ResetWeights { state } => automaton::reset_weights(pdfa, *state)?,
            Self::SetAccepting { state, accepting } => automaton::set_accepting(pdfa, *state, *accepting)?,
            Self::AddState { id } => automaton::add_state(pdfa, *id)?,
            Self::AddTransition { source, symbol, target } => {
                transition::add(specification, *source, *symbol, *target)?;
            }
            Self::MoveTransition { source, symbol, new_source, new_target } => {
                transition::shift(pdfa, *source, *symbol, (*new_source, *new_target))?;
            }
            Self::RenameState { state, name } => automaton::rename_state(pdfa, *state, name)?,
            Self::RenameSubGoal { symbol, name } => {
                alphabet::sub_goal(specification, *symbol)?.name = name::visible(name)?;
            }
            Self::RecolorSubGoal { symbol, color } => alphabet::recolor(specification, *symbol, *color)?,
            Self::MergeSubGoals { kept, merged, first_new } => {
                return sub_goals::merge(specification, *kept, *merged, *first_new);
            }
            Self::RemoveSubGoal { symbol, first_new } => {
                return sub_goals::remove(specification, *symbol, *first_new);
            }
            Self::AddWord { word, first_new } => add_word::add_word(specification, word, *first_new)?,
            Self::ForbidWord { word, first_new } => {
                forbid_word::forbid_word(specification, word, *first_new)?;
            }
            Self::Replace { specification: text } => *specification = Specification::from_json(text)?,
        }
        Ok(Folded::new())
    }
}
