//! The plain way and the careful way read the same.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use super::*;
use crate::import::recording::Part;

/// Features, and for each demonstration its label and the bits of its values; or the error.
type Read = Result<(Vec<String>, Vec<(Option<String>, Vec<u64>)>), ImportError>;

fn shown(read: Result<Recordings, ImportError>) -> Read {
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect();
    let part = |part: &Part| (part.label.clone(), bits(&part.values));
    read.map(|read| {
        let names = read.features.iter().map(|feature| feature.name.clone()).collect();
        (names, read.parts.iter().map(part).collect())
    })
}

#[track_caller]
fn check(text: &str) {
    let table = Layout::detect(text);
    if let Some(plain) = first::plain_first(&table) {
        let careful = first::careful_first(&table).unwrap().unwrap();
        let starts = (table.line_at(plain.end), table.line_at(careful.end));
        assert_eq!(
            (&plain.record, plain.place, starts.0),
            (&careful.record, careful.place, starts.1),
            "{text:?}"
        );
    }
    for header in [Header::Detect, Header::Absent] {
        let careful = shown(read_with(|_, start| Ok(start), text, header));
        let plain = read_with(|frames, start| plain::read(frames, start..text.len()), text, header);
        assert_eq!(shown(plain), careful, "{text:?}");
        for (bytes, at_once) in [(0, 2), (10, 3), (30, 1000)] {
            let split = pieces::Split { bytes, at_once };
            let pieces = read_with(|frames, start| pieces::read_split(frames, start, split), text, header);
            assert_eq!(shown(pieces), careful, "{text:?}, {split:?}");
        }
    }
}

/// How many bytes of a table are read the plain way.
fn plain_bytes(text: &str) -> usize {
    let mut end = 0;
    let count = |frames: &mut Frames<'_>, start: usize| {
        end = plain::read(frames, start..text.len())?;
        Ok(end)
    };
    assert!(read_with(count, text, Header::Detect).is_ok(), "{text:?}");
    end
}

/// What is found in cells beside numbers as they are usually written.
const ODD: [&str; 30] = [
    "",
    "",
    "nan",
    "N/A",
    "\"2\"",
    "\"a,b\"",
    "\"1\n2\"",
    " 3",
    "4 ",
    " \"5\"",
    "6\"",
    "abc",
    "inf",
    "-inf",
    "1e999",
    "+7",
    ".5",
    "8.",
    "-",
    ".",
    "1e",
    "1e5",
    "-0",
    "0,5",
    "1,2,3",
    "\t",
    " ",
    "ä",
    "\u{feff}1",
    "2024-05-01T12:00",
];

/// What is found in cells.
fn cell() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => any::<f64>().prop_filter("finite", |value| value.is_finite()).prop_map(|value| format!("{value:?}")),
        6 => (-1000_i32..1000).prop_map(|value| format!("{:.3}", f64::from(value) / 1000.0)),
        3 => select(&ODD[..]).prop_map(str::to_owned),
    ]
}

fn name() -> impl Strategy<Value = &'static str> {
    select(&["x", "y", "z", "\"w\"", "u [m]", "demo", "t", "time", "step", "1"][..])
}

fn table() -> impl Strategy<Value = String> {
    let separator = || select(&[",", ";", "\t", " ", ", ", "  "][..]);
    let end = || select(&["\n", "\n", "\r\n", "\r", "\n\n", " \n", "\n  \n"][..]);
    (1_usize..5).prop_flat_map(move |width| {
        // Labels and times come in runs and in order, so that some tables are right.
        let line = (0_u32..12, vec(cell(), width - 1), end());
        (vec(name(), width), vec(line, 0..8), separator(), end(), any::<bool>()).prop_map(
            |(names, mut lines, separator, end, is_sorted)| {
                if is_sorted {
                    lines.sort_by_key(|line| line.0);
                }
                let mut text = names.join(separator) + end;
                for (number, mut cells, end) in lines {
                    cells.insert(0, (number / 3).to_string());
                    text += &(cells.join(separator) + end);
                }
                text
            },
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_table_is_read_the_same_both_ways(text in table()) {
        check(&text);
    }

    #[test]
    fn any_text_is_read_the_same_both_ways(text in "([0-9.,; \t\r\n\"#a+-]|1,|2,|\n3,){0,60}") {
        check(&text);
        check(&format!("x,y\n{text}"));
    }
}

#[test]
fn usual_tables_are_read_the_plain_way_to_their_end() {
    for text in [
        "x,y\n1,2\n,nan\n3.5,-4e-3",
        "demo,x\nAnna,1\r\nAnna,2\r\nBert, 3\r\n",
        "\"demo\",\"x\"\n1,2\n",
        "timestamp;x;step\n2024-05-01;0,5;a\n;1.5;b\n",
        "1 2\n 3   4 \n\n5 6\n",
        "x\n1\n\n2\n",
    ] {
        assert_eq!(plain_bytes(text), text.len(), "{text:?}");
    }
}

#[test]
fn what_is_not_plain_is_left_to_the_careful_way_from_its_line_on() {
    assert_eq!(plain_bytes("x,y\n1,2\n3,\"4\"\n5,6\n"), 8);
    assert_eq!(plain_bytes("x\n1\n  \n2\n"), 4);
}

#[test]
fn a_second_byte_order_mark_is_no_part_of_the_first_number() {
    check("\u{feff}1,2\n3,4\n");
    check("# remark\n\u{feff}1,2\n3,4\n");
}
