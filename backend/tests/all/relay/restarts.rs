use std::time::Duration;

use goalgraph::pdfa::Symbol;
use goalgraph::protocol::executor::{FromExecutor, Refusal, ToExecutor};
use goalgraph::run::{Phase, RunEvent};
use goalgraph_server::relay::RelayLimits;
use goalgraph_server::store::{PageRequest, RunFilter, StoreOptions};
use sqlx::sqlite::SqliteConnectOptions;
use sqlx::{ConnectOptions, Connection};

use super::bench::Bench;
use super::client::Client;

fn started(symbol: u64) -> RunEvent {
    RunEvent::Started { sub_goal: Symbol(symbol as u32) }
}

#[tokio::test]
async fn a_run_goes_on_after_the_server_was_ended_in_the_middle_of_it() {
    let bench = Bench::new().await;
    let approved = bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    for number in 1..=3 {
        robot.must_report("run-1", number, started(number)).await;
    }
    let before = bench.relay.run("run-1").await.unwrap();
    let bench = bench.restart(StoreOptions::default()).await;
    assert_eq!(bench.relay.run("run-1").await.unwrap(), before);
    let known = bench.relay.executors();
    assert_eq!((known[0].executor.as_str(), known[0].connected), ("arm", false));
    assert_eq!(known[0].run.as_deref(), Some("run-1"));
    bench.approve_next(&approved, "Stack", &["green red"]).await;

    let mut robot = bench.executor("arm").await;
    assert!(matches!(robot.hear().await, ToExecutor::Specification { revision: 2, .. }));
    assert_eq!(robot.must_begin("run-1", &sha256).await, 3);
    robot.must_report("run-1", 3, started(3)).await;
    robot.must_report("run-1", 4, RunEvent::Finished).await;
    assert_eq!(bench.relay.run("run-1").await.unwrap().phase, Phase::Finished);
}

#[tokio::test]
async fn everything_acknowledged_before_a_shutdown_is_stored_and_everybody_is_told() {
    let bench = Bench::new().await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    let mut page = bench.monitor().await;
    robot.must_begin("run-1", &sha256).await;
    for number in 1..=300 {
        robot.report("run-1", number, started(number)).await;
    }
    let relay = bench.relay.clone();
    let down = tokio::spawn(async move { relay.shutdown().await });
    let (acknowledged, code) = read_to_the_end(&mut robot).await;
    assert_eq!(code, Some(1001));
    assert_eq!(page.hear_close().await, Some(1001));
    down.await.unwrap();
    let stored = bench.store.events("run-1", 0, 1000).await.unwrap();
    assert_eq!(stored.len() as u64, acknowledged, "what is stored was acknowledged before the end");
    let mut late = bench.restart(StoreOptions::default()).await.executor("arm").await;
    assert!(matches!(late.hear().await, ToExecutor::Specification { .. }));
}

/// The number of the last event acknowledged, and the code that the connection was closed with.
async fn read_to_the_end(robot: &mut Client) -> (u64, Option<u16>) {
    let mut acknowledged = 0;
    loop {
        match robot.hear_or_close().await {
            Ok(ToExecutor::Acknowledged { number, .. }) => acknowledged = number,
            Ok(other) => panic!("{other:?}"),
            Err(code) => return (acknowledged, code),
        }
    }
}

#[tokio::test]
async fn a_full_disk_refuses_events_and_keeps_the_connection() {
    let bench = Bench::new().await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    // As many pages as there are already.
    let bench = bench.restart(StoreOptions { max_pages: Some(1), ..StoreOptions::default() }).await;
    let (mut robot, _) = bench.ready("arm").await;
    assert_eq!(robot.must_begin("run-1", &sha256).await, 0);
    let large = RunEvent::Unavailable { sub_goal: Symbol(0), reason: Some("x".repeat(100_000)) };
    for _ in 0..2 {
        robot.report("run-1", 1, large.clone()).await;
        assert_eq!(robot.hear_refusal().await, (Refusal::Unavailable, Some(1)));
    }
    robot.say(&FromExecutor::Heartbeat).await;
    assert_eq!(robot.hear().await, ToExecutor::Heartbeat);
    assert_eq!(bench.relay.run("run-1").await.unwrap().events, 0);

    let bench = bench.restart(StoreOptions::default()).await;
    let (mut robot, _) = bench.ready("arm").await;
    assert_eq!(robot.must_begin("run-1", &sha256).await, 0);
    robot.must_report("run-1", 1, large).await;
}

#[tokio::test]
async fn a_locked_database_refuses_events_until_it_is_free_again() {
    let impatient = StoreOptions { busy_timeout: Duration::from_millis(100), ..StoreOptions::default() };
    let bench = Bench::at(tempfile::tempdir().unwrap(), RelayLimits::default(), impatient).await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    let file = bench.database();
    let mut other = SqliteConnectOptions::new().filename(file).connect().await.unwrap();
    sqlx::query("BEGIN IMMEDIATE").execute(&mut other).await.unwrap();
    robot.report("run-1", 1, started(1)).await;
    assert_eq!(robot.hear_refusal().await, (Refusal::Unavailable, Some(1)));
    sqlx::query("ROLLBACK").execute(&mut other).await.unwrap();
    robot.must_report("run-1", 1, started(1)).await;
    other.close().await.unwrap();
}

#[tokio::test]
async fn a_run_that_ended_just_before_a_crash_is_known_to_be_over() {
    let bench = Bench::new().await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    let finished = goalgraph_server::store::NewEvent {
        number: 1,
        event: r#"{"event":"finished"}"#.to_owned(),
        robot_at_ms: None,
        received_at_ms: 5,
    };
    bench.store.append_event("run-1", finished).await.unwrap();
    let bench = bench.restart(StoreOptions::default()).await;
    assert_eq!(bench.relay.run("run-1").await.unwrap().phase, Phase::Finished);
    assert!(bench.relay.executors().is_empty());
    let open = RunFilter { specification: None, open_only: true };
    // The relay tells the store in its next round.
    while !bench.store.runs(&open, &PageRequest::default()).await.unwrap().rows.is_empty() {
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}
