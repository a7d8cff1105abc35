//! The program is killed in the middle of saves and events, fifty times: nothing acknowledged is lost, nothing
//! half-written is seen.

use std::net::SocketAddr;
use std::process::Command;
use std::sync::Mutex;
use std::thread;
use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use goalgraph::infer::infer_words;
use goalgraph::pdfa::{Semantics, Symbol};
use goalgraph::protocol::api::{Page, Save, SpecificationEntry, StoredEvent};
use goalgraph::protocol::executor::{FromExecutor, SUBPROTOCOL, ToExecutor};
use goalgraph::run::RunEvent;
use serde_json::json;
use tokio::runtime::Runtime;
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;

use crate::http::try_send;
use crate::program::Program;

const KILLS: u64 = 50;
const RUN: &str = "the one run";

/// What was answered, and so must be there ever after.
#[derive(Default)]
struct Acknowledged {
    revisions: Vec<(u64, String)>,
    events: u64,
}

#[test]
fn what_was_acknowledged_is_there_after_the_program_was_killed() {
    let folder = tempfile::tempdir().unwrap();
    let known = Mutex::new(Acknowledged::default());
    let path = {
        let program = Program::start(folder.path());
        let created = program.send("POST", "/api/v1/specifications", &[], &content(0)).unwrap().expect(201);
        let entry: SpecificationEntry = created.json();
        let path = format!("/api/v1/specifications/{}", entry.id);
        let signature =
            json!({"who": "Ada", "meaning": "ok", "sha256": entry.head.sha256, "instead_of": null});
        let approval = format!("{path}/revisions/1/approval");
        program.send("POST", &approval, &[], &signature.to_string()).unwrap().expect(201);
        known.lock().unwrap().revisions.push((1, entry.head.sha256));
        path
    };
    for kill in 0..KILLS {
        let mut program = Program::start(folder.path());
        check(&program, &path, &known.lock().unwrap());
        thread::scope(|scope| {
            let (address, path, known) = (program.address, path.as_str(), &known);
            scope.spawn(move || save_until_it_dies(address, path, known));
            scope.spawn(move || report_until_it_dies(address, known));
            // Spread over everything that happens in the first moments of saves, events and the two together.
            thread::sleep(Duration::from_micros(20_000 + kill * 7_919 % 97 * 1_000));
            program.kill();
        });
    }
    let program = Program::start(folder.path());
    let known = known.lock().unwrap();
    check(&program, &path, &known);
    assert!(known.revisions.len() > 20, "too few saves to mean anything: {}", known.revisions.len());
    assert!(known.events > 20, "too few events to mean anything: {}", known.events);
    drop(program);
    let verified = Command::new(env!("CARGO_BIN_EXE_goalgraph"))
        .args(["verify", "--data"])
        .arg(folder.path())
        .output()
        .unwrap();
    assert!(verified.status.success(), "{}", String::from_utf8_lossy(&verified.stderr));
}

/// Everything acknowledged is there, whole.
fn check(program: &Program, path: &str, known: &Acknowledged) {
    for (number, sha256) in &known.revisions {
        let answer = program.send("GET", &format!("{path}/revisions/{number}"), &[], "").unwrap().expect(200);
        assert_eq!(answer.json::<serde_json::Value>()["revision"]["sha256"], sha256.as_str());
    }
    if known.events > 0 {
        let last = known.events - 1;
        let events = format!("/api/v1/runs/the%20one%20run/events?after={last}");
        let page: Page<StoredEvent> = program.send("GET", &events, &[], "").unwrap().expect(200).json();
        assert_eq!(page.items[0].number, known.events);
    }
}

fn content(revision: u64) -> String {
    let words = [vec!["a".to_owned(), "b".to_owned()], vec![format!("c{revision}")]];
    let specification = infer_words("Blocks", Semantics::MaximumLikelihood, &words);
    let save = Save {
        content: specification.to_json(),
        author: Some("Ada".to_owned()),
        message: String::new(),
        positions: None,
    };
    json!(save).to_string()
}

/// Saves on top of whatever is the head.
fn save_until_it_dies(address: SocketAddr, path: &str, known: &Mutex<Acknowledged>) {
    let json = ("content-type", "application/json");
    let Some(mut last) = try_send(address, "GET", path, &[], b"") else { return };
    loop {
        let number = last.json::<SpecificationEntry>().head.number;
        let headers = [json, ("if-match", last.header("etag"))];
        let Some(saved) = try_send(address, "PUT", path, &headers, content(number).as_bytes()) else {
            return;
        };
        let head = saved.json::<SpecificationEntry>().head;
        assert_eq!((saved.status, head.number), (200, number + 1));
        known.lock().unwrap().revisions.push((head.number, head.sha256));
        last = saved;
    }
}

/// Goes on with the run where the server says that it stands.
fn report_until_it_dies(address: SocketAddr, known: &Mutex<Acknowledged>) {
    Runtime::new().unwrap().block_on(async {
        let mut request = format!("ws://{address}/api/v1/executor").into_client_request().unwrap();
        request.headers_mut().insert("sec-websocket-protocol", SUBPROTOCOL.parse().unwrap());
        let Ok((mut socket, _)) = connect_async(request).await else { return };
        let say = |message: &FromExecutor| Message::text(serde_json::to_string(message).unwrap());
        let hello = FromExecutor::Hello { executor: "arm".to_owned(), software: None };
        if socket.send(say(&hello)).await.is_err() {
            return;
        }
        while let Some(Ok(message)) = socket.next().await {
            let Message::Text(text) = message else { continue };
            let answers = match serde_json::from_str(&text).unwrap() {
                ToExecutor::Specification { sha256, .. } => {
                    let run = RUN.to_owned();
                    vec![
                        FromExecutor::Accepted { sha256: sha256.clone() },
                        FromExecutor::Begin { run, sha256 },
                    ]
                }
                ToExecutor::Granted { stored, .. } => {
                    assert!(stored >= known.lock().unwrap().events, "an acknowledged event is gone");
                    vec![event(stored + 1)]
                }
                ToExecutor::Acknowledged { number, .. } => {
                    known.lock().unwrap().events = number;
                    vec![event(number + 1)]
                }
                ToExecutor::Welcome { .. } | ToExecutor::Heartbeat => Vec::new(),
                other => panic!("{other:?}"),
            };
            for answer in answers {
                if socket.send(say(&answer)).await.is_err() {
                    return;
                }
            }
        }
    });
}

fn event(number: u64) -> FromExecutor {
    let sub_goal = Symbol(0);
    let happened = if number.is_multiple_of(2) {
        RunEvent::Available { sub_goal }
    } else {
        RunEvent::Unavailable { sub_goal, reason: None }
    };
    FromExecutor::Event { run: RUN.to_owned(), number, at_ms: None, happened }
}
