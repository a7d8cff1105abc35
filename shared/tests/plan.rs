//! Plans against an enumeration of all ways.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]
#![allow(clippy::float_cmp, reason = "the same arithmetic gives the same numbers")]

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::pdfa::{Pdfa, Probabilities, Semantics, State, StateId, Symbol, Transition, Word};
use goalgraph::plan::{NoPlan, Plan, PlanRequest, Strategy as Choice, plan};
use proptest::prelude::*;

/// Source, symbol, target, weight.
type Way = (u32, u32, u32, f64);

/// An automaton with these ways and these weights of ending in its states.
fn automaton(ways: &[Way], ends: &[f64]) -> Pdfa {
    let state = |&end_weight: &f64| State { accepting: end_weight > 0.0, end_weight, ..State::default() };
    let mut states: BTreeMap<StateId, State> =
        ends.iter().enumerate().map(|(index, end)| (StateId(index as u32), state(end))).collect();
    for &(source, symbol, target, weight) in ways {
        let way = Transition { target: StateId(target), count: 0, weight };
        states.get_mut(&StateId(source)).unwrap().transitions.insert(Symbol(symbol), way);
    }
    Pdfa { initial: StateId(0), states }
}

/// A small automaton with cycles and zero weights, and what is unavailable.
fn any_task() -> impl Strategy<Value = (Pdfa, BTreeSet<Symbol>)> {
    let ways = prop::collection::vec((0..5_u32, 0..4_u32, 0..5_u32, (0..4_u32).prop_map(f64::from)), 0..14);
    let ends = prop::collection::vec(prop_oneof![3 => Just(0.0), 1 => (0..3_u32).prop_map(f64::from)], 5);
    let pdfa = (ways, ends).prop_map(|(ways, ends)| automaton(&ways, &ends));
    (pdfa, prop::collection::btree_set((0..4_u32).prop_map(Symbol), 0..3))
}

/// As [`any_task`], without cycles.
fn acyclic_task() -> impl Strategy<Value = (Pdfa, BTreeSet<Symbol>)> {
    any_task().prop_map(|(mut pdfa, unavailable)| {
        for (&source, state) in &mut pdfa.states {
            state.transitions.retain(|_, way| way.target > source);
        }
        (pdfa, unavailable)
    })
}

/// As [`any_task`], with probabilities that are powers of two: products are exact and ties are frequent.
fn task_with_ties() -> impl Strategy<Value = (Pdfa, BTreeSet<Symbol>)> {
    any_task().prop_map(|(mut pdfa, unavailable)| {
        for state in pdfa.states.values_mut() {
            state.transitions.values_mut().for_each(|way| way.weight = 1.0);
            let ways = state.transitions.len();
            state.end_weight = (ways.max(1).next_power_of_two() - ways) as f64;
            state.accepting = state.end_weight > 0.0;
        }
        (pdfa, unavailable)
    })
}

/// The available ways out of a state that are taken at all: most probable first, ties by symbol.
fn ways(
    pdfa: &Pdfa,
    probabilities: &Probabilities,
    unavailable: &BTreeSet<Symbol>,
    source: StateId,
) -> Vec<(Symbol, StateId)> {
    let mut ways: Vec<(Symbol, StateId, f64)> = Vec::new();
    for (&symbol, way) in &pdfa.states[&source].transitions {
        let probability = probabilities.transition(source, symbol);
        if probability > 0.0 && !unavailable.contains(&symbol) {
            ways.push((symbol, way.target, probability));
        }
    }
    ways.sort_by(|a, b| b.2.partial_cmp(&a.2).unwrap().then(a.0.cmp(&b.0)));
    ways.into_iter().map(|(symbol, target, _)| (symbol, target)).collect()
}

/// Every way from the first state that enters no state twice, in the order of preference at each state: its word and
/// the states passed.
fn simple_ways(
    pdfa: &Pdfa,
    probabilities: &Probabilities,
    unavailable: &BTreeSet<Symbol>,
) -> Vec<(Word, Vec<StateId>)> {
    let mut found = Vec::new();
    let mut open = vec![(Word::new(), vec![pdfa.initial])];
    while let Some((word, states)) = open.pop() {
        let last = states[states.len() - 1];
        for (symbol, target) in ways(pdfa, probabilities, unavailable, last).into_iter().rev() {
            if !states.contains(&target) {
                let next = [word.as_slice(), &[symbol]].concat();
                open.push((next, [states.as_slice(), &[target]].concat()));
            }
        }
        found.push((word, states));
    }
    found
}

fn ends(probabilities: &Probabilities, states: &[StateId]) -> bool {
    probabilities.end(states[states.len() - 1]) > 0.0
}

fn probability(probabilities: &Probabilities, word: &[Symbol], states: &[StateId]) -> f64 {
    let steps = word.iter().zip(states);
    steps.fold(1.0, |product, (&symbol, &state)| product * probabilities.transition(state, symbol))
}

fn request(from: StateId, unavailable: &BTreeSet<Symbol>, strategy: Choice) -> PlanRequest {
    PlanRequest { from, unavailable: unavailable.clone(), strategy }
}

/// The plan's states and probability are those of its word.
fn fits(pdfa: &Pdfa, probabilities: &Probabilities, plan: &Plan, end: f64) -> bool {
    let mut states = plan.states.iter().zip(&plan.word).zip(&plan.states[1..]);
    states.all(|((source, symbol), &target)| pdfa.states[source].transitions[symbol].target == target)
        && plan.states.len() == plan.word.len() + 1
        && plan.probability == probability(probabilities, &plan.word, &plan.states) * end
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn greedy_is_the_first_way_in_the_order_of_preference((pdfa, unavailable) in any_task()) {
        for semantics in [Semantics::MaximumLikelihood, Semantics::Published] {
            let probabilities = pdfa.probabilities(semantics);
            let all = simple_ways(&pdfa, &probabilities, &unavailable);
            let first = all.iter().find(|(_, states)| ends(&probabilities, states));
            match plan(&pdfa, &probabilities, &request(pdfa.initial, &unavailable, Choice::Greedy)) {
                Ok(plan) => {
                    prop_assert_eq!(Some((&plan.word, &plan.states)), first.map(|(word, states)| (word, states)));
                    let end = probabilities.end(plan.states[plan.states.len() - 1]);
                    prop_assert!(fits(&pdfa, &probabilities, &plan, end));
                }
                Err(_) => prop_assert!(first.is_none()),
            }
        }
    }

    #[test]
    fn most_probable_is_the_best_of_all_ways((pdfa, unavailable) in any_task()) {
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        let all = simple_ways(&pdfa, &probabilities, &unavailable);
        let likelihood = |(word, states): &(Word, Vec<StateId>)| {
            probability(&probabilities, word, states) * probabilities.end(states[states.len() - 1])
        };
        let best = all.iter().map(likelihood).fold(0.0, f64::max);
        let found = plan(&pdfa, &probabilities, &request(pdfa.initial, &unavailable, Choice::MostProbable)).ok();
        prop_assert_eq!(found.as_ref().map_or(0.0, |plan| plan.probability), best);
        if let Some(plan) = found {
            prop_assert!(plan.word.iter().all(|symbol| !unavailable.contains(symbol)));
            let end = probabilities.end(plan.states[plan.states.len() - 1]);
            prop_assert!(fits(&pdfa, &probabilities, &plan, end));
        }
    }

    #[test]
    fn of_equally_probable_words_the_earlier_is_planned((pdfa, unavailable) in task_with_ties()) {
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        let all = simple_ways(&pdfa, &probabilities, &unavailable);
        let rated = all.iter().map(|(word, states)| {
            (probability(&probabilities, word, states) * probabilities.end(states[states.len() - 1]), word)
        });
        let rated: Vec<(f64, &Word)> = rated.filter(|(likelihood, _)| *likelihood > 0.0).collect();
        let best = rated.iter().map(|(likelihood, _)| *likelihood).fold(0.0, f64::max);
        let earliest = rated.iter().filter(|(likelihood, _)| *likelihood == best).map(|(_, word)| *word).min();
        let found = plan(&pdfa, &probabilities, &request(pdfa.initial, &unavailable, Choice::MostProbable));
        prop_assert_eq!(found.ok().map(|plan| plan.word), earliest.cloned());
    }

    #[test]
    fn there_is_no_plan_exactly_when_no_accepting_state_can_be_reached((pdfa, unavailable) in any_task()) {
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        let mut reached = BTreeSet::new();
        let mut open = vec![pdfa.initial];
        while let Some(state) = open.pop() {
            if reached.insert(state) {
                open.extend(ways(&pdfa, &probabilities, &unavailable, state).into_iter().map(|(_, target)| target));
            }
        }
        let possible = reached.iter().any(|&state| probabilities.end(state) > 0.0);
        for strategy in [Choice::Greedy, Choice::MostProbable] {
            let found = plan(&pdfa, &probabilities, &request(pdfa.initial, &unavailable, strategy));
            prop_assert_eq!(found.is_ok(), possible);
        }
    }

    #[test]
    fn meanwhile_only_what_is_available_is_done_and_the_end_stays_in_reach((pdfa, unavailable) in any_task()) {
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        let found = plan(&pdfa, &probabilities, &request(pdfa.initial, &unavailable, Choice::Greedy));
        if let Err(NoPlan::OutOfReach { from, meanwhile }) = found {
            prop_assert_eq!(from, pdfa.initial);
            prop_assert!(meanwhile.word.iter().all(|symbol| !unavailable.contains(symbol)));
            prop_assert!(fits(&pdfa, &probabilities, &meanwhile, 1.0));
            let last = meanwhile.states[meanwhile.states.len() - 1];
            let later = plan(&pdfa, &probabilities, &request(last, &BTreeSet::new(), Choice::Greedy));
            prop_assert!(later.is_ok() || meanwhile.word.is_empty());
        }
    }

    #[test]
    fn meanwhile_as_much_as_possible_is_done_by_preference((pdfa, unavailable) in acyclic_task()) {
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        let found = plan(&pdfa, &probabilities, &request(pdfa.initial, &unavailable, Choice::Greedy));
        if let Err(NoPlan::OutOfReach { meanwhile, .. }) = found {
            let everything = BTreeSet::new();
            let all = simple_ways(&pdfa, &probabilities, &unavailable);
            let open = |states: &[StateId]| {
                let from = states[states.len() - 1];
                plan(&pdfa, &probabilities, &request(from, &everything, Choice::Greedy)).is_ok()
            };
            let kept: Vec<&Word> =
                all.iter().filter(|(_, states)| open(states)).map(|(word, _)| word).collect();
            let longest = kept.iter().map(|word| word.len()).max().unwrap_or(0);
            let first = kept.into_iter().find(|word| word.len() == longest).cloned().unwrap_or_default();
            prop_assert_eq!(meanwhile.word, first);
        }
    }
}

/// The symbols of the plan, or none.
fn planned(pdfa: &Pdfa, unavailable: &[u32], strategy: Choice) -> Option<Vec<u32>> {
    let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
    let unavailable = unavailable.iter().copied().map(Symbol).collect();
    let plan = plan(pdfa, &probabilities, &request(pdfa.initial, &unavailable, strategy)).ok()?;
    Some(plan.word.iter().map(|symbol| symbol.0).collect())
}

#[test]
fn ties_go_to_the_earlier_symbol() {
    let pdfa = automaton(&[(0, 2, 1, 3.0), (0, 1, 2, 3.0)], &[0.0, 1.0, 1.0]);
    assert_eq!(planned(&pdfa, &[], Choice::Greedy), Some(vec![1]));
    assert_eq!(planned(&pdfa, &[], Choice::MostProbable), Some(vec![1]));
    assert_eq!(planned(&pdfa, &[1], Choice::Greedy), Some(vec![2]));
}

#[test]
fn most_probable_sees_past_a_greedy_choice() {
    // The likelier first step leads to three equally likely second ones.
    let ways =
        [(0, 0, 1, 3.0), (0, 1, 2, 2.0), (1, 2, 3, 1.0), (1, 3, 3, 1.0), (1, 4, 3, 1.0), (2, 5, 3, 1.0)];
    let pdfa = automaton(&ways, &[0.0, 0.0, 0.0, 1.0]);
    assert_eq!(planned(&pdfa, &[], Choice::Greedy), Some(vec![0, 2]));
    assert_eq!(planned(&pdfa, &[], Choice::MostProbable), Some(vec![1, 5]));
}

#[test]
fn greedy_backs_out_of_a_dead_end() {
    let ways = [(0, 0, 1, 5.0), (1, 2, 3, 1.0), (0, 1, 2, 1.0), (2, 3, 4, 1.0)];
    let pdfa = automaton(&ways, &[0.0, 0.0, 0.0, 0.0, 1.0]);
    assert_eq!(planned(&pdfa, &[], Choice::Greedy), Some(vec![1, 3]));
    assert_eq!(planned(&pdfa, &[3], Choice::Greedy), None);
}

#[test]
fn where_the_task_may_end_the_plan_is_empty() {
    let pdfa = automaton(&[(0, 0, 0, 9.0)], &[1.0]);
    assert_eq!(planned(&pdfa, &[], Choice::Greedy), Some(vec![]));
    assert_eq!(planned(&pdfa, &[], Choice::MostProbable), Some(vec![]));
}

#[test]
fn a_state_that_does_not_exist_is_named() {
    let pdfa = automaton(&[], &[1.0]);
    let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
    let error =
        plan(&pdfa, &probabilities, &request(StateId(7), &BTreeSet::new(), Choice::Greedy)).unwrap_err();
    assert_eq!(error.to_string(), "there is no state q7");
}

/// Two rows of 3000 states: each step of the first has probability 1/4, of the second 1/2.
#[test]
fn long_words_whose_probability_no_number_holds_are_still_compared() {
    let length = 3000;
    let mut ways = vec![(0, 0, 1, 1.0), (0, 1, length + 1, 1.0)];
    let sink = 2 * length + 1;
    for (row, lost) in [(0, 3.0), (length, 1.0)] {
        for step in 1..length {
            ways.extend([(row + step, 0, row + step + 1, 1.0), (row + step, 1, sink, lost)]);
        }
        ways.push((row + length, 2 + row, sink + 1, 1.0));
    }
    let mut ends = vec![0.0; sink as usize + 2];
    ends[sink as usize + 1] = 1.0;
    let pdfa = automaton(&ways, &ends);
    let word = planned(&pdfa, &[], Choice::MostProbable).unwrap();
    assert_eq!((word.len(), word[0]), (length as usize + 1, 1));
}

#[test]
fn a_long_way_is_planned_in_a_moment() {
    let length = 50_000;
    let ways: Vec<Way> = (0..length).map(|state| (state, state, state + 1, 1.0)).collect();
    let mut ends = vec![0.0; length as usize + 1];
    ends[length as usize] = 1.0;
    let pdfa = automaton(&ways, &ends);
    assert_eq!(planned(&pdfa, &[], Choice::Greedy).unwrap().len(), length as usize);
    let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
    let missing = BTreeSet::from([Symbol(length - 1)]);
    let error = plan(&pdfa, &probabilities, &request(pdfa.initial, &missing, Choice::Greedy)).unwrap_err();
    let NoPlan::OutOfReach { meanwhile, .. } = error else { panic!("the state is there") };
    assert_eq!(meanwhile.word.len(), length as usize - 1);
}
