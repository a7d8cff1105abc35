//! The specification file: what it says, what is refused, and what is found wrong with it.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::collections::BTreeMap;

use goalgraph::demonstration::Feature;
use goalgraph::export::{ExportFormat, export};
use goalgraph::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition, Word};
use goalgraph::plan::{PlanRequest, Strategy as Choice, plan};
use goalgraph::specification::{
    Ball, DemonstrationWord, Problem, Severity, Specification, SubGoal, SubsetParameters,
};
use proptest::prelude::*;

/// Red, then yellow; or yellow alone.
const EXAMPLE: &str = r#"{
  "format": "goalgraph-specification",
  "version": 1,
  "name": "Two blocks",
  "semantics": "maximum_likelihood",
  "features": [{"name": "red.x", "unit": "m"}, {"name": "red.y"}, {"name": "yellow.x"}],
  "subsets": [
    {"name": "red", "features": ["red.x", "red.y"], "epsilon": 0.008, "min_points": 20, "min_dwell": 9},
    {"name": "yellow", "features": ["yellow.x"], "epsilon": 0.01, "min_points": 12}
  ],
  "sub_goals": [
    {"id": "g0", "name": "red 1", "subset": "red", "features": ["red.x", "red.y"],
     "center": [0.2, -0.03], "radius": 0.011, "frames": 812, "demonstrations": 2},
    {"id": "g1", "name": "yellow 1", "frames": 0, "demonstrations": 3}
  ],
  "automaton": {
    "initial": "q0",
    "states": [
      {"id": "q0", "completed": [], "accepting": false, "end_count": 0, "end_weight": 0, "final_probability": 0},
      {"id": "q1", "completed": ["g0"], "accepting": false, "end_count": 0, "end_weight": 0, "final_probability": 0},
      {"id": "q2", "completed": ["g0", "g1"], "accepting": true, "end_count": 2, "end_weight": 2, "final_probability": 1},
      {"id": "q3", "completed": ["g1"], "accepting": true, "end_count": 1, "end_weight": 1, "final_probability": 1}
    ],
    "transitions": [
      {"source": "q0", "symbol": "g0", "target": "q1", "count": 2, "weight": 2, "probability": 0.6667},
      {"source": "q0", "symbol": "g1", "target": "q3", "count": 1, "weight": 1, "probability": 0.3333},
      {"source": "q1", "symbol": "g1", "target": "q2", "count": 2, "weight": 2, "probability": 1}
    ]
  },
  "demonstrations": [
    {"name": "demo_00.csv", "sha256": "9f86d081", "frames": 262, "word": ["g0", "g1"]}
  ]
}
"#;

fn example() -> Specification {
    Specification::from_json(EXAMPLE).unwrap()
}

/// The example with one of its texts replaced.
#[track_caller]
fn edited(from: &str, to: &str) -> String {
    assert!(EXAMPLE.contains(from), "{from}");
    EXAMPLE.replacen(from, to, 1)
}

/// The example with that edit is refused with this message.
#[track_caller]
fn refused(from: &str, to: &str, message: &str) {
    let error = Specification::from_json(&edited(from, to)).unwrap_err();
    assert_eq!(error.to_string(), message, "{from} -> {to}");
}

#[test]
fn the_example_is_read_as_it_stands() {
    let example = example();
    assert_eq!(example.name, "Two blocks");
    assert_eq!(example.features[0], Feature { name: "red.x".to_owned(), unit: Some("m".to_owned()) });
    assert_eq!(example.features[1].unit, None);
    assert_eq!([example.subsets[0].min_dwell, example.subsets[1].min_dwell], [9, 1]);
    assert_eq!(example.sub_goals[0].ball.as_ref().unwrap().center, [0.2, -0.03]);
    assert_eq!(example.sub_goals[1].ball, None);
    let words = [vec![Symbol(0), Symbol(1)], vec![Symbol(0), Symbol(1)], vec![Symbol(1)]];
    assert_eq!(example.pdfa, Pdfa::from_words(&words));
    assert_eq!(example.demonstrations[0].word, words[0]);
    assert_eq!(example.check(), []);
}

#[test]
fn what_is_written_is_exact_and_in_a_fixed_order() {
    let text = example().to_json();
    assert!(text.contains(&format!("\"probability\": {}", 2.0 / 3.0)), "{text}");
    assert!(text.contains("\"end_weight\": 2,\n"), "whole numbers have no fraction: {text}");
    assert!(text.contains("\"min_dwell\": 1\n") && text.ends_with("}\n"));
    assert!(!text.contains("null"), "what is not there is left out: {text}");
    let states = r#"{"id": "q3", "completed": ["g1"], "accepting": true, "end_count": 1, "end_weight": 1, "final_probability": 1}"#;
    let first = r#"{"id": "q0", "completed": [], "accepting": false, "end_count": 0, "end_weight": 0, "final_probability": 0}"#;
    let swapped = edited(states, "HERE").replace(first, states).replace("HERE", first);
    assert_eq!(Specification::from_json(&swapped).unwrap().to_json(), text);
}

#[test]
fn names_of_states_and_colors_of_sub_goals_are_kept_and_left_out_where_there_are_none() {
    let plain = example();
    assert!(!plain.to_json().contains("\"color\""));
    let colored = edited(r#""frames": 0, "#, r#""color": 7, "frames": 0, "#);
    let named = colored.replacen(r#"{"id": "q3", "#, r#"{"id": "q3", "name": "yellow only", "#, 1);
    let example = Specification::from_json(&named).unwrap();
    assert_eq!([example.sub_goals[0].color, example.sub_goals[1].color], [None, Some(7)]);
    assert_eq!(example.pdfa.states[&StateId(3)].name.as_deref(), Some("yellow only"));
    assert_eq!(example.pdfa.states[&StateId(0)].name, None);
    let text = example.to_json();
    assert!(text.contains("\"id\": \"q3\",\n        \"name\": \"yellow only\",\n"), "{text}");
    assert!(text.contains("\"demonstrations\": 3,\n      \"color\": 7\n"), "{text}");
    assert_eq!(Specification::from_json(&text).unwrap(), example);
}

#[test]
fn what_contradicts_itself_is_refused_with_its_place() {
    refused(r#"{"name": "red.y"}"#, r#"{"name": "red.x"}"#, "features[1]: red.x is there twice");
    refused(r#"{"name": "yellow", "#, r#"{"name": "red", "#, "subsets[1]: red is there twice");
    refused(r#""id": "g1""#, r#""id": "g0""#, "sub_goals[1]: g0 is there twice");
    refused(r#""id": "q3""#, r#""id": "q0""#, "automaton.states[3]: q0 is there twice");
    refused(
        r#"["yellow.x"], "eps"#,
        r#"["green.x"], "eps"#,
        "subset yellow: there is no feature \"green.x\"",
    );
    refused(r#"["yellow.x"], "eps"#, r#"[], "eps"#, "subset yellow: it has no features");
    let twice = "subset yellow: features[1]: yellow.x is there twice";
    refused(r#"["yellow.x"], "eps"#, r#"["yellow.x", "yellow.x"], "eps"#, twice);
    refused("0.008", "-0.008", "subset red: epsilon: -0.008 must be a finite number not below 0");
    refused(
        r#""min_points": 20"#,
        r#""min_points": 0"#,
        "subset red: min_points and min_dwell must be at least 1",
    );
    refused(
        r#""min_dwell": 9"#,
        r#""min_dwell": 0"#,
        "subset red: min_points and min_dwell must be at least 1",
    );
    refused(r#""subset": "red""#, r#""subset": "blue""#, "sub_goal g0: there is no subset \"blue\"");
    let other = "sub_goal g0: its features are not those of subset \"yellow\"";
    refused(r#""subset": "red""#, r#""subset": "yellow""#, other);
    refused("[0.2, -0.03]", "[0.2]", "sub_goal g0: center has 1 coordinates for 2 features");
    refused("0.011", "-1", "sub_goal g0: radius: -1 must be a finite number not below 0");
    refused(r#" "radius": 0.011,"#, "", "sub_goal g0: subset, features, center and radius go together");
    refused(r#""frames": 0, "#, r#""frames": 0, "color": 8, "#, "sub_goal g1: color: 8 must be below 8");
    refused(r#""initial": "q0""#, r#""initial": "q9""#, "automaton.initial: there is no state q9");
    refused(r#"["g0"], "acc"#, r#"["g7"], "acc"#, "state q1: completed: there is no sub-goal g7");
    refused(r#"["g0"], "acc"#, r#"["g0", "g0"], "acc"#, "state q1: completed[1]: g0 is there twice");
    refused(r#""target": "q1""#, r#""target": "q8""#, "transition q0 g0 q8: there is no state q8");
    refused(r#""source": "q1""#, r#""source": "q8""#, "transition q8 g1 q2: there is no state q8");
    refused(r#""symbol": "g0""#, r#""symbol": "g5""#, "transition q0 g5 q1: there is no sub-goal g5");
    let second = "transition q0 g1 q3: q0 has a second transition by g1";
    refused(r#""symbol": "g0""#, r#""symbol": "g1""#, second);
    let weight = "transition q0 g0 q1: weight: -2 must be a number from 0 to 1e100";
    refused(r#""weight": 2"#, r#""weight": -2"#, weight);
    let end_weight = "state q2: end_weight: 2e300 must be a number from 0 to 1e100";
    refused(r#""end_weight": 2"#, r#""end_weight": 2e300"#, end_weight);
    let wrong = "transition q0 g0 q1: probability: 0.7 is written, but the weights give 0.6666666666666666";
    refused("0.6667", "0.7", wrong);
    let end = "state q2: final_probability: 0.5 is written, but the weights give 1";
    refused(r#""final_probability": 1"#, r#""final_probability": 0.5"#, end);
    refused(r#"["g0", "g1"]}"#, r#"["g0", "g3"]}"#, "demonstrations[0].word: there is no sub-goal g3");
    let published = "state q2: final_probability: 1 is written, but the weights give 0.6666666666666666";
    refused("maximum_likelihood", "published", published);
}

#[test]
fn what_is_not_of_this_shape_is_refused_with_line_and_column() {
    refused("1,\n  \"name\"", "2,\n  \"name\"", "version: 2, but this program reads version 1");
    refused("goalgraph-spec", "spec", "format: \"specification\" instead of \"goalgraph-specification\"");
    refused(
        r#"{"name": "red.y"}"#,
        r#"{"nam": "red.y"}"#,
        "line 6, column 53: unknown field `nam`, expected `name` or `unit`",
    );
    let unknown = "line 14, column 25: unknown field `colour`, expected one of `id`, `name`, `subset`, `features`, \
        `center`, `radius`, `frames`, `demonstrations`, `color`";
    refused(r#""name": "yellow 1", "#, r#""colour": "yellow 1", "#, unknown);
    refused(
        r#""name": "Two blocks""#,
        r#""name": "a", "name": "b""#,
        "line 4, column 21: duplicate field `name`",
    );
    refused("812", "1e999", "line 13, column 61: number out of range");
    refused("0.008", "1e999", "line 8, column 68: number out of range");
    refused("0.008", "NaN", "line 8, column 64: expected value");
    refused("0.008", "null", "line 8, column 67: invalid type: null, expected f64");
    refused("812", "-1", "line 13, column 58: invalid value: integer `-1`, expected usize");
    refused(
        r#""id": "q3""#,
        r#""id": "3""#,
        "line 22, column 16: \"3\" is no id; expected q and a number, such as q0",
    );
    refused(
        r#""id": "q3""#,
        r#""id": "q03""#,
        "line 22, column 18: \"q03\" is no id; expected q and a number, such as q0",
    );
    let large = "line 22, column 26: \"q9999999999\" is no id; expected q and a number, such as q0";
    refused(r#""id": "q3""#, r#""id": "q9999999999""#, large);
    refused(
        "maximum_likelihood",
        "guess",
        "line 5, column 22: unknown variant `guess`, expected `maximum_likelihood` or `published`",
    );
}

#[test]
fn what_is_no_specification_at_all_is_refused() {
    let message = |text: &str| Specification::from_json(text).unwrap_err().to_string();
    assert_eq!(message(""), "line 1, column 0: EOF while parsing a value");
    assert_eq!(message("red yellow"), "line 1, column 1: expected value");
    assert_eq!(message("{}"), "line 1, column 2: missing field `format`");
    assert_eq!(message("[1]"), "line 1, column 2: invalid type: integer `1`, expected a string");
    let other = r#"{"format": "other", "version": 7, "words": [[]]}"#;
    assert_eq!(message(other), "format: \"other\" instead of \"goalgraph-specification\"");
    let newer = r#"{"format": "goalgraph-specification", "version": 2, "tasks": {}}"#;
    assert_eq!(message(newer), "version: 2, but this program reads version 1");
    let nested = format!("{{\"name\": {}", "[".repeat(100_000));
    assert_eq!(message(&nested), "line 1, column 9: invalid type: sequence, expected a string");
    let deep = edited("[0.2, -0.03]", &"[".repeat(100_000));
    assert!(message(&deep).starts_with("line 13, column "));
}

#[test]
fn a_file_that_ends_too_early_is_refused_wherever_it_ends() {
    let whole = EXAMPLE.trim_end().len();
    for end in 0..whole {
        assert!(Specification::from_json(&EXAMPLE[..end]).is_err(), "{end}");
    }
    assert!(Specification::from_json(&EXAMPLE[..whole]).is_ok());
}

#[test]
fn written_probabilities_may_be_rounded_to_four_digits() {
    let text = edited("0.6667", "0.66659");
    assert_eq!(Specification::from_json(&text).unwrap(), example());
}

#[test]
fn files_with_windows_line_ends_are_read() {
    assert_eq!(Specification::from_json(&EXAMPLE.replace('\n', "\r\n")).unwrap(), example());
}

/// The problems as `error q3: message`.
fn problems(specification: &Specification) -> Vec<String> {
    let line = |problem: Problem| {
        let severity = if problem.severity == Severity::Error { "error" } else { "warning" };
        format!("{severity} {}: {}", problem.place(), problem.message)
    };
    specification.check().into_iter().map(line).collect()
}

/// The problems of the example after a change.
#[track_caller]
fn found(change: impl FnOnce(&mut Specification), expected: &[&str]) {
    let mut specification = example();
    change(&mut specification);
    assert_eq!(problems(&specification), expected);
}

fn state(specification: &mut Specification, id: u32) -> &mut State {
    specification.pdfa.states.get_mut(&StateId(id)).unwrap()
}

fn way(target: u32, weight: f64) -> Transition {
    Transition { target: StateId(target), count: 0, weight }
}

#[test]
fn each_problem_is_said_once_with_its_place() {
    found(
        |all| state(all, 2).accepting = false,
        &[
            "error q1: q1 is a dead end: no accepting state can be reached from it",
            "error q2: q2 is a dead end: no accepting state can be reached from it",
        ],
    );
    found(
        |all| state(all, 0).transitions.retain(|&symbol, _| symbol != Symbol(0)),
        &[
            "error q1: q1 cannot be reached from the initial state q0",
            "error q2: q2 cannot be reached from the initial state q0",
            "warning g0: red 1 is used by no transition",
        ],
    );
    found(
        |all| state(all, 0).transitions.get_mut(&Symbol(1)).unwrap().weight = 0.0,
        &["warning q0 g1 q3: yellow 1 from q0 has probability 0 and is never taken"],
    );
    found(
        |all| state(all, 3).transitions = [(Symbol(0), way(0, 1.0))].into(),
        &["warning q0: a cycle through q0, q3: the automaton accepts words of any length"],
    );
    found(
        |all| state(all, 3).transitions = [(Symbol(1), way(3, 1.0))].into(),
        &["warning q3: a cycle through q3: the automaton accepts words of any length"],
    );
    found(
        |all| {
            let twin = SubGoal { id: Symbol(2), name: "red 2".to_owned(), ..all.sub_goals[0].clone() };
            all.sub_goals.push(twin);
        },
        &["warning g2: red 2 is used by no transition", "warning g2: the balls of red 1 and red 2 overlap"],
    );
}

#[test]
fn weights_that_leave_no_way_to_an_end_are_an_error() {
    found(
        |all| state(all, 3).end_weight = 0.0,
        &["error q3: q3 is accepting, but of weight 0: no word ends there or further on"],
    );
    found(
        |all| state(all, 1).transitions.get_mut(&Symbol(1)).unwrap().weight = 0.0,
        &[
            "error q1: q1 is a dead end: no accepting state can be reached from it",
            "warning q1 g1 q2: yellow 1 from q1 has probability 0 and is never taken",
        ],
    );
    found(
        |all| state(all, 1).accepting = true,
        &["warning q1: q1 is accepting, but with probability 0: no word ends there"],
    );
}

#[test]
fn a_specification_of_nothing_is_valid_but_leads_nowhere() {
    let mut empty = example();
    empty.pdfa = Pdfa::from_words(&[]);
    empty.sub_goals.clear();
    empty.demonstrations.clear();
    assert_eq!(Specification::from_json(&empty.to_json()).unwrap(), empty);
    let expected = [
        "error q0: no words: nothing is accepted, for no way leads from q0 to an end",
        "error q0: q0 is a dead end: no accepting state can be reached from it",
    ];
    assert_eq!(problems(&empty), expected);
}

/// One word of `length` symbols, one state after the other.
fn chain(length: u32) -> Specification {
    let sub_goal = |id: u32| SubGoal {
        id: Symbol(id),
        name: String::new(),
        ball: None,
        frames: 0,
        demonstrations: 0,
        color: None,
    };
    let state = |id: u32| {
        let last = id == length;
        let transitions =
            if last { BTreeMap::new() } else { BTreeMap::from([(Symbol(id % 7), way(id + 1, 1.0))]) };
        let end_weight = f64::from(u8::from(last));
        (StateId(id), State { accepting: last, end_weight, transitions, ..State::default() })
    };
    Specification {
        sub_goals: (0..7).map(sub_goal).collect(),
        pdfa: Pdfa { initial: StateId(0), states: (0..=length).map(state).collect() },
        demonstrations: Vec::new(),
        features: Vec::new(),
        subsets: Vec::new(),
        ..example()
    }
}

#[test]
fn a_hundred_thousand_states_are_read_and_checked() {
    let long = chain(100_000);
    let read = Specification::from_json(&long.to_json()).unwrap();
    assert!(read == long);
    assert_eq!(read.check(), []);
}

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
