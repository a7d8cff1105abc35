//! Whatever is in a file, it is read or refused.

use std::collections::BTreeMap;

use goalgraph::demonstration::Feature;
use goalgraph::export::{ExportFormat, export};
use goalgraph::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition, Word};
use goalgraph::plan::{PlanRequest, Strategy as Choice, plan};
use goalgraph::specification::{Ball, DemonstrationWord, Specification, SubGoal, SubsetParameters};
use proptest::prelude::*;

use crate::example;

fn name() -> impl Strategy<Value = String> {
    prop_oneof![3 => "[a-z]{1,4}( [0-9])?", 1 => any::<String>()]
}

/// A finite number, often whole.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![(-9..9_i32).prop_map(f64::from), -1.0..1.0_f64, prop::num::f64::NORMAL]
}

fn weight() -> impl Strategy<Value = f64> {
    prop_oneof![(0..9_u32).prop_map(f64::from), 0.0..1e3_f64, 0.0..1e100_f64]
}

/// Subsets of up to three features each, one feature in no subset.
fn subsets() -> impl Strategy<Value = (Vec<Feature>, Vec<SubsetParameters>)> {
    let subset = (1..=3_usize, 0.0..1.0_f64, 1..50_usize, 1..9_usize, prop::option::of(name()));
    prop::collection::vec(subset, 0..3).prop_map(|subsets| {
        let mut features = vec![Feature::new("alone")];
        let mut parameters = Vec::new();
        for (index, (dimension, epsilon, min_points, min_dwell, unit)) in subsets.into_iter().enumerate() {
            let names: Vec<String> = (0..dimension).map(|axis| format!("{index}.{axis}")).collect();
            features.extend(names.iter().map(|name| Feature { name: name.clone(), unit: unit.clone() }));
            let name = format!("subset {index}");
            parameters.push(SubsetParameters { name, features: names, epsilon, min_points, min_dwell });
        }
        (features, parameters)
    })
}

fn states() -> impl Strategy<Value = BTreeMap<StateId, State>> {
    let ways =
        prop::collection::btree_map((0..4_u32).prop_map(Symbol), (0..6_u32, any::<u64>(), weight()), 0..4);
    let completed = prop::collection::btree_set((0..4_u32).prop_map(Symbol), 0..4);
    let state = (prop::option::of(name()), completed, any::<bool>(), any::<u64>(), weight(), ways);
    let state = state.prop_map(|(name, completed, accepting, end_count, end_weight, ways)| {
        // Targets are positions in the list of states until their ids are known.
        let way = |(symbol, (target, count, weight))| {
            (symbol, Transition { target: StateId(target), count, weight })
        };
        let transitions = ways.into_iter().map(way).collect();
        State { name, completed, accepting, end_count, end_weight, transitions }
    });
    prop::collection::btree_map(any::<u32>().prop_map(StateId), state, 1..6).prop_map(|mut states| {
        let ids: Vec<StateId> = states.keys().copied().collect();
        for way in states.values_mut().flat_map(|state| state.transitions.values_mut()) {
            way.target = ids[way.target.0 as usize % ids.len()];
        }
        states
    })
}

/// Any valid specification over four sub-goals.
fn any_specification() -> impl Strategy<Value = Specification> {
    let balls = prop::collection::vec(
        prop::option::of((any::<prop::sample::Index>(), [number(), number(), number()], 0.0..9.0_f64)),
        4,
    );
    let word = prop::collection::vec((0..4_u32).prop_map(Symbol), 0..5);
    let demonstrations = prop::collection::vec((name(), "[0-9a-f]{0,8}", 0..999_usize, word), 0..4);
    let semantics = prop_oneof![Just(Semantics::MaximumLikelihood), Just(Semantics::Published)];
    (name(), semantics, subsets(), balls, states(), any::<prop::sample::Index>(), demonstrations).prop_map(
        |(name, semantics, (features, subsets), balls, states, initial, demonstrations)| {
            let ball = |(index, center, radius): (prop::sample::Index, [f64; 3], f64)| {
                let subset: &SubsetParameters = (!subsets.is_empty()).then(|| index.get(&subsets))?;
                let center = center[..subset.features.len()].to_vec();
                Some(Ball { subset: subset.name.clone(), features: subset.features.clone(), center, radius })
            };
            let sub_goal = |(id, place): (usize, Option<_>)| SubGoal {
                id: Symbol(id as u32),
                name: format!("{name} {id}"),
                ball: place.and_then(ball),
                frames: id * 7,
                demonstrations: id,
                color: (id % 2 == 1).then_some(id as u8),
            };
            let sub_goals = balls.into_iter().enumerate().map(sub_goal).collect();
            let demonstration = |(name, sha256, frames, word): (String, String, usize, Word)| {
                DemonstrationWord { name, sha256, frames, word }
            };
            let demonstrations = demonstrations.into_iter().map(demonstration).collect();
            let initial = *states.keys().nth(initial.index(states.len())).unwrap();
            let pdfa = Pdfa { initial, states };
            Specification { name, semantics, features, subsets, sub_goals, pdfa, demonstrations }
        },
    )
}

/// Everything that is done with a specification that was read.
fn use_it(specification: &Specification) {
    specification.check();
    assert_eq!(Specification::from_json(&specification.to_json()).as_ref(), Ok(specification));
    export(specification, ExportFormat::Dot);
    let probabilities = specification.pdfa.probabilities(specification.semantics);
    for strategy in [Choice::Greedy, Choice::MostProbable] {
        let request =
            PlanRequest { from: specification.pdfa.initial, unavailable: [Symbol(1)].into(), strategy };
        let _ = plan(&specification.pdfa, &probabilities, &request);
    }
}

/// One damage to a text: where, and what is done there.
fn damage() -> impl Strategy<Value = (prop::sample::Index, Damage)> {
    let token = prop::sample::select(vec![
        "null",
        "{}",
        "[",
        "]",
        ",",
        "\"",
        "-1",
        "1e999",
        "0.5",
        "\"q1\"",
        "\"g1\"",
        "18446744073709551616",
        "q",
        "g0",
        "é",
        "\\u0000",
        "true",
        "9",
        "0",
    ]);
    let damage = prop_oneof![
        Just(Damage::Remove),
        token.prop_map(Damage::Insert),
        prop::char::range(' ', '~').prop_map(Damage::Replace),
        any::<prop::sample::Index>().prop_map(Damage::Swap),
    ];
    (any::<prop::sample::Index>(), damage)
}

#[derive(Clone, Debug)]
enum Damage {
    Remove,
    Insert(&'static str),
    Replace(char),
    /// The line goes where that other line is, and the other way round.
    Swap(prop::sample::Index),
}

fn damaged(text: &str, at: prop::sample::Index, damage: &Damage) -> String {
    let mut characters: Vec<char> = text.chars().collect();
    let position = at.index(characters.len());
    match damage {
        Damage::Remove => drop(characters.remove(position)),
        Damage::Insert(token) => drop(characters.splice(position..position, token.chars())),
        Damage::Replace(character) => characters[position] = *character,
        Damage::Swap(other) => {
            let mut lines: Vec<&str> = text.lines().collect();
            let count = lines.len();
            lines.swap(at.index(count), other.index(count));
            return lines.join("\n");
        }
    }
    characters.into_iter().collect()
}

proptest! {
    #[test]
    fn a_specification_is_read_back_as_it_was_and_gives_the_same_bytes(specification in any_specification()) {
        let text = specification.to_json();
        let read = Specification::from_json(&text);
        prop_assert_eq!(read.as_ref(), Ok(&specification));
        prop_assert_eq!(read.unwrap().to_json(), text);
        use_it(&specification);
    }

    #[test]
    fn a_damaged_file_is_read_or_refused_but_never_a_panic(damages in prop::collection::vec(damage(), 1..4)) {
        let intact = example().to_json();
        let text = damages.iter().fold(intact, |text, (at, damage)| damaged(&text, *at, damage));
        if let Ok(specification) = Specification::from_json(&text) {
            use_it(&specification);
        }
    }

    #[test]
    fn any_text_is_refused_or_read(text in any::<String>()) {
        prop_assert!(Specification::from_json(&text).is_err());
    }
}
