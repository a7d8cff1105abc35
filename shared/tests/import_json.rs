//! Demonstrations as JSON: the forms, and what is refused.

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import};

/// Names with units, then one group a frame, as in `x y[m] | 1 2`; demonstrations on lines with their names.
fn shown(text: &str) -> String {
    let demonstrations = match import("take.json", text.as_bytes(), Header::Detect) {
        Ok(demonstrations) => demonstrations,
        Err(error) => return error.to_string(),
    };
    demonstrations.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn line(demonstration: &Demonstration) -> String {
    let join = |cells: Vec<String>| cells.join(" ");
    let name = |name: &str, unit: &Option<String>| match unit {
        Some(unit) => format!("{name}[{unit}]"),
        None => name.to_owned(),
    };
    let names = demonstration.features().iter().map(|feature| name(&feature.name, &feature.unit)).collect();
    let mut groups = vec![join(names)];
    for index in 0..demonstration.frames() {
        groups.push(join(demonstration.frame(index).iter().map(f64::to_string).collect()));
    }
    format!("{}: {}", demonstration.name(), groups.join(" | "))
}

#[track_caller]
fn check(text: &str, expected: &str) {
    assert_eq!(shown(text), expected, "{text}");
}

#[test]
fn every_form_gives_the_same_demonstration() {
    for text in [
        r#"{"features": ["x", "y"], "frames": [[1, null], [-0.5, 2e1]]}"#,
        r#"{"frames": [[1, null], [-0.5, 2e1]], "robot": {"name": "r"}, "features": [{"name": "x"}, "y"]}"#,
        r#"{"features": ["x", "y"], "frames": [{"y": null, "x": 1}, {"x": -0.5, "y": 20}]}"#,
        r#"[{"x": 1}, {"y": 20, "x": -0.5}]"#,
        r#"{"frames": [{"x": 1, "y": "NaN"}, {"y": 20, "x": -0.5}]}"#,
        r#"{"x": [1, -0.5], "y": [null, 20]}"#,
        r#"{"demonstrations": [{"frames": [{"x": 1, "y": null}, {"x": -0.5, "y": 20}]}]}"#,
        "\u{feff}\n[{\"t\": 0, \"x\": 1, \"y\": null}, {\"t\": 1, \"x\": -0.5, \"y\": 20}]\n",
    ] {
        check(text, "take.json: x y | 1 NaN | -0.5 20");
    }
}

#[test]
fn several_demonstrations_are_named_or_numbered() {
    check(
        r#"{"features": ["x"], "demonstrations": [{"name": "Anna", "frames": [[1]]}, {"frames": [[2]]}]}"#,
        "take.json #Anna: x | 1\ntake.json #1: x | 2",
    );
    check(r#"{"name": "Anna", "x": [1]}"#, "take.json #Anna: x | 1");
    check(r#"{"demo": [0, 0, 1], "x": [1, 2, 3]}"#, "take.json #0: x | 1 | 2\ntake.json #1: x | 3");
    check(
        r#"[{"episode": "a", "x": 1}, {"episode": "b", "x": 2}]"#,
        "take.json #a: x | 1\ntake.json #b: x | 2",
    );
}

#[test]
fn units_stand_beside_the_names_or_in_them() {
    check(
        r#"{"features": [{"name": "x", "unit": "m"}, "y [mm]"], "frames": [[1, 2]]}"#,
        "take.json: x[m] y[mm] | 1 2",
    );
    check(r#"[{"x [m]": 1}, {"x [m]": 2}]"#, "take.json: x[m] | 1 | 2");
}

#[test]
fn values_that_are_no_finite_numbers_are_refused() {
    let text = "expected a number, or null where undefined";
    check("[{\"x\": 1},\n{\"x\": \"abc\"}]", &format!("line 2: frame 1: x: \"abc\" is a text; {text}"));
    check(
        r#"{"features": ["x", "y"], "frames": [[1, true]]}"#,
        &format!("line 1: frame 0: y: invalid type: boolean `true`, {text}"),
    );
    check(r#"{"x": [1, [2]]}"#, &format!("line 1: x: frame 1: invalid type: sequence, {text}"));
    check(r#"[{"x": 1e999}]"#, "line 1: frame 0: x: this number is out of range; expected a finite number");
    let nan = "NaN and Infinity are no JSON; expected null where a value is undefined";
    check(r#"[{"x": NaN}]"#, &format!("line 1: frame 0: {nan}"));
    check("{\"x\":\n[1, -Infinity]}", &format!("line 2: {nan}"));
}

#[test]
fn frames_that_do_not_fit_the_features_are_refused() {
    let check_frames = |frames: &str, expected: &str| {
        check(&format!("{{\"features\": [\"x\", \"y\"], \"frames\": {frames}}}"), expected);
    };
    check_frames("[[1, 2], [1]]", "line 1: frame 1: 1 value, but there are 2 features");
    check_frames("[[1, 2, 3, 4]]", "line 1: frame 0: 4 values, but there are 2 features");
    check_frames("[{\"z\": 1}]", "line 1: frame 0: \"z\" is not among the features");
    check_frames("[]", "line 1: there are no frames");
    check_frames(
        "[3]",
        "line 1: frame 0: invalid type: integer `3`, expected a list of values, or an object with a value per feature",
    );
    check("[[1, 2]]", "the frames are lists of values; expected \"features\" that name them");
    check("{\"x\": [1, 2], \"y\": [1]}", "line 1: y has 1 value, but x has 2");
}

#[test]
fn what_is_there_twice_is_refused() {
    check("[{\"x\": 1, \"x\": 2}]", "line 1: frame 0: \"x\" is there twice");
    check("{\"x\": [1], \"x\": [2]}", "line 1: the key \"x\" is there twice");
    check("{\"features\": [\"x\", \"x\"], \"frames\": [[1, 2]]}", "\"x\" is there twice (columns 1 and 2)");
    check(
        r#"{"demonstrations": [{"name": "a", "frames": [{"x": 1}]}, {"name": "a", "frames": [{"x": 1}]}]}"#,
        "two demonstrations are called \"a\"",
    );
}

#[test]
fn documents_without_demonstrations_are_refused() {
    check("[]", "there are no frames");
    check("{}", "there are no features");
    check("3", "line 1: invalid type: integer `3`, expected an object or a list of frames");
    check("[{\"x\": 1}", "line 1: frame 1: the file ends within a list");
    check(
        "{\"x\": 1}\n{\"x\": 2}",
        "line 2: there is more behind the end; expected one JSON value, not one per line",
    );
    check("{\"features\": [\"x\"]}", "there are features, but no frames");
    check(
        r#"{"format": "goalgraph-specification", "demonstrations": []}"#,
        "line 1: this is a specification of Goalgraph; expected demonstrations",
    );
    check(&"[".repeat(100_000), "line 1: frame 0: the file ends within a list");
}

#[test]
fn frames_out_of_order_are_refused() {
    check(
        r#"{"demo": [0, 1, 0], "x": [1, 2, 3]}"#,
        "line 1: frame 2: demo \"0\" is back after it ended at frame 0; \
         frames of one demonstration must follow one another",
    );
    check(
        r#"[{"t": 1, "x": 1}, {"t": 0, "x": 1}]"#,
        "line 1: frame 1: t runs backwards from 1 to 0; frames must be in the order of time \
         (several demonstrations in one file need a column demo)",
    );
}

#[test]
fn objects_that_share_no_features_do_not_fill_the_memory() {
    let frames: Vec<String> = (0..3000).map(|frame| format!("{{\"x{frame}\":1}}")).collect();
    check(
        &format!("[{}]", frames.join(",")),
        "3000 frames name 3000 features between them, and most are missing in most frames",
    );
}
