use std::time::Duration;

use goalgraph::protocol::executor::ToExecutor;
use goalgraph::protocol::monitor::ToMonitor;
use goalgraph_server::relay::RelayLimits;

use super::bench::{Approved, Bench};

/// More than what the sockets between the two hold.
const APPROVALS: usize = 60;

/// Patient enough that nobody is dropped while a test makes its approvals.
fn patient() -> RelayLimits {
    let long = Duration::from_mins(2);
    RelayLimits { send: long, lease: long, heartbeat: long, ..RelayLimits::default() }
}

/// A task whose file is large.
async fn approve_large(bench: &Bench, before: Option<&Approved>, number: usize) -> Approved {
    let word = format!("{number}-{}", "x".repeat(400_000));
    let name = format!("{number} {}", "y".repeat(400_000));
    match before {
        None => bench.approve(&name, &[&word]).await,
        Some(before) => bench.approve_next(before, &name, &[&word]).await,
    }
}

async fn approve_many(bench: &Bench) -> Approved {
    let mut last = approve_large(bench, None, 0).await;
    for number in 1..APPROVALS {
        last = approve_large(bench, Some(&last), number).await;
    }
    last
}

#[tokio::test(flavor = "multi_thread")]
async fn an_executor_that_does_not_read_gets_the_newest_and_not_everything() {
    let bench = Bench::with(patient()).await;
    let mut robot = bench.executor("arm").await;
    let last = approve_many(&bench).await;
    let mut got = 0;
    loop {
        if let ToExecutor::Specification { revision, .. } = robot.hear().await {
            got += 1;
            if revision == last.revision {
                break;
            }
        }
    }
    assert!(got < APPROVALS, "{got} of {APPROVALS}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_page_that_does_not_read_gets_the_newest_and_not_everything() {
    let bench = Bench::with(patient()).await;
    let mut page = bench.monitor().await;
    let mut robot = bench.executor("arm").await;
    let reading = tokio::spawn(async move { robot.hear_close().await });
    let last = approve_many(&bench).await;
    let mut got = 0;
    loop {
        let (ToMonitor::Snapshot { approved, .. } | ToMonitor::Changes { approved, .. }) = page.watch().await;
        got += approved.len();
        if approved.iter().any(|it| it.revision == Some(last.revision)) {
            break;
        }
    }
    assert!(got < APPROVALS, "{got} of {APPROVALS}");
    reading.abort();
}

#[tokio::test(flavor = "multi_thread")]
async fn whoever_does_not_read_for_too_long_is_dropped() {
    let bench = Bench::with(RelayLimits { send: Duration::from_secs(1), ..patient() }).await;
    let _deaf_page = bench.monitor().await;
    let mut page = bench.monitor().await;
    let _deaf = bench.executor("arm").await;
    let watching = tokio::spawn(async move {
        page.watch_executor(|it| it.connected).await;
        page.watch_executor(|it| !it.connected).await;
        page
    });
    approve_many(&bench).await;
    let mut page = watching.await.unwrap();
    // The other page is dropped for the same reason; this one still hears.
    let mut robot = bench.executor("hand").await;
    assert!(matches!(robot.hear().await, ToExecutor::Specification { .. }));
    page.watch_executor(|it| it.executor == "hand").await;
    while bench.relay.counts().monitors > 1 {
        tokio::task::yield_now().await;
    }
}
