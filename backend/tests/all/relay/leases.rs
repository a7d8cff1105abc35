use std::time::Duration;

use goalgraph::pdfa::Symbol;
use goalgraph::protocol::executor::{Denial, FromExecutor, Refusal, ToExecutor, close};
use goalgraph::run::RunEvent;
use goalgraph_server::relay::RelayLimits;
use tokio::time::interval;

use super::bench::{Bench, leases_of};
use super::client::Client;

fn started(symbol: u32) -> RunEvent {
    RunEvent::Started { sub_goal: Symbol(symbol) }
}

/// Asks for the run until somebody else no longer holds it.
async fn begin_when_free(robot: &mut Client, run: &str, sha256: &str) -> u64 {
    let mut tries = interval(Duration::from_millis(50));
    loop {
        tries.tick().await;
        match robot.begin(run, sha256).await {
            ToExecutor::Granted { stored, .. } => return stored,
            ToExecutor::Denied { reason: Denial::Held, .. } => {}
            other => panic!("{other:?}"),
        }
    }
}

#[tokio::test]
async fn a_run_goes_on_after_a_dropped_connection_with_the_number_stored() {
    let bench = Bench::new().await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    robot.must_report("run-1", 1, started(0)).await;
    drop(robot);
    let (mut again, _) = bench.ready("arm").await;
    again.report("run-1", 2, started(1)).await;
    assert_eq!(again.hear_refusal().await, (Refusal::NoLease, None), "a lease is of one connection");
    assert_eq!(again.must_begin("run-1", &sha256).await, 1);
    again.must_report("run-1", 2, started(1)).await;
}

#[tokio::test]
async fn another_executor_is_denied_while_the_lease_lives_also_of_a_dropped_connection() {
    let bench = Bench::new().await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    let (mut other, _) = bench.ready("hand").await;
    let held = |reply| matches!(reply, ToExecutor::Denied { reason: Denial::Held, .. });
    assert!(held(other.begin("run-1", &sha256).await));
    other.report("run-1", 1, started(0)).await;
    assert_eq!(other.hear_refusal().await.0, Refusal::NoLease);
    drop(robot);
    assert!(held(other.begin("run-1", &sha256).await));
}

#[tokio::test]
async fn a_lease_that_ended_is_taken_over_with_the_number_stored() {
    let bench = Bench::with(leases_of(1_000)).await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    robot.must_report("run-1", 1, started(0)).await;
    drop(robot);
    let (mut other, _) = bench.ready("hand").await;
    assert_eq!(begin_when_free(&mut other, "run-1", &sha256).await, 1);
    other.must_report("run-1", 2, started(1)).await;
    assert_eq!(bench.relay.run("run-1").await.unwrap().executor, "hand");
    assert_eq!(bench.store.run("run-1").await.unwrap().executor, "hand");
    let (mut robot, _) = bench.ready("arm").await;
    let reply = robot.begin("run-1", &sha256).await;
    assert!(matches!(reply, ToExecutor::Denied { reason: Denial::Held, .. }), "{reply:?}");
}

#[tokio::test]
async fn whoever_is_silent_for_longer_than_a_lease_is_closed_and_loses_the_run() {
    let bench = Bench::with(leases_of(1_000)).await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    let (mut other, _) = bench.ready("hand").await;
    let taking = begin_when_free(&mut other, "run-1", &sha256);
    let (code, stored) = tokio::join!(robot.hear_close(), taking);
    assert_eq!((code, stored), (Some(close::SILENT), 0));
}

#[tokio::test]
async fn a_connection_without_a_hello_is_closed_when_a_lease_would_end() {
    let bench = Bench::with(leases_of(200)).await;
    let mut nobody = bench.connect().await;
    assert_eq!(nobody.hear_close().await, Some(close::SILENT));
}

#[tokio::test]
async fn heartbeats_keep_a_lease() {
    let bench = Bench::with(leases_of(800)).await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    let mut beats = interval(Duration::from_millis(100));
    // Three times as long as the lease of somebody silent.
    for _ in 0..24 {
        beats.tick().await;
        robot.say(&FromExecutor::Heartbeat).await;
        assert_eq!(robot.hear().await, ToExecutor::Heartbeat);
    }
    robot.must_report("run-1", 1, started(0)).await;
}

#[tokio::test]
async fn an_executor_holds_no_more_runs_than_it_may() {
    let bench = Bench::with(RelayLimits { leases: 2, ..RelayLimits::default() }).await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    robot.must_begin("run-2", &sha256).await;
    robot.say(&FromExecutor::Begin { run: "run-3".to_owned(), sha256: sha256.clone() }).await;
    assert_eq!(robot.hear_refusal().await.0, Refusal::TooMany);
    robot.must_report("run-1", 1, RunEvent::Stopped).await;
    robot.must_begin("run-3", &sha256).await;
    let is_in = || bench.relay.executors()[0].run.clone();
    assert_eq!(is_in().as_deref(), Some("run-3"));
    robot.must_report("run-3", 1, RunEvent::Stopped).await;
    assert_eq!(is_in().as_deref(), Some("run-2"));
    robot.must_report("run-2", 1, RunEvent::Stopped).await;
    assert_eq!(is_in(), None);
}
