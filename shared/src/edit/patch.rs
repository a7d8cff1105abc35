//! What differs between two specifications, and nothing else.

use std::collections::BTreeMap;
use std::mem;

use crate::demonstration::Feature;
use crate::pdfa::{Semantics, State, StateId};
use crate::specification::{DemonstrationWord, Specification, SubGoal, SubsetParameters};

/// Exactly the parts in which one specification differs from another: the states one by one, everything else as a whole.
///
/// A patch is applied to the specification that it was made from, or to one that is equal to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Patch {
    name: Option<String>,
    semantics: Option<Semantics>,
    features: Option<Vec<Feature>>,
    subsets: Option<Vec<SubsetParameters>>,
    sub_goals: Option<Vec<SubGoal>>,
    demonstrations: Option<Vec<DemonstrationWord>>,
    initial: Option<StateId>,
    /// None where a state goes.
    states: BTreeMap<StateId, Option<State>>,
}

impl Patch {
    /// What makes `to` out of `from`.
    ///
    /// # Complexity
    ///
    /// Linear in the size of both, O(Q log Q) for Q states that differ.
    pub fn between(from: &Specification, to: &Specification) -> Self {
        Self {
            name: differing(&from.name, &to.name),
            semantics: differing(&from.semantics, &to.semantics),
            features: differing(&from.features, &to.features),
            subsets: differing(&from.subsets, &to.subsets),
            sub_goals: differing(&from.sub_goals, &to.sub_goals),
            demonstrations: differing(&from.demonstrations, &to.demonstrations),
            initial: differing(&from.pdfa.initial, &to.pdfa.initial),
            states: differing_states(&from.pdfa.states, &to.pdfa.states),
        }
    }

    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Changes `specification` and returns the patch that changes it back.
    ///
    /// # Complexity
    ///
    /// O(S log Q) for S states of the patch and Q of the specification.
    #[must_use = "the inverse is the only way back"]
    pub fn apply(self, specification: &mut Specification) -> Self {
        let pdfa = &mut specification.pdfa;
        let swap = |(id, state): (StateId, Option<State>)| {
            let before = match state {
                Some(state) => pdfa.states.insert(id, state),
                None => pdfa.states.remove(&id),
            };
            (id, before)
        };
        Self {
            states: self.states.into_iter().map(swap).collect(),
            initial: replaced(&mut specification.pdfa.initial, self.initial),
            name: replaced(&mut specification.name, self.name),
            semantics: replaced(&mut specification.semantics, self.semantics),
            features: replaced(&mut specification.features, self.features),
            subsets: replaced(&mut specification.subsets, self.subsets),
            sub_goals: replaced(&mut specification.sub_goals, self.sub_goals),
            demonstrations: replaced(&mut specification.demonstrations, self.demonstrations),
        }
    }
}

fn differing<T: Clone + PartialEq>(from: &T, to: &T) -> Option<T> {
    (from != to).then(|| to.clone())
}

fn differing_states(
    from: &BTreeMap<StateId, State>,
    to: &BTreeMap<StateId, State>,
) -> BTreeMap<StateId, Option<State>> {
    let gone = from.keys().filter(|id| !to.contains_key(id)).map(|&id| (id, None));
    let changed = to.iter().filter(|&(id, state)| from.get(id) != Some(state));
    gone.chain(changed.map(|(&id, state)| (id, Some(state.clone())))).collect()
}

/// Puts `new`, if there is one, in the place of the present value, which is returned.
fn replaced<T>(place: &mut T, new: Option<T>) -> Option<T> {
    new.map(|new| mem::replace(place, new))
}
