//! The examples of the paper, from words to plans.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]
#![allow(clippy::float_cmp, reason = "the same arithmetic gives the same numbers")]

use std::collections::BTreeSet;

use goalgraph::pdfa::{Pdfa, Probabilities, Semantics, StateId, Symbol, Word};
use goalgraph::plan::{NoPlan, Plan, PlanRequest, Strategy as Choice, plan};
use proptest::prelude::*;

/// A task whose sub-goals are letters.
struct Task {
    alphabet: &'static str,
    pdfa: Pdfa,
    probabilities: Probabilities,
}

impl Task {
    /// Learns from words, each with how often it was demonstrated.
    fn learn(alphabet: &'static str, demonstrations: &[(usize, &str)]) -> Self {
        let repeated = |&(count, text): &(usize, &str)| vec![word(alphabet, text); count];
        let words: Vec<Word> = demonstrations.iter().flat_map(repeated).collect();
        let pdfa = Pdfa::from_words(&words);
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        Self { alphabet, pdfa, probabilities }
    }

    fn letters<'a>(&self, symbols: impl IntoIterator<Item = &'a Symbol>) -> String {
        symbols.into_iter().map(|symbol| &self.alphabet[symbol.0 as usize..=symbol.0 as usize]).collect()
    }

    /// States, transitions, accepting states.
    fn size(&self) -> [usize; 3] {
        let accepting = self.pdfa.states.values().filter(|state| state.accepting).count();
        [self.pdfa.states.len(), self.pdfa.transitions().count(), accepting]
    }

    /// The transitions as `ry -g-> ryg 3 1.00`: count and probability.
    fn transitions(&self) -> Vec<String> {
        let completed = |id: StateId| self.letters(&self.pdfa.states[&id].completed);
        let line = |(source, symbol, way): (StateId, Symbol, &goalgraph::pdfa::Transition)| {
            let probability = self.probabilities.transition(source, symbol);
            let letter = self.letters([&symbol]);
            format!(
                "{} -{letter}-> {} {} {probability:.2}",
                completed(source),
                completed(way.target),
                way.count
            )
        };
        self.pdfa.transitions().map(line).collect()
    }

    /// The state with these sub-goals completed.
    fn state(&self, completed: &str) -> StateId {
        let completed: BTreeSet<Symbol> = word(self.alphabet, completed).into_iter().collect();
        *self.pdfa.states.iter().find(|(_, state)| state.completed == completed).unwrap().0
    }

    fn plan(&self, completed: &str, unavailable: &str, strategy: Choice) -> Result<Plan, NoPlan> {
        let unavailable = word(self.alphabet, unavailable).into_iter().collect();
        let request = PlanRequest { from: self.state(completed), unavailable, strategy };
        plan(&self.pdfa, &self.probabilities, &request)
    }

    /// The plan from the state with `completed`, by both strategies the same.
    #[track_caller]
    fn check_plan(&self, completed: &str, unavailable: &str, expected: &str) {
        for strategy in [Choice::Greedy, Choice::MostProbable] {
            let plan = self.plan(completed, unavailable, strategy).unwrap();
            assert_eq!(self.letters(&plan.word), expected, "{strategy:?}");
        }
    }

    /// There is no plan, and `expected` is what can be done meanwhile.
    #[track_caller]
    fn check_meanwhile(&self, completed: &str, unavailable: &str, expected: &str) {
        for strategy in [Choice::Greedy, Choice::MostProbable] {
            let Err(NoPlan::OutOfReach { from, meanwhile }) = self.plan(completed, unavailable, strategy)
            else {
                panic!("there is a plan, or the state is unknown");
            };
            assert_eq!(from, self.state(completed));
            assert_eq!(self.letters(&meanwhile.word), expected, "{strategy:?}");
        }
    }
}

fn word(alphabet: &str, text: &str) -> Word {
    text.chars().map(|letter| Symbol(alphabet.find(letter).unwrap() as u32)).collect()
}

/// All orders of the letters.
fn orders(letters: &str) -> Vec<String> {
    if letters.is_empty() {
        return vec![String::new()];
    }
    let starting_with = |first: char| {
        let rest = orders(&letters.replace(first, ""));
        rest.into_iter().map(move |order| format!("{first}{order}"))
    };
    letters.chars().flat_map(starting_with).collect()
}

/// Red and yellow in either order, green on both.
fn tower() -> Task {
    Task::learn("ryg", &[(2, "ryg"), (1, "yrg")])
}

/// Yellow on red, blue on green.
fn two_stacks() -> Task {
    let orders = [(7, "rygb"), (3, "rgyb"), (2, "rgby"), (2, "gbry"), (2, "gryb"), (2, "grby")];
    Task::learn("rygb", &orders)
}

#[test]
fn the_tower_takes_red_and_yellow_in_either_order_and_green_last() {
    let tower = tower();
    assert_eq!(tower.size(), [5, 5, 1]);
    let expected =
        [" -r-> r 2 0.67", " -y-> y 1 0.33", "r -y-> ry 2 1.00", "ry -g-> ryg 3 1.00", "y -r-> ry 1 1.00"];
    assert_eq!(tower.transitions(), expected);
    assert_eq!(tower.pdfa.states[&tower.state("ryg")].end_count, 3);
}

#[test]
fn the_tower_is_built_in_the_preferred_order_or_the_other_when_red_is_late() {
    let tower = tower();
    tower.check_plan("", "", "ryg");
    assert!((tower.plan("", "", Choice::Greedy).unwrap().probability - 2.0 / 3.0).abs() < 1e-12);
    tower.check_plan("y", "", "rg");
    tower.check_meanwhile("", "r", "y");
    tower.check_meanwhile("", "g", "ry");
}

#[test]
fn two_stacks_of_two_have_six_orders_in_nine_states() {
    let task = two_stacks();
    assert_eq!(task.size(), [9, 12, 1]);
    let count = |order: &&String| task.pdfa.word_probability(&word("rygb", order), &task.probabilities) > 0.0;
    let accepted: Vec<String> = orders("rygb").iter().filter(count).cloned().collect();
    assert_eq!(accepted, ["rygb", "rgyb", "rgby", "gryb", "grby", "gbry"]);
}

#[test]
fn two_stacks_of_two_are_built_in_the_preferred_order() {
    let task = two_stacks();
    task.check_plan("", "", "rygb");
    let plan = task.plan("", "", Choice::Greedy).unwrap();
    assert!((plan.probability - 12.0 / 18.0 * 7.0 / 12.0).abs() < 1e-12);
    assert_eq!(plan.states.len(), 5);
}

#[test]
fn without_yellow_the_other_stack_is_built_meanwhile() {
    let task = two_stacks();
    task.check_meanwhile("", "y", "rgb");
    task.check_plan("rgb", "", "y");
}

#[test]
fn when_yellow_goes_missing_in_the_middle_of_a_run_the_rest_is_planned_again() {
    let task = two_stacks();
    task.check_plan("r", "", "ygb");
    task.check_meanwhile("r", "y", "gb");
    task.check_meanwhile("g", "y", "rb");
    task.check_meanwhile("rgb", "y", "");
    task.check_plan("ryg", "y", "b");
}

#[test]
fn four_blocks_have_24_orders_in_16_states() {
    let orders = orders("rygb");
    let demonstrations: Vec<(usize, &str)> = orders.iter().map(|order| (1, order.as_str())).collect();
    let task = Task::learn("rygb", &demonstrations);
    assert_eq!(orders.len(), 24);
    assert_eq!(task.size(), [16, 32, 1]);
    for order in &orders {
        let probability = task.pdfa.word_probability(&word("rygb", order), &task.probabilities);
        assert!((probability - 1.0 / 24.0).abs() < 1e-12, "{order}");
    }
    task.check_plan("", "", "rygb");
    task.check_plan("b", "", "ryg");
    task.check_meanwhile("", "r", "ygb");
}

#[test]
fn stacks_that_are_built_again_have_3_6_9_or_12_sub_goals_in_a_row() {
    let alphabet = "abcdefghijkl";
    for length in [3, 6, 9, 12] {
        let task = Task::learn(alphabet, &[(5, &alphabet[..length])]);
        assert_eq!(task.size(), [length + 1, length, 1]);
        assert!(task.transitions().iter().all(|line| line.ends_with(" 5 1.00")));
        task.check_plan("", "", &alphabet[..length]);
        task.check_plan(&alphabet[..2], "", &alphabet[2..length]);
        task.check_meanwhile("", "c", "ab");
    }
}

#[test]
fn a_drone_visits_three_places_in_the_order_it_prefers() {
    let task = Task::learn("abc", &[(5, "abc"), (3, "acb"), (2, "bac"), (2, "cba")]);
    assert_eq!(task.size(), [8, 10, 1]);
    assert_eq!(&task.transitions()[..3], [" -a-> a 8 0.67", " -b-> b 2 0.17", " -c-> c 2 0.17"]);
    task.check_plan("", "", "abc");
    task.check_plan("c", "", "ba");
    task.check_meanwhile("", "a", "cb");
    task.check_meanwhile("", "b", "ac");
}

#[test]
fn an_arm_goes_clockwise_or_counter_clockwise_to_the_same_pose() {
    let task = Task::learn("lurc", &[(3, "lurc"), (2, "rulc")]);
    assert_eq!(task.size(), [7, 7, 1]);
    task.check_plan("", "", "lurc");
    task.check_plan("r", "", "ulc");
    task.check_meanwhile("", "l", "ru");
    task.check_meanwhile("", "r", "lu");
    // On the left side, clockwise is the only way that was shown.
    task.check_plan("lu", "", "rc");
}

#[test]
fn the_published_probabilities_of_two_words_a_and_b_add_up_to_one_half() {
    let task = Task::learn("ab", &[(1, "a"), (1, "b")]);
    let both = |semantics| {
        let probabilities = task.pdfa.probabilities(semantics);
        ["a", "b"].map(|text| task.pdfa.word_probability(&word("ab", text), &probabilities))
    };
    assert_eq!(both(Semantics::Published), [0.25, 0.25]);
    assert_eq!(both(Semantics::MaximumLikelihood), [0.5, 0.5]);
}

proptest! {
    #[test]
    fn with_one_accepting_state_that_has_no_way_out_the_two_semantics_agree(
        words in prop::collection::vec(Just((0..5).map(Symbol).collect::<Word>()).prop_shuffle(), 1..20)
    ) {
        let pdfa = Pdfa::from_words(&words);
        let likely = pdfa.probabilities(Semantics::MaximumLikelihood);
        prop_assert_eq!(pdfa.probabilities(Semantics::Published), likely);
    }
}
