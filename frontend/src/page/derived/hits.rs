//! What a search finds in the automaton.

use goalgraph::pdfa::{State, StateId, Symbol, Transition};
use goalgraph::specification::Specification;

use crate::page::model::Selection;

/// The states and transitions whose id or name has `text` in it, or whose sub-goal has; none for no text.
pub(super) fn hits(specification: &Specification, text: &str) -> Vec<Selection> {
    let text = text.trim().to_lowercase();
    if text.is_empty() {
        return Vec::new();
    }
    let has = |name: &str| name.to_lowercase().contains(&text);
    let sub_goal = |symbol: Symbol| has(&symbol.to_string()) || has(&specification.name_of(symbol));
    let state =
        |(id, state): &(&StateId, &State)| has(&id.to_string()) || state.name.as_deref().is_some_and(has);
    let transition = |(_, symbol, _): &(StateId, Symbol, &Transition)| sub_goal(*symbol);
    let states = specification.pdfa.states.iter().filter(state).map(|(&id, _)| Selection::State(id));
    let transitions = specification.pdfa.transitions().filter(transition);
    states.chain(transitions.map(|(source, symbol, _)| Selection::Transition(source, symbol))).collect()
}

#[cfg(test)]
mod tests {
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;

    use super::*;

    #[test]
    fn states_are_found_by_id_and_transitions_by_the_name_of_their_sub_goal() {
        let words = [vec!["Red cup".to_owned(), "lid".to_owned()]];
        let specification = infer_words("", Semantics::default(), &words);
        let state = |id| Selection::State(StateId(id));
        let transition = |source, symbol| Selection::Transition(StateId(source), Symbol(symbol));
        assert_eq!(hits(&specification, " CUP "), [transition(0, 0)]);
        assert_eq!(hits(&specification, "q"), [state(0), state(1), state(2)]);
        assert_eq!(hits(&specification, "g1"), [transition(1, 1)]);
        assert_eq!(hits(&specification, "  "), []);
    }
}
