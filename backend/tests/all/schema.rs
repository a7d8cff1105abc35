//! `goalgraph schema`, and the schema in the documentation.

use serde_json::Value;

use crate::support::{Bench, TWO_STACKS};

/// `keys` of `schema` at `pointer`.
fn keys(schema: &Value, pointer: &str) -> Vec<String> {
    let object = schema.pointer(pointer).and_then(Value::as_object).unwrap();
    let mut keys: Vec<String> = object.keys().cloned().collect();
    keys.sort();
    keys
}

#[test]
fn the_documented_schema_is_the_one_that_is_printed() {
    let printed = Bench::new().succeed(&["schema"]);
    let documented = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/specification.schema.json");
    let documented = std::fs::read_to_string(documented).unwrap().replace("\r\n", "\n");
    assert!(printed == documented, "run: goalgraph schema > docs/specification.schema.json");
}

#[test]
fn the_schema_names_the_keys_that_are_written() {
    let bench = Bench::new();
    let schema: Value = serde_json::from_str(&bench.succeed(&["schema"])).unwrap();
    bench.write("words.txt", TWO_STACKS);
    bench.succeed(&["infer", "--words", "words.txt", "-o", "s.json"]);
    let written: Value = serde_json::from_str(&bench.read("s.json")).unwrap();
    assert_eq!(keys(&schema, "/properties"), keys(&written, ""));
    // The last column: what is written only where an expert has set it.
    let parts = [
        ("Automaton", "/automaton", None),
        ("State", "/automaton/states/0", Some("name")),
        ("Transition", "/automaton/transitions/0", None),
        ("Demonstration", "/demonstrations/0", None),
    ];
    for (definition, place, optional) in parts {
        let mut named = keys(&schema, &format!("/$defs/{definition}/properties"));
        named.retain(|key| optional != Some(key.as_str()));
        assert_eq!(named, keys(&written, place), "{place}");
    }
}
