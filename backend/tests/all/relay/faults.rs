use axum::http::StatusCode;
use futures_util::SinkExt;
use goalgraph::protocol::executor::{FromExecutor, Refusal, SUBPROTOCOL, ToExecutor, close};
use goalgraph::protocol::monitor;
use goalgraph_server::relay::RelayLimits;
use tokio_tungstenite::tungstenite::{Error, Message};

use super::bench::Bench;
use super::client::open;

/// What was answered instead of a connection: the status and the body.
fn answer<T>(result: Result<T, Error>) -> (u16, String) {
    match result {
        Err(Error::Http(response)) => {
            assert_eq!(response.headers()["content-type"], "application/problem+json");
            let body = response.body().clone().unwrap_or_default();
            (response.status().as_u16(), String::from_utf8(body).unwrap())
        }
        Err(other) => panic!("an answer was expected, not {other}"),
        Ok(_) => panic!("an answer was expected, not a connection"),
    }
}

#[tokio::test]
async fn what_is_no_message_is_refused_and_ends_the_connection() {
    let bench = Bench::new().await;
    let texts = [
        "",
        "hello",
        "{}",
        "[1]",
        r#"{"type":"fly"}"#,
        r#"{"type":"hello"}"#,
        r#"{"type":"hello","executor":"b","extra":1}"#,
        r#"{"type":"hello","executor":"b","executor":"c"}"#,
        r#"{"type":"event","run":"r","number":-1,"happened":{"event":"paused"}}"#,
        r#"{"type":"event","run":"r","number":1,"happened":{"event":"started","sub_goal":"x9"}}"#,
        r#"{"type":"event","run":"r","number":1,"happened":{"event":"planned","state":"q0","word":[],"probability":1e999}}"#,
        &"[".repeat(100_000),
    ];
    for text in texts {
        let mut robot = bench.executor("arm").await;
        assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
        robot.say_text(text).await;
        assert_eq!(robot.hear_refusal().await.0, Refusal::Malformed, "{text:.80}");
        assert_eq!(robot.hear_close().await, Some(close::PROTOCOL), "{text:.80}");
    }
}

#[tokio::test]
async fn a_message_longer_than_agreed_is_refused_however_long_it_is() {
    let bench = Bench::new().await;
    let limit = RelayLimits::default().message_bytes;
    let mut robot = bench.executor("arm").await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
    let longest = format!(r#"{{"type":"heartbeat"}}{}"#, " ".repeat(limit - 20));
    assert_eq!(longest.len(), limit);
    robot.say_text(&longest).await;
    assert_eq!(robot.hear().await, ToExecutor::Heartbeat);
    robot.say_text(&format!("{longest} ")).await;
    assert_eq!(robot.hear_refusal().await.0, Refusal::Malformed);
    assert_eq!(robot.hear_close().await, Some(close::PROTOCOL));

    // Far too long: the connection ends; what is said depends on how much the other end had under way.
    let mut robot = bench.executor("arm").await;
    let _ = robot.socket.send(Message::text(" ".repeat(64 * limit))).await;
    robot.hear_close().await;
    let mut robot = bench.executor("arm").await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
}

#[tokio::test]
async fn binary_messages_are_refused() {
    let bench = Bench::new().await;
    let mut robot = bench.executor("arm").await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
    robot.socket.send(Message::binary(br#"{"type":"heartbeat"}"#.to_vec())).await.unwrap();
    assert_eq!(robot.hear_refusal().await.0, Refusal::Malformed);
    assert_eq!(robot.hear_close().await, Some(close::PROTOCOL));
}

#[tokio::test]
async fn the_hello_comes_first_and_once() {
    let bench = Bench::new().await;
    let mut early = bench.connect().await;
    early.say(&FromExecutor::Heartbeat).await;
    assert_eq!(early.hear_refusal().await.0, Refusal::OutOfTurn);
    assert_eq!(early.hear_close().await, Some(close::PROTOCOL));

    let mut twice = bench.executor("arm").await;
    assert_eq!(twice.hear().await, ToExecutor::Withdrawn);
    twice.say(&FromExecutor::Hello { executor: "arm".to_owned(), software: None }).await;
    assert_eq!(twice.hear_refusal().await.0, Refusal::OutOfTurn);
    assert_eq!(twice.hear_close().await, Some(close::PROTOCOL));

    for name in ["", "a\u{7}", &"x".repeat(101)] {
        let mut nameless = bench.connect().await;
        nameless.say(&FromExecutor::Hello { executor: name.to_owned(), software: None }).await;
        assert_eq!(nameless.hear_refusal().await.0, Refusal::Malformed);
        assert_eq!(nameless.hear_close().await, Some(close::PROTOCOL));
    }
    assert!(bench.relay.executors().is_empty());
}

#[tokio::test]
async fn another_version_of_the_protocol_is_answered_before_anything_is_said() {
    let bench = Bench::new().await;
    for offered in [None, Some("goalgraph.executor.v2"), Some(monitor::SUBPROTOCOL)] {
        let (status, body) = answer(open(bench.address, "/executor", offered).await);
        assert_eq!(status, StatusCode::BAD_REQUEST);
        assert!(body.contains(SUBPROTOCOL), "{body}");
    }
    let (status, _) = answer(open(bench.address, "/monitor", Some(SUBPROTOCOL)).await);
    assert_eq!(status, StatusCode::BAD_REQUEST);
    let both = "goalgraph.executor.v2, goalgraph.executor.v1";
    open(bench.address, "/executor", Some(both)).await.unwrap().greet("arm").await;
}

#[tokio::test]
async fn a_specification_that_there_is_not_is_answered() {
    let bench = Bench::new().await;
    let (status, body) = answer(open(bench.address, "/executor?specification=none", Some(SUBPROTOCOL)).await);
    assert_eq!(status, StatusCode::NOT_FOUND);
    assert!(body.contains("there is no specification none"), "{body}");
}

#[tokio::test]
async fn one_connection_too_many_is_answered_and_a_place_is_free_again_when_one_ends() {
    let limits = RelayLimits { executors: 2, monitors: 1, ..RelayLimits::default() };
    let bench = Bench::with(limits).await;
    let (first, mut second) = (bench.executor("one").await, bench.executor("two").await);
    let (status, _) = answer(open(bench.address, "/executor", Some(SUBPROTOCOL)).await);
    assert_eq!(status, StatusCode::SERVICE_UNAVAILABLE);
    let mut page = bench.monitor().await;
    let (status, _) = answer(open(bench.address, "/monitor", Some(monitor::SUBPROTOCOL)).await);
    assert_eq!(status, StatusCode::SERVICE_UNAVAILABLE);
    drop(first);
    page.watch_executor(|it| it.executor == "one" && !it.connected).await;
    second.say(&FromExecutor::Heartbeat).await;
    // The slot is given back a moment after the executor is seen to be gone.
    let mut third = loop {
        if let Ok(client) = open(bench.address, "/executor", Some(SUBPROTOCOL)).await {
            break client;
        }
        tokio::task::yield_now().await;
    };
    third.greet("three").await;
}

#[tokio::test]
async fn a_page_that_speaks_is_closed() {
    let bench = Bench::new().await;
    let mut page = bench.monitor().await;
    page.say_text("hello").await;
    assert_eq!(page.hear_close().await, Some(close::PROTOCOL));
}
