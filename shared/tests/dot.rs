//! An automaton that is written as DOT and read again is the same automaton.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]
#![allow(clippy::float_cmp, reason = "the same digits give the same numbers")]

use std::collections::BTreeSet;

use goalgraph::export::{ExportFormat, export};
use goalgraph::import::dot::read_dot;
use goalgraph::pdfa::{Pdfa, Semantics, StateId, Symbol, Word};
use goalgraph::specification::{Specification, SubGoal};
use proptest::prelude::*;

fn named(name: &str, names: &[String], words: &[Word]) -> Specification {
    let sub_goal = |(id, name): (usize, &String)| SubGoal {
        id: Symbol(id as u32),
        name: name.clone(),
        ball: None,
        frames: 0,
        demonstrations: 0,
        color: None,
    };
    Specification {
        name: name.to_owned(),
        semantics: Semantics::default(),
        features: Vec::new(),
        subsets: Vec::new(),
        sub_goals: names.iter().enumerate().map(sub_goal).collect(),
        pdfa: Pdfa::from_words(words),
        demonstrations: Vec::new(),
    }
}

fn round_trip(specification: &Specification) -> Specification {
    let text = export(specification, ExportFormat::Dot);
    read_dot(&text).unwrap_or_else(|error| panic!("{error} in\n{text}"))
}

#[test]
fn hostile_names_survive() {
    let names = [
        "constructor",
        "__proto__",
        "a \"quoted\" name",
        "back\\slash\\",
        "\\n is no line break",
        "🤖 👩‍🔬",
        "שלום עולם",
        "\u{202e}right to left",
        "<b>bold</b>",
        "&amp; &quot; &#65; &",
        "two\nlines\r\n",
        "label=\"x\" -> __start0",
        "]; }",
        "\u{1}\u{7f}\t",
        "",
        "// no comment /* here */ #",
    ];
    let names: Vec<String> = names.map(str::to_owned).into();
    let word: Word = (0..names.len() as u32).map(Symbol).collect();
    for name in &names {
        let mut all = named(name, &names, std::slice::from_ref(&word));
        all.pdfa.states.get_mut(&StateId(2)).unwrap().name =
            Some(name.clone()).filter(|name| !name.is_empty());
        assert_eq!(round_trip(&all), all);
    }
}

#[test]
fn a_sub_goal_that_is_not_used_and_the_order_of_the_alphabet_survive() {
    let names = ["a", "b", "c"].map(str::to_owned);
    let mut all = named("task", &names, &[vec![Symbol(1)]]);
    all.sub_goals.reverse();
    all.semantics = Semantics::Published;
    assert_eq!(round_trip(&all), all);
}

#[test]
fn a_cycle_and_an_initial_state_in_the_middle_survive() {
    let names = ["a", "b"].map(str::to_owned);
    let mut all = named("task", &names, &[vec![Symbol(0), Symbol(1)]]);
    let end = *all.pdfa.states.keys().next_back().unwrap();
    let back = all.pdfa.states[&StateId(0)].transitions[&Symbol(0)].clone();
    all.pdfa.states.get_mut(&end).unwrap().transitions.insert(Symbol(0), back);
    all.pdfa.initial = StateId(1);
    assert_eq!(round_trip(&all), all);
}

/// What others write: less of it, and in their own way.
const BY_HAND: &str = "\u{feff}/* a graph\n by hand */ strict digraph {\n# a comment\ngraph [name=task]; edge [color=red]\n\
    __start0 -> q0 // here\nq0 -> q1 -> q2 [symbol=g7, label=\"to\" + \"p\\nx\"; probability=1];\n\
    \"q2\" [shape=doublecircle, final_probability=1]}";

#[test]
fn what_is_written_by_hand_is_read() {
    let read = read_dot(BY_HAND).unwrap();
    assert_eq!((read.name.as_str(), read.pdfa.states.len(), read.sub_goals.len()), ("task", 3, 1));
    assert_eq!((read.sub_goals[0].id, read.sub_goals[0].name.as_str()), (Symbol(7), "top"));
    assert!(read.pdfa.states[&StateId(2)].accepting);
    assert_eq!(read.check(), []);
}

#[test]
fn without_weights_probabilities_count_then_counts_then_nothing() {
    let weights = |first: &str, second: &str| {
        let text = format!(
            "digraph {{ __start0 -> q0; q0 -> q1 [symbol=g0 {first}]; q0 -> q2 [symbol=g1 {second}] }}"
        );
        let read = read_dot(&text).unwrap();
        [0, 1].map(|symbol| read.pdfa.transition(StateId(0), Symbol(symbol)).unwrap().weight)
    };
    assert_eq!(weights("weight=3 probability=0.5 count=2", "weight=1 probability=0.5 count=2"), [3.0, 1.0]);
    assert_eq!(weights("probability=0.75 count=2", "probability=0.25 count=1"), [0.75, 0.25]);
    assert_eq!(weights("count=2 weight=9", "count=1"), [2.0, 1.0]);
    assert_eq!(weights("count=2", ""), [1.0, 1.0]);
}

#[test]
fn each_fault_is_said_in_a_sentence_with_its_line() {
    let cases = [
        ("", "the file is empty; expected digraph"),
        ("graph {}", "line 1: \"graph\" is no directed graph; expected digraph"),
        ("digraph", "line 1: the file ends here; expected {"),
        ("digraph {\nq0", "line 2: the file ends here; expected a statement or }"),
        ("digraph {\n\n}", "no state is the initial one; expected an edge from __start0 to it"),
        ("digraph {\n__start0 -> red }", "line 2: \"red\" is no id; expected q and a number, such as q0"),
        ("digraph {\nq0;\nq0 }", "line 3: q0 is described twice; expected each state once"),
        (
            "digraph {\nq0 -> q1 }",
            "line 2: the edge from q0 to q1 has no symbol; expected symbol=\"g0\" or the like",
        ),
        (
            "digraph {\nq0 -> q1 [symbol=g0];\nq0 -> q2 [symbol=g0] }",
            "line 3: a second edge from q0 has the symbol g0; expected at most one",
        ),
        (
            "digraph {\n__start0 -> q0\n__start0 -> q1 }",
            "line 3: q1 is initial, but so is q0; expected one initial state",
        ),
        ("digraph {\nq0 -- q1 }", "line 2: \"--\" joins nodes in both directions; expected ->"),
        ("digraph {\nq0 [label=<b>] }", "line 2: \"<\" starts HTML; expected a text in quotes"),
        ("digraph {\nsubgraph x { } }", "line 2: a subgraph; expected states and transitions only"),
        ("digraph {\nq0 [label=\"x }\n", "line 2: a text in quotes has no end; expected \""),
        ("digraph {\n/* }\n", "line 2: a comment has no end; expected */"),
        ("digraph { } }", "line 1: \"}\" follows the graph; expected the end of the file"),
        ("digraph {\nq0 [accepting=maybe] }", "line 2: accepting is \"maybe\"; expected true or false"),
        (
            "digraph {\nq0 [end_count=-1] }",
            "line 2: end_count is \"-1\"; expected a whole number not below 0",
        ),
        (
            "digraph {\nq0 [end_weight=NaN] }",
            "line 2: end_weight is \"NaN\"; expected a finite number not below 0",
        ),
        (
            "digraph {\nsemantics=other }",
            "line 2: \"other\" is no semantics; expected maximum_likelihood or published",
        ),
        ("digraph {\n! }", "line 2: \"!\" cannot stand here; expected an id"),
    ];
    for (text, expected) in cases {
        let text = match expected {
            // What is said about the graph comes after the initial state is known.
            _ if text.contains("semantics") => text.replace('{', "{ __start0 -> q0"),
            _ => text.to_owned(),
        };
        assert_eq!(read_dot(&text).unwrap_err().to_string(), expected, "{text}");
    }
}

#[test]
fn weights_beyond_what_a_specification_may_hold_are_refused() {
    let error = read_dot("digraph { __start0 -> q0; q0 -> q0 [symbol=g0 weight=1e200] }").unwrap_err();
    assert_eq!(error.line, None);
    assert!(error.to_string().contains("1e100"), "{error}");
}

fn any_specification() -> impl Strategy<Value = Specification> {
    let name = || prop_oneof![2 => "[a-z]{1,4}( [0-9])?", 1 => any::<String>()];
    let word =
        proptest::collection::btree_set(0_u32..4, 0..4).prop_map(|set| set.into_iter().collect::<Vec<_>>());
    let words = proptest::collection::vec(word.prop_shuffle(), 0..8);
    let weights = proptest::collection::vec((any::<u16>(), any::<u16>(), 0.0..1e3_f64, any::<bool>()), 0..5);
    (name(), proptest::collection::vec(name(), 4), words, weights, any::<bool>()).prop_map(
        |(name, names, words, weights, published)| {
            let words: Vec<Word> =
                words.into_iter().map(|word| word.into_iter().map(Symbol).collect()).collect();
            let mut all = named(&name, &names, &words);
            if published {
                all.semantics = Semantics::Published;
            }
            let ids: Vec<StateId> = all.pdfa.states.keys().copied().collect();
            for (at, way, weight, accepting) in weights {
                let state = all.pdfa.states.get_mut(&ids[usize::from(at) % ids.len()]).unwrap();
                state.name = (way % 3 == 0).then(|| name.clone()).filter(|name| !name.is_empty());
                state.accepting |= accepting;
                if state.accepting {
                    state.end_weight = weight;
                }
                let count = state.transitions.len().max(1);
                if let Some(transition) = state.transitions.values_mut().nth(usize::from(way) % count) {
                    transition.weight = weight;
                }
            }
            all
        },
    )
}

/// Pieces of DOT in any order, some broken.
fn any_text() -> impl Strategy<Value = String> {
    let pieces = [
        "digraph",
        "strict",
        " {",
        "}",
        "[",
        "]",
        ";",
        ",",
        "=",
        "->",
        "--",
        "q0",
        "q1",
        "__start0",
        "g0",
        "symbol",
        "label",
        "\"",
        "\\",
        "&",
        "&#x;",
        "&#9999999999;",
        "\n",
        "#",
        "//",
        "/*",
        "*/",
        "+",
        ":",
        "<",
        "-",
        ".5",
        "é",
        "count",
        "weight",
        "1e400",
        "subgraph",
        "node",
        "name",
        "completed",
        "\u{0}",
        " ",
    ];
    let piece = prop_oneof![20 => prop::sample::select(pieces.to_vec()).prop_map(str::to_owned), 1 => any::<String>()];
    proptest::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

proptest! {
    #[test]
    fn what_is_written_is_read_the_same(all in any_specification()) {
        let read = round_trip(&all);
        prop_assert_eq!(&read, &all);
        let (before, after) = (all.pdfa.probabilities(all.semantics), read.pdfa.probabilities(read.semantics));
        prop_assert_eq!(before, after);
    }

    #[test]
    fn any_text_is_read_or_refused(text in any_text()) {
        let inside = format!("digraph {{ __start0 -> q0; {text} }}");
        for text in [&text, &inside] {
            if let Err(error) = read_dot(text) {
                prop_assert!(!error.message.is_empty() && !error.message.contains('\n'), "{}", error);
            }
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let _ = read_dot(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn a_file_with_a_part_missing_is_read_or_refused(all in any_specification(), cuts in any::<(u16, u16)>()) {
        let text = export(&all, ExportFormat::Dot);
        let starts: BTreeSet<usize> = text.char_indices().map(|(at, _)| at).collect();
        let place = |cut: u16| starts.iter().nth(usize::from(cut) % starts.len()).copied().unwrap_or(0);
        let (from, to) = (place(cuts.0).min(place(cuts.1)), place(cuts.0).max(place(cuts.1)));
        let _ = read_dot(&(text[..from].to_owned() + &text[to..]));
        let _ = read_dot(&text[from..to]);
    }
}

#[test]
fn the_star_that_opens_a_comment_does_not_end_it() {
    let text = "digraph {\n /*/ q0 -> q1 [symbol=\"g0\"]; */ __start0 -> q0;\n q0 [shape=doublecircle];\n}";
    let read = read_dot(text).unwrap();
    assert_eq!((read.pdfa.states.len(), read.pdfa.transitions().count()), (1, 0));
}
