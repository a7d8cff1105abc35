//! `goalgraph check` and `goalgraph export` on real specifications.

use crate::support::{Bench, TWO_STACKS};

fn two_stacks() -> Bench {
    let bench = Bench::new();
    bench.write("words.txt", TWO_STACKS);
    bench.succeed(&["infer", "--words", "words.txt", "-o", "s.json", "--name", "Two stacks"]);
    bench
}

#[test]
fn a_sound_specification_has_no_problems() {
    let bench = two_stacks();
    assert_eq!(
        bench.succeed(&["check", "s.json"]),
        "Two stacks: 4 sub-goals, 9 states, 12 transitions, 0 problems\n"
    );
}

#[test]
fn an_error_is_listed_and_decides_the_exit_status() {
    let bench = two_stacks();
    let whole = bench.read("s.json");
    // The only accepting state becomes an ordinary one.
    let broken = whole.replace("\"accepting\": true", "\"accepting\": false");
    let broken = broken.replace("\"final_probability\": 1", "\"final_probability\": 0");
    bench.write("broken.json", broken);
    let ended = bench.run(&["check", "broken.json"]);
    assert_eq!(ended.status, 1, "{ended:?}");
    assert!(
        ended.stdout.contains("error: q0: q0 is a dead end: no accepting state can be reached from it\n")
    );
    assert_eq!(ended.stderr, "broken.json: 10 errors found\n");
    let json: serde_json::Value =
        serde_json::from_str(&bench.run(&["check", "broken.json", "--json"]).stdout).unwrap();
    assert_eq!(json["problems"][0]["severity"], "error");
    assert_eq!(json["problems"][0]["place"], "q0");
}

#[test]
fn words_are_accepted_or_their_first_deviation_is_said() {
    let bench = two_stacks();
    let words = "red-1 green-1 yellow-1 blue-1\nred-1 blue-1\nred-1\nyellow-1 black-1\n";
    bench.write("others.txt", words);
    let text = bench.succeed(&["check", "s.json", "--words", "others.txt"]);
    let expected = [
        "Two stacks: 4 sub-goals, 9 states, 12 transitions, 0 problems",
        "word 1: accepted, log-likelihood -0.9808 [red-1, green-1, yellow-1, blue-1]",
        "word 2: not accepted: position 2: blue-1 does not follow in q1 [red-1, blue-1]",
        "word 3: not accepted: position 2: it ends in q1, where the task does not [red-1]",
        "word 4: not accepted: position 2: black-1 is no sub-goal [yellow-1, black-1]",
        "1 of 4 accepted (25.0 %), log-likelihood -0.9808",
    ];
    assert_eq!(text.lines().collect::<Vec<_>>(), expected);
    let json = bench.succeed(&["check", "s.json", "--words", "others.txt", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["demonstrations"][1]["deviation"]["position"], 2);
    assert_eq!(json["share"], 0.25);
}

#[test]
fn recordings_are_read_with_the_sub_goals_of_the_specification() {
    let bench = Bench::new();
    let rest = |x: f64| format!("{x},0.1\n").repeat(40);
    let carry: Vec<String> = (1..20).map(|step| format!("{},0.1\n", 0.015 * f64::from(step))).collect();
    let carry = carry.concat();
    let whole = format!("red.x,red.y\n{}{carry}{}", rest(0.0), rest(0.3));
    for name in ["a.csv", "b.csv"] {
        bench.write(name, &whole);
    }
    bench.write("still.csv", format!("red.x,red.y\n{}", rest(0.0)));
    bench.succeed(&["infer", "a.csv", "b.csv", "-o", "s.json", "--name", "Carry"]);
    let text = bench.succeed(&["check", "s.json", "a.csv", "still.csv"]);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[1], "a.csv: accepted, log-likelihood 0.0000 [red 1]");
    assert_eq!(
        lines[2],
        "still.csv: not accepted: position 1: it ends in q0, where the task does not [no sub-goal]"
    );
    bench.write("other.csv", "blue.x\n1\n");
    let line = "other.csv: there is no feature \"red.x\", which the specification needs";
    bench.fail(&["check", "s.json", "other.csv"], 1, &[line]);
}

#[test]
fn every_format_is_exported_to_standard_output_or_a_file() {
    let bench = two_stacks();
    let dot = bench.succeed(&["export", "s.json", "--format", "dot"]);
    assert!(dot.starts_with("digraph"), "{dot}");
    assert_eq!(bench.succeed(&["export", "s.json", "--format", "json"]), bench.read("s.json"));
    assert_eq!(bench.succeed(&["export", "s.json", "--format", "svg", "-o", "s.svg"]), "");
    assert!(bench.read("s.svg").contains("<svg"));
    assert_eq!(bench.run(&["export", "s.json", "--format", "pdf"]).status, 2);
    assert_eq!(bench.run(&["export", "s.json"]).status, 2);
}
