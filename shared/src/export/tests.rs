use super::*;
use crate::pdfa::{Pdfa, Semantics, Symbol};
use crate::specification::SubGoal;

fn specification(name: &str, names: &[&str], words: &[&[u32]]) -> Specification {
    let sub_goal = |(at, name): (usize, &&str)| SubGoal {
        id: Symbol(at as u32),
        name: (*name).to_owned(),
        ball: None,
        frames: 0,
        demonstrations: 0,
        color: None,
    };
    let words: Vec<Vec<Symbol>> =
        words.iter().map(|word| word.iter().copied().map(Symbol).collect()).collect();
    Specification {
        name: name.to_owned(),
        semantics: Semantics::default(),
        features: Vec::new(),
        subsets: Vec::new(),
        sub_goals: names.iter().enumerate().map(sub_goal).collect(),
        pdfa: Pdfa::from_words(&words),
        demonstrations: Vec::new(),
    }
}

fn two_blocks() -> Specification {
    specification("Two blocks", &["red", "blue"], &[&[0, 1], &[0, 1], &[1], &[1, 0]])
}

#[test]
fn dot_has_a_line_for_every_state_and_transition() {
    let expected = r#"digraph "Two blocks" {
  rankdir=LR;
  node [shape=circle];
  name="Two blocks";
  semantics="maximum_likelihood";
  g0="red";
  g1="blue";
  __start0 [label="" shape="none"];
  __start0 -> q0 [label=""];
  q0 [label="q0" shape="circle" completed="" accepting="false" end_count="0" end_weight="0" final_probability="0"];
  q1 [label="q1\nred" shape="circle" completed="g0" accepting="false" end_count="0" end_weight="0" final_probability="0"];
  q2 [label="q2\nred, blue" shape="doublecircle" completed="g0 g1" accepting="true" end_count="3" end_weight="3" final_probability="1"];
  q3 [label="q3\nblue" shape="doublecircle" completed="g1" accepting="true" end_count="1" end_weight="1" final_probability="0.5"];
  q0 -> q1 [mdp_label="g0:0.5" label="red\n0.50 (2)" symbol="g0" probability="0.5" count="2" weight="2"];
  q0 -> q3 [mdp_label="g1:0.5" label="blue\n0.50 (2)" symbol="g1" probability="0.5" count="2" weight="2"];
  q1 -> q2 [mdp_label="g1:1" label="blue\n1 (2)" symbol="g1" probability="1" count="2" weight="2"];
  q3 -> q2 [mdp_label="g0:0.5" label="red\n0.50 (1)" symbol="g0" probability="0.5" count="1" weight="1"];
}
"#;
    assert_eq!(dot(&two_blocks()), expected);
}

#[test]
fn dot_writes_probabilities_exactly() {
    let text = dot(&specification("Thirds", &["a", "b"], &[&[0], &[0], &[1]]));
    assert!(text.contains(&format!("probability=\"{}\"", 2.0 / 3.0)), "{text}");
}

#[test]
fn dot_keeps_strange_names_within_their_quotes() {
    let name = "a\"b\\ -> __start0 <i>&amp; \n é漢\u{7}\\";
    let text = dot(&specification("label -> \"x\"", &[name], &[&[0]]));
    let label = r#"label="a&quot;b\\ -&gt; __start&#48; &lt;i&gt;&amp;amp; \n é漢 \\\n1 (1)""#;
    assert!(text.contains(label), "{text}");
    assert_eq!(text.lines().filter(|line| line.contains("->")).count(), 2);
    assert!(!text.lines().next().is_some_and(|line| line.contains("label")));
}

#[test]
fn svg_marks_states_and_transitions_and_escapes_names() {
    let text = svg(&specification("a & b", &["<x>\u{1}"], &[&[0]]));
    assert!(text.contains("<title>a &amp; b</title>"));
    assert!(text.contains("data-transition=\"q0 g0 q1\"><title>&lt;x&gt; from q0 to q1: 1 · 1/1</title>"));
    assert_eq!(text.matches("data-state=").count(), 2);
    assert_eq!(text.matches("<g").count(), text.matches("</g>").count());
    assert!(!text.contains("NaN") && !text.contains("inf"));
}

#[test]
fn svg_gives_accepting_states_a_second_border() {
    let text = svg(&two_blocks());
    assert_eq!(text.matches("class=\"box\"").count(), 4 + 2);
}

#[test]
fn svg_of_an_automaton_without_words_is_its_start() {
    let text = svg(&specification("Empty", &[], &[]));
    assert!(text.contains(">start</text>"));
}

#[test]
fn every_format_has_names_and_the_same_bytes_each_time() {
    for format in ExportFormat::ALL {
        assert_eq!(ExportFormat::from_name(format.name()), Some(format));
        assert!(!format.description().is_empty() && format.mime_type().contains('/'));
        assert!(!format.file_extension().starts_with('.'));
        assert_eq!(export(&two_blocks(), format), export(&two_blocks(), format));
    }
    assert_eq!(ExportFormat::from_name("pdf"), None);
}

#[test]
fn json_is_the_specification_file() {
    assert_eq!(export(&two_blocks(), ExportFormat::Json), two_blocks().to_json());
}
