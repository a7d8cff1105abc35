use std::num::NonZeroU32;

use futures_util::SinkExt;
use goalgraph::protocol::executor::{FromExecutor, Refusal, ToExecutor};
use goalgraph::run::RunEvent;
use goalgraph_server::relay::RelayLimits;
use tokio_tungstenite::tungstenite::Message;

use super::bench::Bench;

fn number(number: u32) -> NonZeroU32 {
    NonZeroU32::new(number).unwrap()
}

#[tokio::test]
async fn more_messages_than_are_taken_are_refused_and_then_end_the_connection() {
    let limits = RelayLimits {
        messages_per_second: number(1),
        burst: number(10),
        strikes: 3,
        ..RelayLimits::default()
    };
    let bench = Bench::with(limits).await;
    let mut robot = bench.executor("arm").await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
    let beat = serde_json::to_string(&FromExecutor::Heartbeat).unwrap();
    for _ in 0..10 {
        robot.say_text(&beat).await;
        assert_eq!(robot.hear().await, ToExecutor::Heartbeat);
    }
    for _ in 0..100 {
        // The server may have hung up already.
        let _ = robot.socket.send(Message::text(beat.clone())).await;
    }
    let mut refused = 0;
    loop {
        match robot.hear_or_close().await {
            Ok(ToExecutor::Heartbeat) => {}
            Ok(ToExecutor::Refused { reason: Refusal::TooMany, .. }) => refused += 1,
            Ok(other) => panic!("{other:?}"),
            Err(code) => {
                assert_eq!(code, Some(1008));
                break;
            }
        }
    }
    assert_eq!(refused, 4);
}

#[tokio::test]
async fn a_run_has_no_more_events_than_it_may_but_can_always_end() {
    let bench = Bench::with(RelayLimits { events_per_run: 2, ..RelayLimits::default() }).await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    robot.must_report("run-1", 1, RunEvent::Paused).await;
    robot.must_report("run-1", 2, RunEvent::Resumed).await;
    robot.report("run-1", 3, RunEvent::Paused).await;
    assert_eq!(robot.hear_refusal().await, (Refusal::TooMany, Some(3)));
    robot.must_report("run-1", 3, RunEvent::Stopped).await;
}

#[tokio::test]
async fn one_executor_that_floods_the_store_does_not_keep_another_from_storing() {
    let limits = RelayLimits { queue_bytes: 4096, in_flight: 4, ..RelayLimits::default() };
    let bench = Bench::with(limits).await;
    bench.approve("Stack", &["red green"]).await;
    let (mut loud, sha256) = bench.ready("loud").await;
    let (mut quiet, _) = bench.ready("quiet").await;
    loud.must_begin("run-1", &sha256).await;
    quiet.must_begin("run-2", &sha256).await;
    let reason = "x".repeat(100_000);
    let flood = async {
        for number in 1..=50 {
            loud.report("run-1", number, RunEvent::Failed { reason: reason.clone() }).await;
        }
        loud.hear().await
    };
    let small = async {
        for number in 1..=20 {
            quiet.must_report("run-2", number, RunEvent::Paused).await;
        }
    };
    let (first, ()) = tokio::join!(flood, small);
    assert_eq!(first, ToExecutor::Acknowledged { run: "run-1".to_owned(), number: 1 });
}
