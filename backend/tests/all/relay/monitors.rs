use goalgraph::pdfa::Symbol;
use goalgraph::protocol::monitor::ToMonitor;
use goalgraph::run::{Phase, RunEvent};
use goalgraph_server::relay::RelayLimits;

use super::bench::Bench;

#[tokio::test]
async fn a_page_gets_everything_first_and_then_only_what_has_changed() {
    let bench = Bench::new().await;
    let stack = bench.approve("Stack", &["red green"]).await;
    let (mut arm, sha256) = bench.ready("arm").await;
    let (mut hand, _) = bench.ready("hand").await;
    arm.must_begin("run-1", &sha256).await;
    hand.must_begin("run-2", &sha256).await;
    arm.must_report("run-1", 1, RunEvent::Stopped).await;

    let mut page = bench.monitor().await;
    let ToMonitor::Snapshot { executors, runs, approved } = page.watch().await else { panic!("no snapshot") };
    assert_eq!(executors.iter().map(|it| it.executor.as_str()).collect::<Vec<_>>(), ["arm", "hand"]);
    let listed: Vec<_> = runs.iter().map(|it| (it.run.as_str(), it.phase)).collect();
    assert_eq!(listed, [("run-2", Phase::Running), ("run-1", Phase::Stopped)]);
    assert_eq!(approved.len(), 1);
    assert_eq!((approved[0].specification.as_str(), approved[0].revision), (&*stack.specification, Some(1)));

    hand.must_report("run-2", 1, RunEvent::Started { sub_goal: Symbol(0) }).await;
    let ToMonitor::Changes { executors, runs, approved } = page.watch().await else { panic!("no changes") };
    assert_eq!((executors.len(), approved.len()), (0, 0));
    assert_eq!(runs.len(), 1);
    assert_eq!((runs[0].run.as_str(), runs[0].active), ("run-2", Some(Symbol(0))));

    bench.revoke(&stack).await;
    loop {
        let ToMonitor::Changes { approved, .. } = page.watch().await else { panic!("no changes") };
        if let Some(view) = approved.first() {
            assert_eq!((view.name.as_str(), view.revision), ("Stack", None));
            break;
        }
    }
}

#[tokio::test]
async fn of_the_runs_that_are_over_the_last_are_shown() {
    let bench = Bench::with(RelayLimits { finished_runs: 2, ..RelayLimits::default() }).await;
    bench.approve("Stack", &["red green"]).await;
    let (mut arm, sha256) = bench.ready("arm").await;
    for number in 1..=4 {
        let run = format!("run-{number}");
        arm.must_begin(&run, &sha256).await;
        arm.must_report(&run, 1, RunEvent::Finished).await;
    }
    let bench = bench.restart(goalgraph_server::store::StoreOptions::default()).await;
    let mut page = bench.monitor().await;
    let ToMonitor::Snapshot { runs, .. } = page.watch().await else { panic!("no snapshot") };
    assert_eq!(runs.iter().map(|it| it.run.as_str()).collect::<Vec<_>>(), ["run-4", "run-3"]);
    assert_eq!(bench.relay.run("run-1").await.unwrap().phase, Phase::Finished);
}
