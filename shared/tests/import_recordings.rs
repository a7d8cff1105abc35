//! Real recordings are read completely.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::path::Path;

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import, import_words};

fn bytes(path: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(path)).unwrap()
}

#[test]
fn joint_positions_without_names_open() {
    for (file, frames) in
        [("task1_human1_trial1", 925), ("task1_human1_trial2", 1045), ("task1_human2_trial1", 1544)]
    {
        let bytes = bytes(&format!("lego-assembly/{file}.txt"));
        for header in [Header::Detect, Header::Absent] {
            let demonstrations = import(file, &bytes, header).unwrap();
            assert_eq!(demonstrations.len(), 1);
            assert_eq!(demonstrations[0].name(), file);
            assert_eq!((demonstrations[0].frames(), demonstrations[0].features().len()), (frames, 18));
            assert_eq!(demonstrations[0].features()[17].name, "f18");
        }
    }
}

#[test]
fn one_table_holds_twelve_stacking_demonstrations() {
    let bytes = bytes("panda-stack-and-one/demonstrations.csv");
    let demonstrations = import("demonstrations.csv", &bytes, Header::Detect).unwrap();
    assert_eq!(demonstrations.len(), 12);
    assert_eq!(demonstrations.iter().map(Demonstration::frames).sum::<usize>(), 5431);
    assert_eq!(demonstrations[0].frames(), 462);
    assert_eq!(demonstrations[11].name(), "demonstrations.csv #11");
    let names: Vec<_> = demonstrations[0].features().iter().map(|feature| feature.name.as_str()).collect();
    assert_eq!(
        names,
        ["red_x", "red_y", "red_z", "green_x", "green_y", "green_z", "blue_x", "blue_y", "blue_z"]
    );
    assert_eq!(demonstrations[0].frame(0)[..3], [-0.09275, -0.16928, 0.02499]);
}

#[test]
fn words_of_assemblies_and_towers_are_read() {
    for (file, words) in [
        ("assembly-words/words.txt", 19),
        ("panda-stack-and-one/words.txt", 12),
        ("tower-words/blocks_004_top.txt", 10),
        ("tower-words/blocks_005_top.txt", 35),
        ("tower-words/blocks_006_top.txt", 7),
        ("tower-words/blocks_008_top.txt", 14),
    ] {
        let read = import_words(&bytes(file)).unwrap();
        assert_eq!((read.words.len(), read.rejected), (words, 0), "{file}");
    }
    let towers = import_words(&bytes("tower-words/blocks_004_top.txt")).unwrap();
    assert!(towers.named(&towers.words[0][..2]).eq(["b2x2@10,0", "b4x2@9,2"]));
}
