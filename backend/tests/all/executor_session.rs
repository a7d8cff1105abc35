//! docs/executor-session.jsonl and the examples of docs/executor-protocol.md: what is written is what is said.

use std::collections::{BTreeSet, VecDeque};
use std::fs;
use std::time::Duration;

use goalgraph::protocol::executor::{FromExecutor, Spoken, ToExecutor, close};
use goalgraph_server::executor::{Begin, Disturbances, Session, Settings};
use serde_json::Value;

use crate::support::Bench;

fn document(name: &str) -> String {
    let path = format!("{}/../docs/{name}", env!("CARGO_MANIFEST_DIR"));
    fs::read_to_string(path).unwrap().replace("\r\n", "\n")
}

pub(crate) fn transcript() -> Vec<Spoken> {
    document("executor-session.jsonl").lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn settings() -> Settings {
    let lost = vec!["red@0".parse().unwrap()];
    let disturbances = Disturbances { lost, ..Disturbances::default() };
    Settings { name: "cell 4".to_owned(), begin: Begin::OnCommand, runs: Some(1), speed: 1.0, disturbances }
}

#[test]
fn the_documented_schema_of_messages_is_the_one_that_is_printed() {
    let printed = Bench::new().succeed(&["schema", "executor"]);
    let documented = document("executor-protocol.schema.json");
    assert!(printed == documented, "run: goalgraph schema executor > docs/executor-protocol.schema.json");
}

#[test]
fn every_line_of_the_transcript_is_what_it_says_and_nothing_more() {
    for line in document("executor-session.jsonl").lines() {
        let spoken: Spoken = serde_json::from_str(line).unwrap();
        let written: Value = serde_json::from_str(line).unwrap();
        assert_eq!(serde_json::to_value(spoken).unwrap(), written);
    }
}

/// Reads an example, writes it again, and gives its type with what happened or why.
fn read_example(line: &str, from_executor: bool) -> String {
    let written: Value = serde_json::from_str(line).unwrap();
    let read = if from_executor {
        serde_json::to_value(serde_json::from_str::<FromExecutor>(line).unwrap())
    } else {
        serde_json::to_value(serde_json::from_str::<ToExecutor>(line).unwrap())
    };
    assert_eq!(read.unwrap(), written, "{line}");
    let happened = written.pointer("/happened/event").unwrap_or(&written["type"]);
    happened.as_str().unwrap().to_owned()
}

#[test]
fn the_document_has_an_example_of_every_message_and_event_and_each_can_be_read() {
    let text = document("executor-protocol.md");
    let (from_executor, rest) = text.split_once("\n## From the server").unwrap();
    let (from_server, _) = rest.split_once("\n## ").unwrap();
    let examples = |part: &str, from_executor| -> BTreeSet<String> {
        let lines = part.lines().filter(|line| line.starts_with('{'));
        lines.map(|line| read_example(line, from_executor)).collect()
    };
    let rows = |part: &str| -> BTreeSet<String> {
        let rows = part.lines().filter_map(|line| line.strip_prefix("| `")?.split_once(" |"));
        let names =
            rows.flat_map(|(names, _)| names.split(", ").map(|name| name.trim_matches('`').to_owned()));
        names.filter(|name| !matches!(name.as_str(), "type" | "event")).collect()
    };
    assert_eq!(examples(from_executor, true), rows(from_executor));
    assert_eq!(examples(from_server, false), rows(from_server));
    let schema: Value = serde_json::from_str(&document("executor-protocol.schema.json")).unwrap();
    for (definition, kind, names) in [
        ("FromExecutor", "type", rows(from_executor)),
        ("RunEvent", "event", rows(from_executor)),
        ("ToExecutor", "type", rows(from_server)),
    ] {
        for variant in schema["$defs"][definition]["oneOf"].as_array().unwrap() {
            let name = variant["properties"][kind]["const"].as_str().unwrap();
            assert!(name == "event" || names.contains(name), "{definition}: {name} is not in the document");
        }
    }
}

#[test]
fn every_reason_and_close_code_is_in_the_document() {
    let text = document("executor-protocol.md");
    let schema: Value = serde_json::from_str(&document("executor-protocol.schema.json")).unwrap();
    for definition in ["Denial", "Refusal"] {
        for variant in schema["$defs"][definition]["oneOf"].as_array().unwrap() {
            let name = variant["const"].as_str().unwrap();
            assert!(text.contains(&format!("\n| `{name}` | ")), "{definition}: {name}");
        }
    }
    for code in [close::REPLACED, close::REVOKED, close::SILENT, close::PROTOCOL] {
        assert!(text.contains(&format!("\n| {code} | ")), "{code}");
    }
}

/// The same message as of another run.
pub(crate) fn in_run(message: &impl serde::Serialize, run: &str) -> Value {
    let mut value = serde_json::to_value(message).unwrap();
    let object = value.as_object_mut().unwrap();
    object.remove("at_ms");
    object.remove("software");
    if object.contains_key("run") {
        object.insert("run".to_owned(), run.into());
    }
    value
}

/// What the robot says next, working as long as that takes.
fn next_message(session: &mut Session, said: &mut VecDeque<FromExecutor>) -> FromExecutor {
    for _ in 0..10 {
        said.extend(
            session.take_messages().into_iter().filter(|message| *message != FromExecutor::Heartbeat),
        );
        if let Some(message) = said.pop_front() {
            return message;
        }
        session.advance(Duration::from_secs(1), 0);
    }
    panic!("the robot says nothing more: {:#?}", session.take_lines());
}

#[test]
fn the_simulated_robot_says_what_the_executor_of_the_transcript_says() {
    let mut session = Session::new(settings());
    let mut said = VecDeque::new();
    let mut run = String::new();
    for spoken in transcript() {
        match spoken {
            Spoken::Server(message) => {
                let message = serde_json::from_value(in_run(&message, &run)).unwrap();
                session.heard(message);
            }
            Spoken::Executor(expected) => {
                if matches!(expected, FromExecutor::Hello { .. }) {
                    said.clear();
                    session.disconnected();
                    session.connected();
                }
                let message = next_message(&mut session, &mut said);
                if let FromExecutor::Begin { run: id, .. } = &message {
                    run.clone_from(id);
                }
                assert_eq!(in_run(&message, &run), in_run(&expected, &run));
            }
        }
    }
    assert!(session.is_done() && session.take_messages().is_empty());
}
