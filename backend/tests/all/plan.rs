//! `goalgraph plan` on real specifications.

use crate::support::{Bench, TWO_STACKS};

fn two_stacks() -> Bench {
    let bench = Bench::new();
    bench.write("words.txt", TWO_STACKS);
    bench.succeed(&["infer", "--words", "words.txt", "-o", "s.json"]);
    bench
}

#[test]
fn a_plan_is_one_sub_goal_per_line_and_its_probability() {
    let plan = two_stacks().succeed(&["plan", "s.json"]);
    assert_eq!(plan, "g0  red-1\ng1  green-1\ng2  yellow-1\ng3  blue-1\n0.375\n");
}

#[test]
fn with_a_missing_block_the_rest_is_planned_again() {
    let ended = two_stacks().run(&["plan", "s.json", "--unavailable", "Yellow"]);
    assert_eq!(ended.status, 0, "{ended:?}");
    assert_eq!(ended.stdout, "g0  red-1\ng1  green-1\n0.375\n");
    let sentence = "no plan reaches an accepting state without yellow-1; \
        this order goes as far as possible (2 of 4 sub-goals) and then waits\n";
    assert_eq!(ended.stderr, sentence);
}

#[test]
fn an_order_around_what_is_missing_is_complete() {
    let bench = Bench::new();
    bench.write("words.txt", "left right\nleft right\nmiddle right\n");
    bench.succeed(&["infer", "--words", "words.txt", "-o", "s.json"]);
    let ended = bench.run(&["plan", "s.json", "--unavailable", "left"]);
    assert_eq!(
        (ended.stdout.as_str(), ended.stderr.as_str()),
        ("g2  middle\ng1  right\n0.3333333333333333\n", "")
    );
}

#[test]
fn a_plan_may_start_in_the_middle_and_by_the_most_probable_order() {
    let bench = two_stacks();
    let plan = bench.succeed(&["plan", "s.json", "--from", "q2", "--strategy", "most-probable"]);
    assert_eq!(plan, "g2  yellow-1\ng3  blue-1\n1\n");
}

#[test]
fn machines_get_json() {
    let bench = two_stacks();
    let json = |arguments: &[&str]| -> serde_json::Value {
        serde_json::from_str(&bench.succeed(&[&["plan", "s.json", "--json"], arguments].concat())).unwrap()
    };
    let whole = json(&[]);
    assert_eq!(whole["complete"], true);
    assert_eq!(whole["word"], serde_json::json!(["g0", "g1", "g2", "g3"]));
    assert_eq!(whole["states"].as_array().unwrap().len(), 5);
    let part = json(&["--unavailable", "g2"]);
    assert_eq!(part["complete"], false);
    assert_eq!(part["names"], serde_json::json!(["red-1", "green-1"]));
}

#[test]
fn nothing_that_can_be_done_is_a_failure() {
    let line = "no plan: no accepting state can be reached from q0 with what is available";
    two_stacks().fail(&["plan", "s.json", "--unavailable", "red,yellow"], 1, &[line]);
}

#[test]
fn an_unknown_sub_goal_or_state_is_said() {
    let bench = two_stacks();
    let line = "--unavailable: there is no sub-goal \"black\"; the sub-goals are g0 (red-1), g1 (green-1), g2 (yellow-1), g3 (blue-1)";
    bench.fail(&["plan", "s.json", "--unavailable", "black"], 1, &[line]);
    bench.fail(&["plan", "s.json", "--from", "q99"], 1, &["there is no state q99"]);
    assert_eq!(bench.run(&["plan", "s.json", "--from", "99"]).status, 2);
}

#[test]
fn what_is_no_specification_is_refused_with_the_place() {
    let bench = two_stacks();
    bench.fail(&["plan", "none.json"], 1, &["none.json: there is no such file or folder"]);
    bench.fail(&["plan", "."], 1, &[".: it is a folder, not a file"]);
    bench.write("binary.json", b"{\n\xff");
    bench.fail(
        &["plan", "binary.json"],
        1,
        &["binary.json: line 2: it is no UTF-8 text; a specification is JSON"],
    );
    bench.write(
        "lie.json",
        bench.read("s.json").replacen("\"probability\": 0.625", "\"probability\": 0.5", 1),
    );
    let lie = "lie.json: transition q0 g0 q1: probability: 0.5 is written, but the weights give 0.625";
    bench.fail(&["plan", "lie.json"], 1, &[lie]);
}
