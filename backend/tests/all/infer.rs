//! `goalgraph infer` on real files.

use std::fmt::Write;

use crate::support::{Bench, TWO_STACKS};

/// A block that rests at 0, is carried to `places` in turn and rests at each; 0.1 mm of wobble.
fn recording(places: &[f64]) -> String {
    let mut table = String::from("red.x,red.y\n");
    let mut frame = 0_u32;
    let mut rest = |table: &mut String, x: f64| {
        for _ in 0..40 {
            frame += 1;
            let wobble = 0.0001 * (f64::from(frame) * 1.7).sin();
            writeln!(table, "{:.5},{:.5}", x + wobble, 0.1 - wobble).unwrap();
        }
    };
    let mut from = 0.0;
    rest(&mut table, from);
    for &to in places {
        for step in 1..20 {
            writeln!(table, "{:.5},0.1", from + (to - from) * f64::from(step) / 20.0).unwrap();
        }
        rest(&mut table, to);
        from = to;
    }
    table
}

#[test]
fn words_become_the_automaton_that_they_are_known_to_give() {
    let bench = Bench::new();
    let words = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/tests/data/assembly-words/words.txt");
    let summary = bench.succeed(&["infer", "--words", words, "-o", "s.json", "--json"]);
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let number = |key: &str| summary[key].as_u64().unwrap();
    assert_eq!([number("demonstrations"), number("distinct_words")], [19, 11]);
    assert_eq!([number("states"), number("transitions"), number("accepting")], [27, 37, 1]);
    bench.succeed(&["check", "s.json", "--words", words]);
}

#[test]
fn recordings_become_a_specification_and_a_summary() {
    let bench = Bench::new();
    for name in ["b.csv", "a.csv", "c.csv"] {
        bench.write(&format!("takes/{name}"), recording(&[0.3]));
    }
    bench.write("takes/README.txt", "These are takes.");
    bench.write("takes/old.goalgraph.json", "{}");
    let ended = bench.run(&["infer", "takes", "-o", "s.json", "--name", "Carry"]);
    assert_eq!((ended.status, ended.stdout.as_str()), (0, ""), "{ended:?}");
    let first = ended.stderr.lines().next().unwrap();
    assert_eq!(first, "3 demonstrations, 1 sub-goal, 1 distinct word, 2 states, 1 transition, 1 accepting");
    let specification: serde_json::Value = serde_json::from_str(&bench.read("s.json")).unwrap();
    assert_eq!(specification["name"], "Carry");
    let names: Vec<&str> = specification["demonstrations"]
        .as_array()
        .unwrap()
        .iter()
        .map(|demonstration| demonstration["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["a.csv", "b.csv", "c.csv"]);
    assert_eq!(bench.files(), ["s.json", "takes"]);
}

#[test]
fn neither_folders_nor_the_order_of_arguments_change_the_bytes() {
    let bench = Bench::new();
    bench.write("x/2.csv", recording(&[0.3]));
    bench.write("y/1.csv", recording(&[0.3]));
    let one = bench.succeed(&["infer", "x/2.csv", "y/1.csv", "-o", "-"]);
    let other = bench.succeed(&["infer", "y", "x", "x/2.csv", "-o", "-"]);
    assert!(one.contains("\"name\": \"Untitled task\""));
    assert_eq!(one, other);
}

#[test]
fn parameters_are_taken_for_all_subsets_or_for_one() {
    let bench = Bench::new();
    bench.write("a.csv", recording(&[0.3]));
    let chosen = |arguments: &[&str]| {
        let all = [&["infer", "a.csv", "-o", "s.json", "--json"], arguments].concat();
        let summary: serde_json::Value = serde_json::from_str(&bench.succeed(&all)).unwrap();
        let subset = &summary["subsets"][0];
        (
            subset["name"].as_str().unwrap().to_owned(),
            subset["epsilon"].as_f64(),
            subset["min_points"].as_u64(),
        )
    };
    let expected = ("red".to_owned(), Some(0.01), Some(5));
    assert_eq!(chosen(&["--epsilon", "0.01", "--min-points", "red=5"]), expected);
    assert_eq!(chosen(&["--paper", "--epsilon", "red=0.01", "--min-points", "5"]), expected);
    let subset =
        ["--subset", "height=red.y", "--epsilon", "0.5", "--epsilon", "height=0.01", "--min-points", "5"];
    assert_eq!(chosen(&subset), ("height".to_owned(), expected.1, expected.2));
}

#[test]
fn every_bad_file_is_named_with_its_place_and_nothing_is_written() {
    let bench = Bench::new();
    bench.write("good.csv", recording(&[0.3]));
    bench.write("empty.csv", "");
    bench.write("ragged.csv", "a,b\n1,2\n3\n");
    bench.write("s.json", "as it was");
    let arguments = ["infer", "good.csv", "ragged.csv", "empty.csv", "missing.csv", "-o", "s.json"];
    let ended = bench.run(&arguments);
    assert_eq!((ended.status, ended.stdout.as_str()), (1, ""), "{ended:?}");
    let lines: Vec<&str> = ended.stderr.lines().collect();
    assert_eq!(lines.len(), 3, "{lines:?}");
    assert!(lines[0].starts_with("empty.csv: "), "{lines:?}");
    assert_eq!(lines[1], "missing.csv: there is no such file or folder");
    assert!(lines[2].starts_with("ragged.csv: line 3: "), "{lines:?}");
    assert_eq!(bench.read("s.json"), "as it was");
    assert_eq!(bench.files(), ["empty.csv", "good.csv", "ragged.csv", "s.json"]);
}

#[test]
fn a_file_with_other_features_is_named() {
    let bench = Bench::new();
    bench.write("in/a.csv", "red.x,red.y\n1,2\n");
    bench.write("in/b.csv", "red.x,red.z\n1,2\n");
    let line = "in/b.csv: its features are not those of a.csv: \"red.y\" is missing";
    bench.fail(&["infer", "in", "-o", "s.json"], 1, &[line]);
    assert_eq!(bench.files(), ["in"]);
}

#[test]
fn a_folder_without_demonstrations_is_said() {
    let bench = Bench::new();
    bench.write("in/picture.png", "");
    let line = "in: there is no .csv, .tsv, .txt or .json file in this folder";
    bench.fail(&["infer", "in", "-o", "s.json"], 1, &[line]);
}

#[test]
fn what_cannot_be_written_is_said_before_the_work() {
    let bench = Bench::new();
    bench.write("words.txt", TWO_STACKS);
    bench.write("folder/x", "");
    let to = |output: &str, line: &str| {
        bench.fail(&["infer", "--words", "words.txt", "-o", output], 1, &[line]);
    };
    to("folder", "folder: it is a folder, not a file");
    to("nowhere/s.json", "nowhere/s.json: there is no folder nowhere");
    assert_eq!(bench.files(), ["folder", "words.txt"]);
}

#[test]
fn arguments_that_do_not_go_together_are_wrong_usage() {
    let bench = Bench::new();
    bench.write("a.csv", recording(&[0.3]));
    let paper = "error: --paper needs --epsilon and --min-points as numbers";
    bench.fail(&["infer", "a.csv", "-o", "s.json", "--paper"], 2, &[paper]);
    let auto = ["infer", "a.csv", "-o", "s.json", "--paper", "--epsilon", "auto", "--min-points", "3"];
    bench.fail(&auto, 2, &[paper]);
    let json = "error: --json needs standard output, where -o - writes already";
    bench.fail(&["infer", "a.csv", "-o", "-", "--json"], 2, &[json]);
    for arguments in [
        &["infer", "a.csv"][..],
        &["infer", "-o", "s.json"],
        &["infer", "a.csv", "--words", "w.txt", "-o", "s.json"],
        &["infer", "a.csv", "-o", "s.json", "--epsilon", "-1"],
        &["infer", "a.csv", "-o", "s.json", "--min-points", "0"],
        &["infer", "a.csv", "-o", "s.json", "--subset", "red"],
        &["infer", "a.csv", "-o", "s.json", "--semantics", "other"],
        &["unknown"],
        &[],
    ] {
        assert_eq!(bench.run(arguments).status, 2, "{arguments:?}");
    }
    assert_eq!(bench.files(), ["a.csv"]);
}

#[test]
fn an_unknown_feature_or_subset_is_answered_with_the_known_ones() {
    let bench = Bench::new();
    bench.write("a.csv", recording(&[0.3]));
    let subset = "subset blue: there is no feature \"blue.x\"; there are: red.x, red.y";
    bench.fail(&["infer", "a.csv", "-o", "s.json", "--subset", "blue=blue.x"], 1, &[subset]);
    let epsilon = "--epsilon: there is no subset \"blue\"; there are: red";
    bench.fail(&["infer", "a.csv", "-o", "s.json", "--epsilon", "blue=1"], 1, &[epsilon]);
}
