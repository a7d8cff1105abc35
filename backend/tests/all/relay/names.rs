use std::time::Duration;

use goalgraph::protocol::executor::{FromExecutor, SUBPROTOCOL, ToExecutor, close};
use goalgraph::run::RunEvent;
use tokio::runtime::Handle;

use super::bench::Bench;
use super::client::{Client, open};

async fn with_token(bench: &Bench, token: &str) -> Client {
    open(bench.address, &format!("/executor?token={token}"), Some(SUBPROTOCOL)).await.unwrap()
}

#[tokio::test]
async fn a_new_connection_of_an_executor_takes_the_place_of_the_old() {
    let bench = Bench::new().await;
    bench.approve("Stack", &["red green"]).await;
    let (mut old, sha256) = bench.ready("arm").await;
    old.must_begin("run-1", &sha256).await;
    old.must_report("run-1", 1, RunEvent::Paused).await;
    let (mut new, _) = bench.ready("arm").await;
    assert_eq!(old.hear_close().await, Some(close::REPLACED));
    assert_eq!(new.must_begin("run-1", &sha256).await, 1);
    new.must_report("run-1", 2, RunEvent::Resumed).await;
    assert_eq!(bench.relay.counts().executors, 1);
}

#[tokio::test]
async fn another_token_does_not_take_the_name_of_an_executor() {
    let bench = Bench::new().await;
    let mut owner = with_token(&bench, "one").await;
    owner.greet("arm").await;
    assert_eq!(owner.hear().await, ToExecutor::Withdrawn);
    let mut thief = with_token(&bench, "two").await;
    thief.say(&FromExecutor::Hello { executor: "arm".to_owned(), software: None }).await;
    assert_eq!(thief.hear_close().await, Some(1008));
    owner.say(&FromExecutor::Heartbeat).await;
    assert_eq!(owner.hear().await, ToExecutor::Heartbeat);
    let mut again = with_token(&bench, "one").await;
    again.greet("arm").await;
    assert_eq!(owner.hear_close().await, Some(close::REPLACED));
}

#[tokio::test]
async fn a_revoked_token_ends_its_connections_and_no_others() {
    let bench = Bench::new().await;
    let mut revoked = with_token(&bench, "one").await;
    revoked.greet("arm").await;
    let mut silent = with_token(&bench, "one").await;
    silent.say(&FromExecutor::Heartbeat).await;
    assert!(matches!(silent.hear().await, ToExecutor::Refused { .. }));
    let mut other = with_token(&bench, "two").await;
    other.greet("hand").await;
    assert_eq!(other.hear().await, ToExecutor::Withdrawn);
    bench.relay.disconnect_token("one");
    assert_eq!(revoked.hear_close().await, Some(close::REVOKED));
    other.say(&FromExecutor::Heartbeat).await;
    assert_eq!(other.hear().await, ToExecutor::Heartbeat);
}

#[tokio::test]
async fn a_thousand_connections_of_one_executor_leave_one() {
    let bench = Bench::new().await;
    bench.approve("Stack", &["red green"]).await;
    let mut page = bench.monitor().await;
    page.watch().await;
    let tasks = || Handle::current().metrics().num_alive_tasks();
    let before = tasks();
    for _ in 0..1_000 {
        drop(bench.executor("arm").await);
    }
    let mut last = bench.executor("arm").await;
    last.accept().await;
    let names: Vec<String> = bench.relay.executors().into_iter().map(|it| it.executor).collect();
    assert_eq!(names, ["arm"]);
    page.watch_executor(|it| it.connected && it.holds.is_some()).await;
    drop(last);
    page.watch_executor(|it| !it.connected).await;
    while tasks() > before {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    bench.relay.shutdown().await;
    let counts = bench.relay.counts();
    assert_eq!((counts.executors, counts.monitors), (0, 0));
    assert!(bench.relay.executors().is_empty());
}
