//! No bytes make the importers panic, and what is written is read back bit for bit.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::fmt::Write;

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import, import_words};
use proptest::collection::vec;
use proptest::prelude::*;

const VALID: [&str; 9] = [
    "demo,t,red.x [m],red.y\n0,0,0.1,\n0,1,-2e-3,nan\n1,0,5,6\n",
    "# remark\r\nx;y\r\n0,5;1\r\n\"2\";3\r\n",
    "1.5 2.5  3.5\n\n4 5 6\n",
    r#"{"features": ["x", {"name": "y", "unit": "m"}], "frames": [[0.1, null], [1, 2e0]], "name": "a"}"#,
    r#"{"features": ["demo", "x"], "demonstrations": [{"name": "a", "frames": [["q", 1], {"x": 2, "demo": 1}]}]}"#,
    r#"[{"t": 0, "x": 1, "y": null}, {"y": 2, "z": "NaN"}]"#,
    r#"{"demo": [0, 0, 1], "time": [0, 1, 0], "x": [1, 2, 3], "step": [0, 1, 2]}"#,
    "a b c\nb a c\n\nc\n",
    "3 2\n1 2 0 1\n0 1 1\n1 0\n",
];

/// Every importer is given the bytes; what it accepts keeps the promises of a demonstration.
fn read_all(bytes: &[u8]) {
    for name in ["take.csv", "take.json"] {
        for header in [Header::Detect, Header::Absent] {
            for demonstration in import(name, bytes, header).unwrap_or_default() {
                assert!(demonstration.frames() > 0 && !demonstration.features().is_empty());
                let frames = 0..demonstration.frames();
                assert!(
                    frames.flat_map(|index| demonstration.frame(index)).all(|value| !value.is_infinite())
                );
            }
        }
    }
    if let Ok(words) = import_words(bytes) {
        assert!(!words.words.is_empty());
    }
}

fn mutate(bytes: &mut Vec<u8>, kind: u8, at: usize, with: &[u8]) {
    let at = at % (bytes.len() + 1);
    match kind {
        0 => bytes.truncate(at),
        1 => drop(bytes.splice(at..at, with.iter().copied())),
        2 => drop(bytes.splice(at..(at + with.len()).min(bytes.len()), [])),
        _ => bytes.iter_mut().skip(at).zip(with).for_each(|(byte, with)| *byte ^= with),
    }
}

fn finite_or_undefined() -> impl Strategy<Value = f64> {
    prop_oneof![
        // Values beyond 1e100 are refused, so they are undefined here.
        4 => any::<f64>().prop_map(|value| if value.abs() <= 1e100 { value } else { f64::NAN }),
        2 => (-1000_i32..1000).prop_map(|value| f64::from(value) / 1000.0),
        1 => Just(f64::NAN),
    ]
}

fn table() -> impl Strategy<Value = Vec<Vec<f64>>> {
    (1_usize..5).prop_flat_map(|width| vec(vec(finite_or_undefined(), width), 1..20))
}

/// Each value in shortest form, an undefined one as `undefined`.
fn line(values: &[f64], separator: &str, undefined: &str) -> String {
    let cell = |value: &f64| {
        if value.is_nan() { undefined.to_owned() } else { format!("{value:?}") }
    };
    values.iter().map(cell).collect::<Vec<_>>().join(separator)
}

fn names(width: usize) -> Vec<String> {
    (0..width).map(|index| format!("block.{index}")).collect()
}

fn assert_same(demonstrations: &[Demonstration], frames: &[Vec<f64>]) {
    assert_eq!(demonstrations.len(), 1);
    assert_eq!(demonstrations[0].frames(), frames.len());
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    for (index, frame) in frames.iter().enumerate() {
        assert_eq!(bits(demonstrations[0].frame(index)), bits(frame), "frame {index}");
    }
}

proptest! {
    #[test]
    fn random_bytes_never_panic(bytes in vec(any::<u8>(), 0..200)) {
        read_all(&bytes);
    }

    #[test]
    fn random_text_of_the_formats_never_panics(text in r#"[\[\]{}:,;"\\ \t\r\n#0-9a-fnN.\-+e()]{0,80}"#) {
        read_all(text.as_bytes());
    }

    #[test]
    fn damaged_files_never_panic(
        which in 0..VALID.len(),
        damages in vec((0_u8..4, any::<usize>(), vec(any::<u8>(), 1..4)), 1..4),
    ) {
        let mut bytes = VALID[which].as_bytes().to_vec();
        for (kind, at, with) in damages {
            mutate(&mut bytes, kind, at, &with);
        }
        read_all(&bytes);
    }

    #[test]
    fn spliced_files_never_panic(first in 0..VALID.len(), second in 0..VALID.len(), a: usize, b: usize) {
        let (first, second) = (VALID[first].as_bytes(), VALID[second].as_bytes());
        let mut bytes = first[..a % (first.len() + 1)].to_vec();
        bytes.extend_from_slice(&second[b % (second.len() + 1)..]);
        read_all(&bytes);
    }

    #[test]
    fn a_table_comes_back_bit_for_bit(frames in table(), separator in 0_usize..3) {
        let separator = [",", ";", "\t"][separator];
        let undefined = if frames[0].len() == 1 { "nan" } else { "" };
        let mut text = names(frames[0].len()).join(separator);
        for frame in &frames {
            write!(text, "\n{}", line(frame, separator, undefined)).unwrap();
        }
        assert_same(&import("a.csv", text.as_bytes(), Header::Detect).unwrap(), &frames);
    }

    #[test]
    fn json_comes_back_bit_for_bit(frames in table()) {
        let rows: Vec<_> = frames.iter().map(|frame| format!("[{}]", line(frame, ",", "null"))).collect();
        let text = format!("{{\"features\":{:?},\"frames\":[{}]}}", names(frames[0].len()), rows.join(","));
        assert_same(&import("a.json", text.as_bytes(), Header::Detect).unwrap(), &frames);
        let columns = (0..frames[0].len()).map(|column| {
            let values: Vec<_> = frames.iter().map(|frame| frame[column]).collect();
            format!("\"block.{column}\":[{}]", line(&values, ",", "null"))
        });
        let text = format!("{{{}}}", columns.collect::<Vec<_>>().join(","));
        assert_same(&import("a.json", text.as_bytes(), Header::Detect).unwrap(), &frames);
    }
}
