//! The specification file: what it says, what is refused, and what is found wrong with it.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

#[path = "specification/any_file.rs"]
mod any_file;
#[path = "specification/problems.rs"]
mod problems;

use goalgraph::demonstration::Feature;
use goalgraph::pdfa::{Pdfa, StateId, Symbol};
use goalgraph::specification::Specification;

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
