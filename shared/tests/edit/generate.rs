//! Specifications and edits, sensible and nonsensical ones, and what must hold after every edit.

use goalgraph::edit::{Edit, Outcome, Pruned};
use goalgraph::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition, Word};
use goalgraph::specification::{Ball, DemonstrationWord, Specification, SubGoal, SubsetParameters};
use proptest::prelude::*;

/// How many sub-goals the specifications have; edits name one more.
pub(crate) const ALPHABET: u32 = 4;

/// So many cases, some of which may not be of interest; what fails is not written to a file.
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        max_global_rejects: 99 * cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn symbol() -> impl Strategy<Value = Symbol> {
    (0..ALPHABET).prop_map(Symbol)
}

pub(crate) fn word() -> impl Strategy<Value = Word> {
    prop::collection::vec(symbol(), 0..6)
}

pub(crate) fn words() -> impl Strategy<Value = Vec<Word>> {
    prop::collection::vec(word(), 0..8)
}

/// Words without repetitions, as Algorithm 1 reads them: their automaton has no cycles.
pub(crate) fn simple_words() -> impl Strategy<Value = Vec<Word>> {
    let order = Just((0..ALPHABET).map(Symbol).collect::<Word>()).prop_shuffle();
    let word = (order, 0..=ALPHABET as usize).prop_map(|(order, length)| order[..length].to_vec());
    prop::collection::vec(word, 1..8)
}

fn sub_goal(id: u32) -> SubGoal {
    let subset = if id < 2 { "red" } else { "yellow" };
    let features = vec![format!("{subset}.x")];
    let ball = Ball { subset: subset.to_owned(), features, center: vec![f64::from(id)], radius: 0.25 };
    SubGoal {
        id: Symbol(id),
        name: format!("place {id}"),
        ball: Some(ball),
        frames: 7,
        demonstrations: 1,
        color: None,
    }
}

/// The specification that these words give.
pub(crate) fn learned(words: &[Word]) -> Specification {
    let feature = |name: &str| goalgraph::demonstration::Feature { name: name.to_owned(), unit: None };
    let subset = |name: &str| SubsetParameters {
        name: name.to_owned(),
        features: vec![format!("{name}.x")],
        epsilon: 0.1,
        min_points: 3,
        min_dwell: 1,
    };
    let demonstration = |(index, word): (usize, &Word)| DemonstrationWord {
        name: format!("demo {index}"),
        sha256: String::new(),
        frames: 0,
        word: word.clone(),
    };
    Specification {
        name: "Task".to_owned(),
        semantics: Semantics::default(),
        features: vec![feature("red.x"), feature("yellow.x")],
        subsets: vec![subset("red"), subset("yellow")],
        sub_goals: (0..ALPHABET).map(sub_goal).collect(),
        pdfa: Pdfa::from_words(words),
        demonstrations: words.iter().enumerate().map(demonstration).collect(),
    }
}

fn weight() -> impl Strategy<Value = f64> {
    prop_oneof![2 => (0..4_u32).prop_map(f64::from), 1 => 0.1..9.0_f64]
}

fn extreme_weight() -> impl Strategy<Value = f64> {
    prop_oneof![4 => weight(), 1 => Just(1e100), 1 => Just(1e-300)]
}

fn extreme_count() -> impl Strategy<Value = u64> {
    prop_oneof![9 => 0..5_u64, 1 => Just(u64::MAX)]
}

/// Any automaton of at most six states: with cycles, unreachable states and weights of zero.
fn any_pdfa<Count, Weight>(count: fn() -> Count, weight: fn() -> Weight) -> impl Strategy<Value = Pdfa>
where
    Count: Strategy<Value = u64>,
    Weight: Strategy<Value = f64>,
{
    let ways = prop::collection::btree_map(symbol(), (0..6_u32, count(), weight()), 0..4);
    let completed = prop::collection::btree_set(symbol(), 0..3);
    let state = (prop::option::of("[a-c]"), completed, any::<bool>(), count(), weight(), ways);
    prop::collection::vec(state, 1..7).prop_map(|states| {
        let number = states.len() as u32;
        let state = |(id, (name, completed, accepting, end_count, end_weight, ways))| {
            let ways: std::collections::BTreeMap<Symbol, (u32, u64, f64)> = ways;
            let way = |(symbol, (target, count, weight))| {
                (symbol, Transition { target: StateId(target % number), count, weight })
            };
            let transitions = ways.into_iter().map(way).collect();
            (StateId(id), State { name, completed, accepting, end_count, end_weight, transitions })
        };
        Pdfa { initial: StateId(0), states: (0..).zip(states).map(state).collect() }
    })
}

/// A specification as it was learned, or one with any automaton.
pub(crate) fn any_specification() -> impl Strategy<Value = Specification> {
    with_words(any_pdfa(|| 0..5_u64, weight))
}

/// As [`any_specification`], also with counts and weights so large and small that sums and products have no number.
pub(crate) fn extreme_specification() -> impl Strategy<Value = Specification> {
    with_words(any_pdfa(extreme_count, extreme_weight))
}

fn with_words(pdfa: impl Strategy<Value = Pdfa>) -> impl Strategy<Value = Specification> {
    (words(), prop::option::of(pdfa)).prop_map(|(words, pdfa)| {
        let learned = learned(&words);
        let pdfa = pdfa.unwrap_or_else(|| learned.pdfa.clone());
        Specification { pdfa, ..learned }
    })
}

fn name() -> impl Strategy<Value = String> {
    prop_oneof![Just(String::new()), Just(" ".to_owned()), Just("a\nb".to_owned()), "\\PC{1,9}", "x{199,201}"]
}

fn probability() -> impl Strategy<Value = f64> {
    prop_oneof![6 => 0.0..=1.0_f64, 1 => Just(0.0), 1 => Just(1.0), 1 => -1.0..2.0_f64, 1 => Just(f64::NAN)]
}

fn outcome() -> impl Strategy<Value = Outcome> {
    prop_oneof![3 => symbol().prop_map(Outcome::Transition), 1 => Just(Outcome::End)]
}

fn replacement() -> impl Strategy<Value = String> {
    prop_oneof![words().prop_map(|words| learned(&words).to_json()), Just("{}".to_owned())]
}

/// Any edit; ids of new states are taken from where [`with_new_ids`] puts them.
pub(crate) fn any_edit() -> impl Strategy<Value = Edit> {
    let state = || prop_oneof![9 => 0..8_u32, 1 => 0..20_u32].prop_map(StateId);
    let symbol = || (0..=ALPHABET).prop_map(Symbol);
    let ways = || prop_oneof![Just(Pruned::Cut), Just(Pruned::Heal)];
    let semantics = prop_oneof![Just(Semantics::MaximumLikelihood), Just(Semantics::Published)];
    let first_new =
        || prop_oneof![9 => Just(StateId(0)), 1 => Just(StateId(3)), 1 => Just(StateId(u32::MAX))];
    let locked = prop::collection::btree_set(outcome(), 0..3);
    let names = prop_oneof![
        name().prop_map(|name| Edit::RenameTask { name }),
        semantics.prop_map(|semantics| Edit::SetSemantics { semantics }),
        (state(), name()).prop_map(|(state, name)| Edit::RenameState { state, name }),
        (symbol(), name()).prop_map(|(symbol, name)| Edit::RenameSubGoal { symbol, name }),
        (symbol(), prop::option::of(0..10_u8))
            .prop_map(|(symbol, color)| Edit::RecolorSubGoal { symbol, color }),
    ];
    let weights = prop_oneof![
        (state(), outcome(), probability(), locked).prop_map(|(state, outcome, probability, locked)| {
            Edit::Reweight { state, outcome, probability, locked }
        }),
        state().prop_map(|state| Edit::ResetWeights { state }),
        (state(), any::<bool>()).prop_map(|(state, accepting)| Edit::SetAccepting { state, accepting }),
    ];
    let structure = prop_oneof![
        (state(), state()).prop_map(|(kept, merged)| Edit::MergeStates { kept, merged }),
        (state(), ways()).prop_map(|(state, ways)| Edit::PruneState { state, ways }),
        (state(), symbol(), ways()).prop_map(|(source, symbol, ways)| Edit::PruneTransition {
            source,
            symbol,
            ways
        }),
        first_new().prop_map(|id| Edit::AddState { id }),
        (state(), symbol(), state()).prop_map(|(source, symbol, target)| Edit::AddTransition {
            source,
            symbol,
            target
        }),
        (state(), symbol(), state(), state()).prop_map(|(source, symbol, new_source, new_target)| {
            Edit::MoveTransition { source, symbol, new_source, new_target }
        }),
    ];
    let language = prop_oneof![
        4 => (word(), first_new()).prop_map(|(word, first_new)| Edit::AddWord { word, first_new }),
        4 => (word(), first_new()).prop_map(|(word, first_new)| Edit::ForbidWord { word, first_new }),
        1 => (symbol(), symbol(), first_new())
            .prop_map(|(kept, merged, first_new)| Edit::MergeSubGoals { kept, merged, first_new }),
        1 => (symbol(), first_new()).prop_map(|(symbol, first_new)| Edit::RemoveSubGoal { symbol, first_new }),
        1 => replacement().prop_map(|specification| Edit::Replace { specification }),
    ];
    prop_oneof![1 => names, 2 => weights, 4 => structure, 3 => language]
}

/// The id above all of the specification.
pub(crate) fn above(specification: &Specification) -> StateId {
    specification.pdfa.states.keys().next_back().map_or(StateId(0), |last| StateId(last.0.saturating_add(1)))
}

/// The edit with `next` as its first new id, where it has q0.
pub(crate) fn with_new_ids(mut edit: Edit, next: StateId) -> Edit {
    if let Edit::AddState { id: first_new }
    | Edit::MergeSubGoals { first_new, .. }
    | Edit::RemoveSubGoal { first_new, .. }
    | Edit::AddWord { first_new, .. }
    | Edit::ForbidWord { first_new, .. } = &mut edit
        && *first_new == StateId(0)
    {
        *first_new = next;
    }
    edit
}

/// What holds for every specification: its file is accepted and says the same, and where something may happen the
/// probabilities add up to 1.
#[track_caller]
pub(crate) fn assert_sound(specification: &Specification) {
    let text = specification.to_json();
    let read = Specification::from_json(&text).unwrap_or_else(|error| panic!("{error} in {text}"));
    assert_eq!(&read, specification);
    let probabilities = specification.pdfa.probabilities(Semantics::MaximumLikelihood);
    for (&id, state) in &specification.pdfa.states {
        let ways = state.transitions.keys().map(|&symbol| probabilities.transition(id, symbol));
        let sum = ways.sum::<f64>() + probabilities.end(id);
        assert!((sum - 1.0).abs() < 1e-9 || sum == 0.0, "{id}: {sum}");
    }
}
