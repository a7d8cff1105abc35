//! One-click fixes make their problem go away.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::fix::fix;
use goalgraph::history::{History, Transaction};
use goalgraph::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition, Word};
use goalgraph::specification::{
    Ball, DemonstrationWord, Place, Problem, ProblemKind, Specification, SubGoal, SubsetParameters,
};
use proptest::prelude::*;

fn sub_goal(id: u32, center: Option<f64>) -> SubGoal {
    let ball = center.map(|x| Ball {
        subset: "red".to_owned(),
        features: vec!["red.x".to_owned()],
        center: vec![x],
        radius: 1.0,
    });
    SubGoal { id: Symbol(id), name: format!("red {id}"), ball, frames: 3, demonstrations: 1, color: None }
}

/// What is learned from words; sub-goals without words are not used.
fn learned(sub_goals: u32, words: &[Word]) -> Specification {
    let demonstration = |word: &Word| DemonstrationWord {
        name: String::new(),
        sha256: String::new(),
        frames: 0,
        word: word.clone(),
    };
    let subset = SubsetParameters {
        name: "red".to_owned(),
        features: vec!["red.x".to_owned()],
        epsilon: 1.0,
        min_points: 1,
        min_dwell: 1,
    };
    Specification {
        name: "task".to_owned(),
        semantics: Semantics::MaximumLikelihood,
        features: vec![goalgraph::demonstration::Feature::new("red.x")],
        subsets: vec![subset],
        sub_goals: (0..sub_goals).map(|id| sub_goal(id, Some(f64::from(id) * 10.0))).collect(),
        pdfa: Pdfa::from_words(words),
        demonstrations: words.iter().map(demonstration).collect(),
    }
}

fn word(symbols: &[u32]) -> Word {
    symbols.iter().map(|&symbol| Symbol(symbol)).collect()
}

fn example() -> Specification {
    learned(3, &[word(&[0, 1, 2]), word(&[0, 2, 1]), word(&[1, 0])])
}

fn state(specification: &mut Specification, id: u32) -> &mut State {
    specification.pdfa.states.get_mut(&StateId(id)).unwrap()
}

/// What is offered for the one problem of that kind, committed.
#[track_caller]
fn fixed(specification: &Specification, kind: &ProblemKind) -> Option<(Transaction, Specification)> {
    let problems = specification.check();
    let problem = problems.iter().find(|problem| problem.kind == *kind);
    let problem = problem.unwrap_or_else(|| panic!("no {kind:?} in {problems:?}"));
    let mut history = History::new(specification.clone());
    let transaction = fix(specification, problem, history.next_state())?;
    history.commit(transaction.clone()).unwrap();
    let left = history.specification().check();
    assert!(left.iter().all(|problem| problem.kind != *kind), "{kind:?} is left of {left:?}");
    Some((transaction, history.specification().clone()))
}

#[track_caller]
fn label(specification: &Specification, kind: &ProblemKind) -> String {
    fixed(specification, kind).map_or_else(|| "nothing".to_owned(), |(transaction, _)| transaction.label)
}

#[test]
fn a_state_that_cannot_be_reached_is_pruned() {
    let mut all = example();
    all.pdfa.states.insert(StateId(9), State { accepting: true, end_weight: 1.0, ..State::default() });
    assert_eq!(label(&all, &ProblemKind::Unreachable(StateId(9))), "Prune q9");
}

#[test]
fn a_dead_end_is_pruned_or_accepted_when_words_ended_there() {
    let mut all = example();
    let target = StateId(9);
    state(&mut all, 0).transitions.insert(Symbol(2), Transition { target, count: 0, weight: 1.0 });
    all.pdfa.states.insert(target, State::default());
    assert_eq!(label(&all, &ProblemKind::DeadEnd(target)), "Prune q9");
    state(&mut all, 9).end_count = 2;
    let (_, after) = fixed(&all, &ProblemKind::DeadEnd(target)).unwrap();
    assert!(after.pdfa.states[&target].accepting);
}

#[test]
fn the_initial_state_is_never_pruned() {
    let empty = learned(0, &[]);
    assert_eq!(label(&empty, &ProblemKind::DeadEnd(StateId(0))), "nothing");
    assert_eq!(label(&empty, &ProblemKind::NothingAccepted(StateId(0))), "nothing");
}

#[test]
fn an_end_without_weight_gets_that_of_its_evidence() {
    let mut all = example();
    let last = *all.pdfa.states.iter().find(|(_, state)| state.end_count == 2).unwrap().0;
    state(&mut all, last.0).end_weight = 0.0;
    let (_, after) = fixed(&all, &ProblemKind::NoWeight(last)).unwrap();
    assert_eq!(after, example());
    state(&mut all, last.0).end_count = 0;
    let (_, after) = fixed(&all, &ProblemKind::NoWeight(last)).unwrap();
    assert!((after.pdfa.states[&last].end_weight - 1.0).abs() < f64::EPSILON);
}

#[test]
fn a_state_in_which_no_word_ends_is_accepting_no_more() {
    let mut all = example();
    state(&mut all, 1).accepting = true;
    let (_, after) = fixed(&all, &ProblemKind::NeverEnds(StateId(1))).unwrap();
    assert!(!after.pdfa.states[&StateId(1)].accepting);
}

#[test]
fn a_transition_that_is_never_taken_is_pruned() {
    let mut all = example();
    state(&mut all, 1).transitions.get_mut(&Symbol(2)).unwrap().weight = 0.0;
    let target = all.pdfa.states[&StateId(1)].transitions[&Symbol(2)].target;
    let kind = ProblemKind::NeverTaken(StateId(1), Symbol(2), target);
    assert_eq!(label(&all, &kind), "Prune red 2 from q1");
}

#[test]
fn a_sub_goal_that_is_not_used_is_removed_without_demonstrations_too() {
    let mut all = example();
    all.sub_goals.push(sub_goal(3, None));
    let (_, after) = fixed(&all, &ProblemKind::Unused(Symbol(3))).unwrap();
    assert_eq!(after, example());
    all.demonstrations.clear();
    let (_, after) = fixed(&all, &ProblemKind::Unused(Symbol(3))).unwrap();
    assert_eq!(after.pdfa, example().pdfa);
    assert_eq!(after.sub_goals, example().sub_goals);
}

#[test]
fn sub_goals_whose_balls_overlap_are_merged() {
    let mut all = example();
    all.sub_goals[2] = sub_goal(2, Some(11.0));
    let (_, after) = fixed(&all, &ProblemKind::Overlap(Symbol(1), Symbol(2))).unwrap();
    assert_eq!(after.sub_goals.len(), 2);
}

#[test]
fn a_cycle_names_its_states_and_may_be_meant() {
    let mut all = example();
    let back = Transition { target: StateId(1), count: 0, weight: 1.0 };
    let last = *all.pdfa.states.iter().find(|(_, state)| state.end_count == 2).unwrap().0;
    state(&mut all, last.0).transitions.insert(Symbol(0), back);
    let problems = all.check();
    let cycle = problems.iter().find(|problem| matches!(problem.kind, ProblemKind::Cycle(_))).unwrap();
    let ProblemKind::Cycle(states) = &cycle.kind else { unreachable!() };
    assert!(states.contains(&StateId(1)) && states.contains(&last) && !states.contains(&StateId(0)));
    assert_eq!(cycle.place(), Place::State(states[0]));
    assert_eq!(fix(&all, cycle, StateId(99)), None);
}

fn any_words() -> impl Strategy<Value = Vec<Word>> {
    let any_word = proptest::collection::btree_set(0_u32..4, 0..4).prop_shuffle_set();
    proptest::collection::vec(any_word, 0..6)
}

trait Shuffled {
    fn prop_shuffle_set(self) -> BoxedStrategy<Word>;
}

impl<S: Strategy<Value = BTreeSet<u32>> + 'static> Shuffled for S {
    fn prop_shuffle_set(self) -> BoxedStrategy<Word> {
        let listed = self.prop_map(|set| set.into_iter().map(Symbol).collect::<Vec<_>>());
        listed.prop_shuffle().boxed()
    }
}

/// What an expert may leave behind: weights, ends and transitions changed at random.
fn any_specification() -> impl Strategy<Value = Specification> {
    let changes =
        proptest::collection::vec((any::<u32>(), 0_u32..4, any::<u32>(), 0_u32..3, any::<bool>()), 0..6);
    (any_words(), changes, any::<bool>()).prop_map(|(words, changes, published)| {
        let mut all = learned(5, &words);
        all.sub_goals[4] = sub_goal(4, Some(1.5));
        if published {
            all.semantics = Semantics::Published;
        }
        let count = all.pdfa.states.len() as u32;
        for (source, symbol, target, weight, accepting) in changes {
            let (source, target) = (source % count, StateId(target % count));
            let state = state(&mut all, source);
            state.accepting = accepting;
            state.end_weight = if accepting { f64::from(weight) } else { 0.0 };
            let way = Transition { target, count: 0, weight: f64::from(weight) };
            state.transitions.insert(Symbol(symbol), way);
        }
        all
    })
}

proptest! {
    #[test]
    fn every_fix_makes_its_problem_go_away(all in any_specification()) {
        for Problem { kind, .. } in all.check() {
            let offered = fixed(&all, &kind);
            let none = matches!(kind, ProblemKind::Cycle(_) | ProblemKind::NothingAccepted(_));
            prop_assert!(!none || offered.is_none());
        }
    }

    #[test]
    fn fixing_what_can_be_fixed_again_and_again_comes_to_an_end(all in any_specification()) {
        let mut history = History::new(all);
        let mut seen: BTreeMap<usize, usize> = BTreeMap::new();
        for step in 0..200 {
            let problems = history.specification().check();
            let next = history.next_state();
            let Some(transaction) =
                problems.iter().find_map(|problem| fix(history.specification(), problem, next))
            else {
                return Ok(());
            };
            seen.insert(step, problems.len());
            history.commit(transaction).unwrap();
        }
        prop_assert!(false, "{seen:?}");
    }
}
