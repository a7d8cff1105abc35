//! What differs between two specifications, part by part, and one automaton that shows both.

mod matching;
mod union;

use std::collections::{BTreeMap, BTreeSet};

use crate::distance::{Distance, distance};
use crate::language::{LanguageEffect, WordDistribution, language_effect};
use crate::pdfa::{Probabilities, Semantics, StateId, Symbol};
use crate::specification::{DemonstrationWord, Specification, SubGoal};

/// How many gained and lost words a difference writes out, at most, of each.
pub const EXAMPLES: usize = 8;

/// What was before and what is after. Something was added when there is no before, removed when there is no after.
#[derive(Clone, Debug, PartialEq)]
pub struct Change<T> {
    /// What was; none when it was added.
    pub before: Option<T>,
    /// What is; none when it was removed.
    pub after: Option<T>,
}

impl<T: PartialEq> Change<T> {
    /// The change, unless both are the same.
    fn between(before: Option<T>, after: Option<T>) -> Option<Self> {
        (before != after).then_some(Self { before, after })
    }
}

/// What a state says of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct StateSide {
    /// Its id there.
    pub id: StateId,
    /// What an expert calls it.
    pub name: Option<String>,
    /// The sub-goals that are completed in it, by their symbols in the union.
    pub completed: BTreeSet<Symbol>,
    /// Whether the task may end in it.
    pub accepting: bool,
    /// How many words ended in it.
    pub end_count: u64,
    /// What decides how probable it is that the task ends in it.
    pub end_weight: f64,
    /// How probable that is.
    pub final_probability: f64,
}

/// What a transition says of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct TransitionSide {
    /// Where it leads, by the id in the union.
    pub target: StateId,
    /// How many words took it.
    pub count: u64,
    /// What decides its probability.
    pub weight: f64,
    /// Its probability.
    pub probability: f64,
}

/// The parts of a specification that are compared as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// The features that demonstrations have.
    Features,
    /// The subsets in which sub-goals were searched, with their parameters.
    Subsets,
}

/// What differs between two specifications. Where states are drawn is no part of a specification, so it is no difference;
/// nor are the ids of states.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// What the task is called, where that differs.
    pub name: Option<Change<String>>,
    /// How weights are read, where that differs.
    pub semantics: Option<Change<Semantics>>,
    /// Parts that differ as a whole.
    pub parts: BTreeSet<Part>,
    /// Sub-goals that differ, by their symbols in the union.
    pub sub_goals: BTreeMap<Symbol, Change<SubGoal>>,
    /// States that differ, by their ids in the union.
    pub states: BTreeMap<StateId, Change<StateSide>>,
    /// Transitions that differ, by their place in the union. One that leads elsewhere is removed and added.
    pub transitions: BTreeMap<(StateId, Symbol), Change<TransitionSide>>,
    /// Demonstrations that are not the same in both: those that went, then those that came.
    pub demonstrations: Vec<Change<DemonstrationWord>>,
    /// The words that are accepted afterwards and were not before, and the other way round; by the symbols of the union.
    pub effect: LanguageEffect,
    /// How far the words after are from those before.
    pub distance: Distance,
    /// What is after, and in addition what is no more: see [`difference`].
    pub union: Specification,
    /// The probabilities of what the union shows: as they are after, and as they were before for what is no more.
    pub chances: BTreeMap<(StateId, Symbol), f64>,
}

/// What differs between `before` and `after`.
///
/// Sub-goals are the same when id and name agree, or else the name, or else id and ball. States are the same when the
/// same sub-goals lead to them from the initial states: where several ways disagree, the id decides, then what is
/// completed; states that no way matches are the same when their ids are.
///
/// The union is `after` with what is no more: states, transitions and sub-goals of `before` that have no counterpart.
/// They keep their ids where those are free and get ids above all others where not. What is no more has no weight and no
/// count in the union, so that it takes nothing from the rest. A transition that leads elsewhere now is there twice, as it
/// was under a symbol of its own.
///
/// # Complexity
///
/// That of [`language_effect`] and of [`distance`], and O((Q + T) log T + S²) for Q states, T transitions and S sub-goals
/// of both.
///
/// # Example
///
/// ```
/// use goalgraph::difference::difference;
/// use goalgraph::edit::Edit;
/// use goalgraph::infer::infer_words;
/// use goalgraph::pdfa::StateId;
///
/// let words = [vec!["a".to_owned(), "b".to_owned()], vec!["b".to_owned()]];
/// let before = infer_words("Task", Default::default(), &words);
/// let mut after = before.clone();
/// Edit::RenameState { state: StateId(1), name: "half done".to_owned() }.apply(&mut after)?;
///
/// let found = difference(&before, &after);
/// assert_eq!(found.states.keys().collect::<Vec<_>>(), [&StateId(1)]);
/// assert!(found.transitions.is_empty());
/// assert!(difference(&before, &before).is_empty());
/// # Ok::<(), goalgraph::edit::EditError>(())
/// ```
pub fn difference(before: &Specification, after: &Specification) -> Difference {
    let symbols = matching::symbols(&before.sub_goals, &after.sub_goals);
    let before = &matching::with_symbols(before, &symbols);
    let states = matching::states(&before.pdfa, &after.pdfa);
    let union::Union { specification: union, chances, ghosts } = union::union(before, after, &states);
    let compared = Compared { before, after, states: &states, ghosts: &ghosts };
    let (from, to) = (WordDistribution::of(&before.pdfa), WordDistribution::of(&after.pdfa));
    Difference {
        name: Change::between(Some(before.name.clone()), Some(after.name.clone())),
        semantics: Change::between(Some(before.semantics), Some(after.semantics)),
        parts: parts(before, after),
        sub_goals: sub_goals(before, after),
        states: compared.states(),
        transitions: compared.transitions(),
        demonstrations: demonstrations(before, after),
        effect: language_effect(&from, &to, EXAMPLES),
        distance: distance(&from, &to),
        union,
        chances,
    }
}

impl Difference {
    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        self.name.is_none()
            && self.semantics.is_none()
            && self.parts.is_empty()
            && self.sub_goals.is_empty()
            && self.states.is_empty()
            && self.transitions.is_empty()
            && self.demonstrations.is_empty()
    }
}

fn parts(before: &Specification, after: &Specification) -> BTreeSet<Part> {
    let features = (before.features != after.features).then_some(Part::Features);
    let subsets = (before.subsets != after.subsets).then_some(Part::Subsets);
    features.into_iter().chain(subsets).collect()
}

/// Both speak of the same symbols by now.
fn sub_goals(before: &Specification, after: &Specification) -> BTreeMap<Symbol, Change<SubGoal>> {
    let all = before.sub_goals.iter().chain(&after.sub_goals).map(|sub_goal| sub_goal.id);
    let change = |id: Symbol| Change::between(before.sub_goal(id).cloned(), after.sub_goal(id).cloned());
    all.filter_map(|id| Some((id, change(id)?))).collect()
}

fn demonstrations(before: &Specification, after: &Specification) -> Vec<Change<DemonstrationWord>> {
    let gone = rest(&before.demonstrations, &after.demonstrations);
    let new = rest(&after.demonstrations, &before.demonstrations);
    let gone = gone.into_iter().map(|it| Change { before: Some(it), after: None });
    gone.chain(new.into_iter().map(|it| Change { before: None, after: Some(it) })).collect()
}

/// What of `these` is not among `those`, as often as it is more often there.
fn rest(these: &[DemonstrationWord], those: &[DemonstrationWord]) -> Vec<DemonstrationWord> {
    let name = |it: &DemonstrationWord| (it.name.clone(), it.sha256.clone(), it.frames, it.word.clone());
    let mut number: BTreeMap<_, usize> = BTreeMap::new();
    for it in those {
        *number.entry(name(it)).or_default() += 1;
    }
    let mut is_new = |it: &&DemonstrationWord| match number.get_mut(&name(it)) {
        Some(left) if *left > 0 => {
            *left -= 1;
            false
        }
        _ => true,
    };
    these.iter().filter(|it| is_new(it)).cloned().collect()
}

/// Two automata over the same symbols, and which of their states are the same.
struct Compared<'a> {
    before: &'a Specification,
    after: &'a Specification,
    /// For each state before its id in the union.
    states: &'a matching::States,
    /// The symbols, in the union, of transitions that lead elsewhere now: as they were.
    ghosts: &'a BTreeMap<(StateId, Symbol), Symbol>,
}

impl Compared<'_> {
    fn states(&self) -> BTreeMap<StateId, Change<StateSide>> {
        let old = state_sides(self.before, &|id| self.states.in_union(id));
        let new = state_sides(self.after, &|id| id);
        changes(old, new, same_state)
    }

    fn transitions(&self) -> BTreeMap<(StateId, Symbol), Change<TransitionSide>> {
        let mut old = transition_sides(self.before, &|id| self.states.in_union(id));
        for (&(source, symbol), &ghost) in self.ghosts {
            if let Some(side) = old.remove(&(source, symbol)) {
                old.insert((source, ghost), side);
            }
        }
        changes(old, transition_sides(self.after, &|id| id), |old, new| old == new)
    }
}

/// An id is no property: only what the state says beside it is.
fn same_state(old: &StateSide, new: &StateSide) -> bool {
    StateSide { id: new.id, ..old.clone() } == *new
}

fn changes<K: Ord + Copy, T: Clone>(
    old: BTreeMap<K, T>,
    mut new: BTreeMap<K, T>,
    same: impl Fn(&T, &T) -> bool,
) -> BTreeMap<K, Change<T>> {
    let mut changes = BTreeMap::new();
    for (key, before) in old {
        let after = new.remove(&key);
        if !after.as_ref().is_some_and(|after| same(&before, after)) {
            changes.insert(key, Change { before: Some(before), after });
        }
    }
    changes.extend(new.into_iter().map(|(key, after)| (key, Change { before: None, after: Some(after) })));
    changes
}

fn state_sides(
    specification: &Specification,
    named: &dyn Fn(StateId) -> StateId,
) -> BTreeMap<StateId, StateSide> {
    let probabilities = chances(specification);
    let side = |(&id, state): (&StateId, &crate::pdfa::State)| {
        let side = StateSide {
            id,
            name: state.name.clone(),
            completed: state.completed.clone(),
            accepting: state.accepting,
            end_count: state.end_count,
            end_weight: state.end_weight,
            final_probability: probabilities.end(id),
        };
        (named(id), side)
    };
    specification.pdfa.states.iter().map(side).collect()
}

fn transition_sides(
    specification: &Specification,
    named: &dyn Fn(StateId) -> StateId,
) -> BTreeMap<(StateId, Symbol), TransitionSide> {
    let probabilities = chances(specification);
    let side = |(source, symbol, way): (StateId, Symbol, &crate::pdfa::Transition)| {
        let probability = probabilities.transition(source, symbol);
        let side =
            TransitionSide { target: named(way.target), count: way.count, weight: way.weight, probability };
        ((named(source), symbol), side)
    };
    specification.pdfa.transitions().map(side).collect()
}

fn chances(specification: &Specification) -> Probabilities {
    specification.pdfa.probabilities(specification.semantics)
}
