//! Algorithm 2 against sets written out, and the probabilities against their sums.

#![allow(clippy::float_cmp, reason = "the same arithmetic gives the same numbers")]

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::pdfa::{Pdfa, Probabilities, Semantics, State, StateId, Symbol, Transition, Word};
use proptest::prelude::*;

type Set = BTreeSet<Symbol>;

/// Words over five symbols, in which a symbol may come again.
fn any_words() -> impl Strategy<Value = Vec<Word>> {
    prop::collection::vec(prop::collection::vec((0..5_u32).prop_map(Symbol), 0..7), 0..12)
}

/// Words over five symbols, each symbol at most once in a word, as Algorithm 1 reads them.
fn words() -> impl Strategy<Value = Vec<Word>> {
    let word = (Just((0..5).map(Symbol).collect::<Word>()).prop_shuffle(), 0..=5_usize);
    prop::collection::vec(word.prop_map(|(order, length)| order[..length].to_vec()), 0..12)
}

/// An automaton with any weights, zero included, and cycles.
fn any_automaton() -> impl Strategy<Value = Pdfa> {
    let ways = prop::collection::btree_map(0..4_u32, (0..5_u32, 0..4_u64), 0..4);
    let state = (ways, any::<bool>(), 0..3_u64);
    let state = state.prop_map(|(ways, accepting, end_count)| {
        let way = |(symbol, (target, count))| {
            (Symbol(symbol), Transition { target: StateId(target), count, weight: count as f64 })
        };
        let transitions = ways.into_iter().map(way).collect();
        State { accepting, end_count, end_weight: end_count as f64, transitions, ..State::default() }
    });
    prop::collection::vec(state, 5).prop_map(|states| {
        let ids = (0..).map(StateId);
        Pdfa { initial: StateId(0), states: ids.zip(states).collect() }
    })
}

/// Algorithm 2, step by step.
fn algorithm_2(words: &[Word]) -> Pdfa {
    let initial = StateId(0);
    let mut states = BTreeMap::from([(initial, State::default())]);
    let mut by_completed = BTreeMap::from([(Set::new(), initial)]);
    for word in words {
        let (mut source, mut completed) = (initial, Set::new());
        for &symbol in word {
            completed.insert(symbol);
            let new = StateId(by_completed.len() as u32);
            let target = *by_completed.entry(completed.clone()).or_insert(new);
            let completed = completed.clone();
            states.entry(target).or_insert(State { completed, ..State::default() });
            let ways = &mut states.get_mut(&source).expect("it is there").transitions;
            let way = ways.entry(symbol).or_insert(Transition { target, count: 0, weight: 0.0 });
            way.count += 1;
            way.weight += 1.0;
            source = target;
        }
        let end = states.get_mut(&source).expect("it is there");
        end.end_count += 1;
        end.end_weight += 1.0;
        end.accepting = true;
    }
    Pdfa { initial, states }
}

/// Symbols of any number, most of them few.
fn any_symbol() -> impl Strategy<Value = Symbol> {
    prop_oneof![8 => 0..9_u32, 1 => u32::MAX - 3.., 1 => any::<u32>()].prop_map(Symbol)
}

/// Every word that the automaton accepts, with its probability; only for automata without cycles.
fn accepted(pdfa: &Pdfa, probabilities: &Probabilities) -> Vec<(Word, f64)> {
    let mut accepted = Vec::new();
    let mut open = vec![(Word::new(), pdfa.initial)];
    while let Some((word, id)) = open.pop() {
        let state = &pdfa.states[&id];
        if state.accepting {
            accepted.push((word.clone(), pdfa.word_probability(&word, probabilities)));
        }
        for (&symbol, transition) in &state.transitions {
            open.push(([word.as_slice(), &[symbol]].concat(), transition.target));
        }
    }
    accepted
}

/// Sum of what leaves the state and what ends there.
fn sum(pdfa: &Pdfa, probabilities: &Probabilities, id: StateId) -> f64 {
    let ways = pdfa.states[&id].transitions.keys();
    ways.map(|&symbol| probabilities.transition(id, symbol)).sum::<f64>() + probabilities.end(id)
}

proptest! {
    #[test]
    fn words_give_the_automaton_of_algorithm_2(
        words in prop::collection::vec(prop::collection::vec(any_symbol(), 0..12), 0..20),
    ) {
        let expected = algorithm_2(&words);
        prop_assert_eq!(Pdfa::from_words(&words), expected);
    }

    #[test]
    fn states_are_the_sets_of_completed_symbols(words in any_words()) {
        let pdfa = Pdfa::from_words(&words);
        let (mut sets, mut ends) = (BTreeSet::from([Set::new()]), BTreeMap::<Set, u64>::new());
        let mut steps: BTreeMap<(Set, Symbol), (Set, u64)> = BTreeMap::new();
        for word in &words {
            for (at, &symbol) in word.iter().enumerate() {
                let before: Set = word[..at].iter().copied().collect();
                let after: Set = word[..=at].iter().copied().collect();
                steps.entry((before, symbol)).or_insert((after.clone(), 0)).1 += 1;
                sets.insert(after);
            }
            *ends.entry(word.iter().copied().collect()).or_default() += 1;
        }
        let completed = |id: StateId| pdfa.states[&id].completed.clone();
        prop_assert_eq!(pdfa.states.values().map(|state| state.completed.clone()).collect::<BTreeSet<_>>(), sets.clone());
        prop_assert_eq!(pdfa.states.len(), sets.len());
        prop_assert_eq!(completed(pdfa.initial), Set::new());
        let found: BTreeMap<_, _> = pdfa
            .transitions()
            .map(|(source, symbol, way)| ((completed(source), symbol), (completed(way.target), way.count)))
            .collect();
        prop_assert_eq!(found, steps);
        for state in pdfa.states.values() {
            prop_assert_eq!(state.end_count, ends.get(&state.completed).copied().unwrap_or(0));
            prop_assert_eq!(state.accepting, state.end_count > 0);
            prop_assert_eq!(state.end_weight, state.end_count as f64);
        }
        prop_assert!(pdfa.transitions().all(|(_, _, way)| way.weight == way.count as f64));
    }

    #[test]
    fn states_are_numbered_in_the_order_in_which_words_reach_them(words in any_words()) {
        let pdfa = Pdfa::from_words(&words);
        let mut reached = vec![pdfa.initial];
        for word in &words {
            let mut state = pdfa.initial;
            for &symbol in word {
                state = pdfa.states[&state].transitions[&symbol].target;
                reached.push(state);
            }
        }
        let mut seen = BTreeSet::new();
        reached.retain(|&id| seen.insert(id));
        prop_assert_eq!(reached, (0..pdfa.states.len() as u32).map(StateId).collect::<Vec<_>>());
    }

    #[test]
    fn what_comes_into_a_state_leaves_it_or_ends_there(words in any_words()) {
        let pdfa = Pdfa::from_words(&words);
        for (&id, state) in &pdfa.states {
            let starts = if id == pdfa.initial { words.len() as u64 } else { 0 };
            let inflow: u64 = pdfa.transitions().filter(|(_, _, way)| way.target == id).map(|(_, _, way)| way.count).sum();
            let outflow: u64 = state.transitions.values().map(|way| way.count).sum();
            prop_assert_eq!(starts + inflow, outflow + state.end_count);
        }
    }

    #[test]
    fn the_probabilities_of_a_state_add_up_to_one(words in any_words()) {
        let pdfa = Pdfa::from_words(&words);
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        for &id in pdfa.states.keys().filter(|_| !words.is_empty()) {
            prop_assert!((sum(&pdfa, &probabilities, id) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_probabilities_of_all_accepted_words_add_up_to_one(words in words()) {
        let pdfa = Pdfa::from_words(&words);
        let accepted = accepted(&pdfa, &pdfa.probabilities(Semantics::MaximumLikelihood));
        let total: f64 = accepted.iter().map(|(_, probability)| probability).sum();
        prop_assert!(words.is_empty() || (total - 1.0).abs() < 1e-12, "{}", total);
        for word in &words {
            prop_assert!(accepted.iter().any(|(other, probability)| other == word && *probability > 0.0));
        }
    }

    #[test]
    fn whatever_the_weights_a_state_has_probability_one_or_weighs_nothing(pdfa in any_automaton()) {
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        for (&id, state) in &pdfa.states {
            let weight: f64 = state.transitions.values().map(|way| way.weight).sum();
            let weighs_nothing = weight == 0.0 && (!state.accepting || state.end_weight == 0.0);
            let expected = if weighs_nothing { 0.0 } else { 1.0 };
            prop_assert!((sum(&pdfa, &probabilities, id) - expected).abs() < 1e-12);
            prop_assert!(state.accepting || probabilities.end(id) == 0.0);
        }
    }

    #[test]
    fn published_probabilities_are_equations_2_and_3(pdfa in any_automaton()) {
        let probabilities = pdfa.probabilities(Semantics::Published);
        let inflow = |id: StateId| -> f64 {
            pdfa.transitions().filter(|(_, _, way)| way.target == id).map(|(_, _, way)| way.weight).sum()
        };
        let accepting: Vec<StateId> = pdfa.states.keys().copied().filter(|id| pdfa.states[id].accepting).collect();
        let total: f64 = accepting.iter().map(|&id| inflow(id)).sum();
        for (source, symbol, way) in pdfa.transitions() {
            let outgoing: f64 = pdfa.states[&source].transitions.values().map(|way| way.weight).sum();
            let expected = if outgoing > 0.0 { way.weight / outgoing } else { 0.0 };
            prop_assert!((probabilities.transition(source, symbol) - expected).abs() < 1e-12);
        }
        for &id in pdfa.states.keys() {
            let expected = match accepting.as_slice() {
                [only] if *only == id => 1.0,
                _ if accepting.contains(&id) && total > 0.0 => inflow(id) / total,
                _ => 0.0,
            };
            prop_assert!((probabilities.end(id) - expected).abs() < 1e-12);
        }
    }
}

#[test]
fn a_symbol_that_comes_again_stays_in_its_state() {
    let (a, b) = (Symbol(0), Symbol(1));
    let pdfa = Pdfa::from_words(&[vec![a, a, b, a]]);
    let steps: Vec<(u32, u32, u32)> =
        pdfa.transitions().map(|(source, symbol, way)| (source.0, symbol.0, way.target.0)).collect();
    assert_eq!(steps, [(0, 0, 1), (1, 0, 1), (1, 1, 2), (2, 0, 2)]);
}

#[test]
fn without_words_there_is_the_initial_state_alone() {
    let pdfa = Pdfa::from_words(&[]);
    assert_eq!(pdfa.states.into_iter().collect::<Vec<_>>(), [(StateId(0), State::default())]);
}

#[test]
fn a_demonstration_that_completes_nothing_ends_where_it_starts() {
    let pdfa = Pdfa::from_words(&[vec![], vec![Symbol(0)]]);
    let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
    assert_eq!(probabilities.end(pdfa.initial), 0.5);
    assert_eq!(pdfa.word_probability(&[], &probabilities), 0.5);
}
