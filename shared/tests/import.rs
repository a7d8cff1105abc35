//! What the importers accept, what they refuse and with which words.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, ImportError, import};

fn read(text: &str) -> Result<Vec<Demonstration>, ImportError> {
    import("take", text.as_bytes(), Header::Detect)
}

#[track_caller]
fn one(text: &str) -> Demonstration {
    let mut demonstrations = read(text).unwrap();
    assert_eq!(demonstrations.len(), 1);
    demonstrations.remove(0)
}

/// The demonstration as text: names with units, then one line a frame.
fn shown(demonstration: &Demonstration) -> String {
    let names = demonstration.features().iter().map(|feature| match &feature.unit {
        Some(unit) => format!("{}[{unit}]", feature.name),
        None => feature.name.clone(),
    });
    let mut lines = vec![names.collect::<Vec<_>>().join(" ")];
    for index in 0..demonstration.frames() {
        let values = demonstration.frame(index).iter().map(f64::to_string);
        lines.push(values.collect::<Vec<_>>().join(" "));
    }
    lines.join(" | ")
}

#[track_caller]
fn check(text: &str, expected: &str) {
    assert_eq!(shown(&one(text)), expected, "{text:?}");
}

#[track_caller]
fn check_names(text: &str, expected: &[&str]) {
    let demonstrations = read(text).unwrap();
    assert_eq!(demonstrations.iter().map(Demonstration::name).collect::<Vec<_>>(), expected);
}

#[track_caller]
fn check_error(text: &str, expected: &str) {
    assert_eq!(read(text).unwrap_err().to_string(), expected, "{text:?}");
}

#[test]
fn any_separator_and_line_end_gives_the_same_table() {
    for text in [
        "x,y\n1,2\n3,4\n",
        "x;y\r\n1;2\r\n3;4",
        "x\ty\n1\t2\n3\t4\n",
        "  x   y\n  1   2\n\n 3  4 \n   \n",
        "\u{feff}x,y\n1,2\n3,4\n\n\n",
        "\"x\",\"y\"\n\"1\",2\n3,4\n",
        "# taken on Monday\n\n#second remark\nx,y\n1,2\n3,4\n",
        "sep=;\nx;y\n1;2\n3;4\n",
        "x,y\r1,2\r3,4\r",
        " x , y \n 1 , 2 \n 3 , 4 \n",
    ] {
        check(text, "x y | 1 2 | 3 4");
    }
}

#[test]
fn undefined_values_are_data() {
    check("x,y\n,nan\nNaN,NA\nnull,1\n", "x y | NaN NaN | NaN NaN | NaN 1");
    check("x\n1\n\"\"\n2\n", "x | 1 | NaN | 2");
}

#[test]
fn a_decimal_comma_is_read_between_semicolons() {
    check("x;y\n0,5;-1,25\n", "x y | 0.5 -1.25");
}

#[test]
fn units_are_taken_from_the_names() {
    check("red.x [m],red.y (mm),z\n1,2,3\n", "red.x[m] red.y[mm] z | 1 2 3");
    check("x [m]\n1\n", "x[m] | 1");
}

#[test]
fn a_table_without_names_has_its_columns_numbered() {
    check("1 2\n3 4\n", "f1 f2 | 1 2 | 3 4");
    check("1,nan,\n3,4,5\n", "f1 f2 f3 | 1 NaN NaN | 3 4 5");
    let told = import("take", b"1,2\n3,4\n", Header::Absent).unwrap();
    assert_eq!(shown(&told[0]), "f1 f2 | 1 2 | 3 4");
    let error = import("take", b"x,y\n3,4\n", Header::Absent).unwrap_err();
    assert_eq!(
        error.to_string(),
        "line 1: f1: \"x\" is no number; expected a number, or nothing where undefined"
    );
}

#[test]
fn names_in_a_comment_above_numbers_are_names() {
    check("#timestamp [ns],x [m],y [m]\n1,2,3\n2,4,5\n", "x[m] y[m] | 2 3 | 4 5");
    check("# two words\n1 2\n", "f1 f2 | 1 2");
}

#[test]
fn times_and_counters_are_no_features() {
    check("t,Time_ms,frame_index,step,x,task_index,nsec\n0,0,9,8,7,0,5\n1,0,3,2,6,0,1\n", "x | 7 | 6");
    check(",x\n0,7\n1,8\n", "x | 7 | 8");
    check(",0,1\n0,7,8\n", "0 1 | 7 8");
    check("timestamp,x\n2024-05-01T12:00:00Z,1\n,2\n", "x | 1 | 2");
}

#[test]
fn a_demonstration_column_splits_the_file() {
    check_names("demo,x\n0,1\n0,2\n1,3\n", &["take #0", "take #1"]);
    check_names("x,Episode_Index\n1,Anna\n2,Bert\n", &["take #Anna", "take #Bert"]);
    check_names("trial,x\n7,1\n7,2\n", &["take"]);
    let demonstrations = read("t,demo,x\n0,0,1\n1,0,2\n0,1,3\n").unwrap();
    assert_eq!(shown(&demonstrations[1]), "x | 3");
}

#[test]
fn the_digest_is_that_of_the_files_bytes() {
    let expected = "daff832f802000e645771a60983c76c963f6ee602a6230e45237bd360e91cc1a";
    assert_eq!(one("x\n1\n").sha256(), expected);
    assert_ne!(one("\u{feff}x\n1\n").sha256(), expected);
}

#[test]
fn a_line_of_another_length_is_refused() {
    check_error("x,y\n1,2\n1\n", "line 3: 1 value, but the header names 2 features");
    check_error("x,y\r\n\r\n1,2\r\n\r\n1,2,3\r\n", "line 5: 3 values, but the header names 2 features");
    check_error("# remark\nt,x\n1\n", "line 3: 1 value, but the header names 2 columns");
    check_error("1 2\n3\n", "line 2: 1 value, but the first line has 2");
}

#[test]
fn a_cell_that_is_no_finite_number_is_refused() {
    let expected = "expected a number, or nothing where undefined";
    check_error("x,y\n1,abc\n", &format!("line 2: y: \"abc\" is no number; {expected}"));
    check_error("x,y\n1,2\n1e999,2\n", "line 3: x: \"1e999\" is not finite; expected a finite number");
    check_error("x,y\n1,-inf\n", "line 2: y: \"-inf\" is not finite; expected a finite number");
    check_error("x,y\n1,2\n1,-1e150\n", "line 3: y: \"-1e150\" is beyond 1e100; expected a smaller number");
    let long = "ü".repeat(1000);
    check_error(
        &format!("x\n{long}\n"),
        &format!("line 2: x: \"{}…\" is no number; {expected}", "ü".repeat(40)),
    );
    check_error(
        "x,y\n1,\"2\n3,4\n",
        "line 2: y: \"2\\n3,4\" runs over several lines; a quotation mark may be missing",
    );
}

#[test]
fn a_file_without_frames_is_refused() {
    check_error("", "the file is empty");
    check_error(" \n\n\t", "the file is empty");
    check_error("\u{feff}", "the file is empty");
    check_error("x,y\n", "there are no frames, only the names of the columns");
    check_error("# nothing\n", "there are only comments; expected lines of values");
}

#[test]
fn names_that_do_not_do_are_refused() {
    check_error("x,y,x\n1,2,3\n", "line 1: \"x\" is there twice (columns 1 and 3)");
    check_error("#\nx,,z\n1,2,3\n", "line 2: column 2 has no name");
    let none = "there is no feature: every column is a time, a counter or names the demonstration";
    check_error("t,frame\n1,2\n", &format!("line 1: {none}"));
    let two = "both demo and trial tell demonstrations apart; expected one such column";
    check_error("demo,trial,x\n1,2,3\n", &format!("line 1: {two}"));
}

#[test]
fn lines_of_absurd_length_are_refused() {
    check_error(&"1,".repeat(100_001), "line 1: more than 100000 columns");
    let frame = (0..=100_000).map(|key| format!("\"{key}\":1")).collect::<Vec<_>>().join(",");
    check_error(&format!("[{{{frame}}}]"), "line 1: frame 0: more than 100000 columns");
}

#[test]
fn frames_out_of_order_are_refused() {
    check_error(
        "demo,x\n0,1\n0,1\n\n1,1\n0,1\n",
        "line 6: demo \"0\" is back after it ended at line 3; frames of one demonstration must follow one another",
    );
    check_error(
        "demo,x\n,1\n",
        "line 2: demo is empty; expected the demonstration that the frame belongs to",
    );
    check_error(
        "t,x\n0,1\n,1\n2,1\n1.5,1\n",
        "line 5: t runs backwards from 2 to 1.5; frames must be in the order of time \
         (several demonstrations in one file need a column demo)",
    );
}

#[test]
fn other_formats_are_called_by_their_names() {
    let check = |bytes: &[u8], expected: &str| {
        let message = import("take.csv", bytes, Header::Detect).unwrap_err().to_string();
        assert_eq!(message, expected);
    };
    check(b"PAR1\x15\x04", "this is a Parquet file; expected CSV or JSON");
    check(b"\x89HDF\r\n\x1a\n\0", "this is an HDF5 file; expected CSV or JSON");
    check(b"\x89MCAP0\r\n", "this is an MCAP file; expected CSV or JSON");
    check(b"PK\x03\x04..", "this is a ZIP archive (as .xlsx and .npz are); expected CSV or JSON");
    check(b"\x89PNG\r\n", "this is a PNG image; expected CSV or JSON");
    check(b"%PDF-1.7", "this is a PDF document; expected CSV or JSON");
    check(b"\x1f\x8b\x08", "this is a gzip file; expected CSV or JSON");
    check(b"\xff\xfex\0", "this is UTF-16 text; expected CSV or JSON");
    check(b"x,y\n\0\x01", "this is a binary file; expected CSV or JSON");
    check(b"x\nL\xe4nge\n", "line 2: this is no UTF-8 text; expected CSV or JSON in UTF-8");
    check(b"\n<!DOCTYPE html><html>", "this is an HTML page; expected CSV or JSON");
    check(b"<?xml version='1.0'?>", "this is an XML file; expected CSV or JSON");
}
