//! `goalgraph executor` at servers that say what they are told to, over real sockets, and its side of the protocol alone.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use goalgraph::protocol::executor::{Denial, FromExecutor, Refusal, SUBPROTOCOL, Spoken, ToExecutor, close};
use goalgraph::run::RunEvent;
use goalgraph_server::executor::{Begin, Disturbances, Session, Settings};
use serde_json::Value;
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tokio_tungstenite::tungstenite::protocol::CloseFrame;
use tokio_tungstenite::{WebSocketStream, accept_hdr_async};

use crate::executor_session::{in_run, transcript};

/// The program as somebody starts it, with a token in its environment.
fn start(address: SocketAddr, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_goalgraph"));
    command.args(["executor", "--url", &format!("ws://{address}")]).args(arguments);
    command
        .env("GOALGRAPH_TOKEN", "goalgraph_a_b")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// How the program ended: status, standard output, standard error.
fn end(child: Child) -> (i32, String, String) {
    let output = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

type Socket = WebSocketStream<TcpStream>;

async fn accept(listener: &tokio::net::TcpListener) -> Socket {
    let (stream, _) = listener.accept().await.unwrap();
    #[allow(clippy::result_large_err, reason = "the callback's type is given")]
    let check = |request: &Request, mut response: Response| -> Result<Response, ErrorResponse> {
        assert_eq!(request.uri().path(), "/api/v1/executor");
        assert_eq!(request.headers()["authorization"], "Bearer goalgraph_a_b");
        assert_eq!(request.headers()["sec-websocket-protocol"], SUBPROTOCOL);
        response.headers_mut().insert("sec-websocket-protocol", SUBPROTOCOL.parse().unwrap());
        Ok(response)
    };
    accept_hdr_async(stream, check).await.unwrap()
}

async fn say(socket: &mut Socket, message: &Value) {
    socket.send(Message::text(message.to_string())).await.unwrap();
}

/// The next message that is no heartbeat.
async fn hear(socket: &mut Socket) -> FromExecutor {
    loop {
        if let Message::Text(text) = socket.next().await.unwrap().unwrap() {
            let message = serde_json::from_str(&text).unwrap();
            if message != FromExecutor::Heartbeat {
                return message;
            }
        }
    }
}

/// Says the server's lines of the transcript and expects the executor's; where another hello follows, it loses the
/// connection.
async fn replay(listener: &tokio::net::TcpListener) {
    let mut socket = accept(listener).await;
    let mut run = String::new();
    for (index, spoken) in transcript().into_iter().enumerate() {
        match spoken {
            Spoken::Server(message) => say(&mut socket, &in_run(&message, &run)).await,
            Spoken::Executor(expected) => {
                if index > 0 && matches!(expected, FromExecutor::Hello { .. }) {
                    drop(socket);
                    socket = accept(listener).await;
                }
                let message = hear(&mut socket).await;
                if let FromExecutor::Begin { run: id, .. } = &message {
                    run.clone_from(id);
                }
                assert_eq!(in_run(&message, &run), in_run(&expected, &run));
            }
        }
    }
}

fn listen() -> (tokio::runtime::Runtime, tokio::net::TcpListener) {
    let runtime = tokio::runtime::Runtime::new().unwrap();
    let listener = runtime.block_on(tokio::net::TcpListener::bind("127.0.0.1:0")).unwrap();
    (runtime, listener)
}

#[test]
fn the_program_does_what_the_transcript_says_and_goes_on_after_a_lost_connection() {
    let (runtime, listener) = listen();
    let address = listener.local_addr().unwrap();
    let child = start(address, &["--name", "cell 4", "--becomes-unavailable", "red@0", "--once"]);
    runtime.block_on(replay(&listener));
    let (status, stdout, stderr) = end(child);
    assert_eq!((status, stderr.as_str()), (0, ""), "{stdout}");
    for line in
        ["accepted \"Blue on top\" r1", "told to start", "   3 red (g0) is unavailable", "   9 finished"]
    {
        assert!(stdout.contains(line), "{line}: {stdout}");
    }
    assert_eq!(stdout.matches("goes on, 2 events are sent again").count(), 1, "{stdout}");
}

#[test]
fn a_server_that_has_enough_of_it_is_left_alone() {
    let (runtime, listener) = listen();
    let address = listener.local_addr().unwrap();
    for (code, sentence) in [
        (
            close::REPLACED,
            "another executor with the same name has connected; give each its own with --name\n",
        ),
        (close::REVOKED, "the token was revoked\n"),
    ] {
        let child = start(address, &[]);
        runtime.block_on(async {
            let mut socket = accept(&listener).await;
            hear(&mut socket).await;
            socket.close(Some(CloseFrame { code: code.into(), reason: "".into() })).await.unwrap();
            while socket.next().await.is_some_and(|message| message.is_ok()) {}
        });
        let (status, _, stderr) = end(child);
        assert_eq!((status, stderr.as_str()), (1, sentence));
    }
}

#[test]
fn why_a_server_refuses_is_said() {
    let check = |answer: &'static str, expected: &str| {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let child = start(address, &["--specification", "two stacks"]);
        let (mut stream, _) = listener.accept().unwrap();
        let mut request = [0; 2048];
        let length = stream.read(&mut request).unwrap();
        let request = String::from_utf8_lossy(&request[..length]).into_owned();
        assert!(
            request.starts_with("GET /api/v1/executor?specification=two%20stacks HTTP/1.1\r\n"),
            "{request}"
        );
        stream.write_all(answer.as_bytes()).unwrap();
        drop(stream);
        let (status, _, stderr) = end(child);
        let url = format!("ws://{address}/api/v1/executor?specification=two%20stacks");
        assert_eq!((status, stderr), (1, format!("{url}: {expected}\n")));
    };
    check(
        "HTTP/1.1 401 Unauthorized\r\ncontent-length: 0\r\n\r\n",
        "the server refuses the token (401); make one with `goalgraph token create` for the role executor",
    );
    check(
        "HTTP/1.1 404 Not Found\r\ncontent-length: 43\r\n\r\n{\"detail\": \"there is no specification two\"}\n",
        "there is no specification two (404)",
    );
}

#[cfg(unix)]
#[test]
fn a_robot_that_is_told_to_stop_stops_and_says_so() {
    let (runtime, listener) = listen();
    let child = start(listener.local_addr().unwrap(), &["--name", "cell 4", "--runs", "1"]);
    let process = child.id().to_string();
    runtime.block_on(async {
        let mut socket = accept(&listener).await;
        let mut offer = transcript().into_iter().filter_map(|spoken| match spoken {
            Spoken::Server(message) => Some(message),
            Spoken::Executor(_) => None,
        });
        for _ in 0..2 {
            say(&mut socket, &in_run(&offer.next().unwrap(), "")).await;
        }
        let run = loop {
            if let FromExecutor::Begin { run, .. } = hear(&mut socket).await {
                break run;
            }
        };
        say(&mut socket, &serde_json::json!({"type": "granted", "run": run, "stored": 0})).await;
        assert!(Command::new("kill").args(["-TERM", &process]).status().unwrap().success());
        loop {
            if let FromExecutor::Event { number, happened: RunEvent::Stopped, .. } = hear(&mut socket).await {
                let message = serde_json::json!({"type": "acknowledged", "run": run, "number": number});
                break say(&mut socket, &message).await;
            }
        }
        while socket.next().await.is_some_and(|message| message.is_ok()) {}
    });
    let (status, stdout, _) = end(child);
    assert_eq!(status, 0);
    assert!(stdout.contains(" stopped, all of it is stored"), "{stdout}");
}

/// A robot that has been welcomed, and the specification that it is then sent.
fn welcomed(begin: Begin) -> (Session, ToExecutor) {
    let disturbances = Disturbances::default();
    let name = "cell 4".to_owned();
    let mut session = Session::new(Settings { name, begin, runs: None, speed: 1.0, disturbances });
    session.connected();
    session.heard(ToExecutor::Welcome { heartbeat_ms: 5000, lease_ms: 15_000, max_message_bytes: 1 << 18 });
    let mut offers = transcript().into_iter().filter_map(|spoken| match spoken {
        Spoken::Server(offer @ ToExecutor::Specification { .. }) => Some(offer),
        _ => None,
    });
    session.take_messages();
    (session, offers.next_back().unwrap())
}

/// The same offer with another text, approval and SHA-256.
fn changed(offer: &ToExecutor, change: impl FnOnce(&mut Value)) -> ToExecutor {
    let mut value = serde_json::to_value(offer).unwrap();
    change(&mut value);
    serde_json::from_value(value).unwrap()
}

fn rejection(session: &mut Session) -> String {
    match &session.take_messages()[..] {
        [FromExecutor::Rejected { reason, .. }] => reason.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_was_tampered_with_or_is_stale_is_rejected_and_never_run() {
    let (mut session, offer) = welcomed(Begin::EverySpecification);
    session.heard(changed(&offer, |it| it["content"] = "{}".into()));
    let reason = rejection(&mut session);
    assert!(reason.starts_with("the content has the SHA-256 44136fa355b3.., not "), "{reason}");

    session.heard(changed(&offer, |it| {
        it["content"] = "{}".into();
        it["sha256"] = "44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a".into();
    }));
    assert!(!rejection(&mut session).is_empty());

    session.heard(changed(&offer, |it| it["approval"] = 5.into()));
    assert!(matches!(
        session.take_messages()[..],
        [FromExecutor::Accepted { .. }, FromExecutor::Begin { .. }]
    ));
    session.heard(offer);
    assert_eq!(rejection(&mut session), "approval 1 is older than approval 5, which was accepted");
}

/// Begins a run and has it granted; gives its id.
fn granted(session: &mut Session, offer: ToExecutor) -> String {
    session.heard(offer);
    let [FromExecutor::Accepted { .. }, FromExecutor::Begin { run, .. }] = &session.take_messages()[..]
    else {
        panic!("no run begins")
    };
    session.heard(ToExecutor::Granted { run: run.clone(), stored: 0 });
    run.clone()
}

fn numbers(messages: &[FromExecutor]) -> Vec<u64> {
    let number = |message: &FromExecutor| match message {
        FromExecutor::Event { number, .. } => Some(*number),
        _ => None,
    };
    messages.iter().filter_map(number).collect()
}

#[test]
fn without_the_lease_the_robot_stands_still_and_with_it_goes_on() {
    let (mut session, offer) = welcomed(Begin::Times(1));
    let run = granted(&mut session, offer);
    assert_eq!(numbers(&session.take_messages()), [1, 2]);
    session.disconnected();
    for _ in 0..160 {
        session.advance(Duration::from_millis(100), 0);
    }
    let lines = session.take_lines().join("\n");
    // The run took two seconds of the fifteen.
    assert!(lines.contains("finished") && lines.contains("the lease has run out"), "{lines}");
    session.connected();
    session.heard(ToExecutor::Welcome { heartbeat_ms: 5000, lease_ms: 15_000, max_message_bytes: 1 << 18 });
    assert!(
        matches!(&session.take_messages()[..], [_, FromExecutor::Begin { run: again, .. }] if *again == run)
    );
    session.heard(ToExecutor::Granted { run, stored: 2 });
    assert_eq!(numbers(&session.take_messages()), [3, 4, 5, 6]);
}

#[test]
fn a_lease_that_is_lost_while_the_robot_works_stops_it_in_its_tracks() {
    let (mut session, offer) = welcomed(Begin::Times(1));
    granted(&mut session, offer);
    session.take_lines();
    session.disconnected();
    session.advance(Duration::from_secs(16), 0);
    session.advance(Duration::from_secs(16), 0);
    assert_eq!(session.take_lines().len(), 1);
    assert!(session.is_deaf());
}

#[test]
fn what_the_server_refuses_is_sent_again_or_let_go() {
    let (mut session, offer) = welcomed(Begin::Times(1));
    let run = granted(&mut session, offer);
    session.take_messages();
    let refused = |reason, expected| ToExecutor::Refused {
        reason,
        message: "no".to_owned(),
        run: Some(run.clone()),
        expected,
    };
    session.heard(refused(Refusal::Gap, Some(2)));
    assert_eq!(numbers(&session.take_messages()), [2]);
    session.heard(refused(Refusal::Unavailable, None));
    assert_eq!(session.take_messages(), []);
    session.heard(ToExecutor::Heartbeat);
    assert_eq!(numbers(&session.take_messages()), [1, 2]);
    session.heard(refused(Refusal::NoLease, None));
    assert!(matches!(session.take_messages()[..], [FromExecutor::Begin { .. }]));
    session.heard(ToExecutor::Denied { run: run.clone(), reason: Denial::Held, message: "held".to_owned() });
    session.advance(Duration::from_secs(1), 0);
    assert_eq!(session.take_messages(), []);
    assert_eq!(session.take_lines().last().unwrap(), &format!("run {run} ends here: held"));
}

#[test]
fn a_server_that_forgot_what_it_acknowledged_ends_the_run() {
    let (mut session, offer) = welcomed(Begin::Times(1));
    let run = granted(&mut session, offer);
    session.heard(ToExecutor::Acknowledged { run: run.clone(), number: 2 });
    session.disconnected();
    session.connected();
    session.heard(ToExecutor::Granted { run: run.clone(), stored: 1 });
    let line = format!("run {run} ends here: the server has acknowledged 2 events and kept only 1");
    assert_eq!(session.take_lines().last(), Some(&line));
}
