//! What an edit that is thought of would change, for the drawing.

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::pdfa::{Probabilities, StateId, Symbol, Transition};
use goalgraph::preview::Preview;
use goalgraph::specification::Specification;

/// What becomes of the drawn states and transitions.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Marks {
    /// States that would be part of another one.
    pub(crate) folding: BTreeMap<StateId, StateId>,
    /// States that others would be folded into.
    pub(crate) taking: BTreeSet<StateId>,
    /// States that would go.
    pub(crate) going_states: BTreeSet<StateId>,
    /// Transitions that would go, or lead elsewhere.
    pub(crate) going_transitions: BTreeSet<(StateId, Symbol)>,
    /// Probabilities that would be others.
    pub(crate) chances: BTreeMap<(StateId, Symbol), f64>,
    /// Transitions that would come, between states that are drawn.
    pub(crate) coming: Vec<(StateId, Symbol, StateId)>,
}

/// A difference of probabilities that nobody sees.
const SAME: f64 = 1e-9;

impl Marks {
    /// What `preview` would change in `before`.
    pub(super) fn of(before: &Specification, probabilities: &Probabilities, preview: &Preview) -> Self {
        let after = &preview.specification;
        let chances = after.pdfa.probabilities(after.semantics);
        let drawn = |id: StateId| *preview.folded.get(&id).unwrap_or(&id);
        let mut marks = Self {
            folding: preview.folded.clone(),
            taking: preview.folded.values().copied().collect(),
            going_states: preview.removed.clone(),
            ..Self::default()
        };
        for (source, symbol, way) in before.pdfa.transitions() {
            let place = (source, symbol);
            match after.pdfa.transition(drawn(source), symbol) {
                Some(next) if next.target == drawn(way.target) => {
                    let chance = chances.transition(drawn(source), symbol);
                    if (chance - probabilities.transition(source, symbol)).abs() > SAME {
                        marks.chances.insert(place, chance);
                    }
                }
                _ => {
                    marks.going_transitions.insert(place);
                }
            }
        }
        let known: BTreeSet<(StateId, Symbol, StateId)> =
            before.pdfa.transitions().map(|(from, by, to)| (drawn(from), by, drawn(to.target))).collect();
        let both_drawn = |source: StateId, target: StateId| {
            before.pdfa.states.contains_key(&source) && before.pdfa.states.contains_key(&target)
        };
        let is_new = |(source, symbol, way): &(StateId, Symbol, &Transition)| {
            !known.contains(&(*source, *symbol, way.target)) && both_drawn(*source, way.target)
        };
        let coming = after.pdfa.transitions().filter(is_new);
        marks.coming = coming.map(|(source, symbol, way)| (source, symbol, way.target)).collect();
        marks
    }
}
