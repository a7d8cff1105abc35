use goalgraph::pdfa::{StateId, Symbol};
use goalgraph::protocol::executor::{Denial, FromExecutor, Refusal, ToExecutor};
use goalgraph::run::{Departure, Phase, RunEvent};
use goalgraph_server::store::{PageRequest, RunFilter, StoreOptions};

use super::bench::Bench;

/// The words of a task in which either block may come first.
const EITHER: &[&str] = &["red green", "green red"];

fn completed(symbol: u32) -> RunEvent {
    RunEvent::Completed { sub_goal: Symbol(symbol) }
}

fn denial(reply: &ToExecutor) -> Option<Denial> {
    match reply {
        ToExecutor::Denied { reason, .. } => Some(*reason),
        _ => None,
    }
}

#[tokio::test]
async fn a_run_is_followed_from_its_plan_to_its_end() {
    let bench = Bench::new().await;
    let approved = bench.approve("Stack", EITHER).await;
    let mut page = bench.monitor().await;
    let (mut robot, sha256) = bench.ready("arm").await;
    assert_eq!(robot.must_begin("run-1", &sha256).await, 0);
    page.watch_executor(|it| it.run.as_deref() == Some("run-1")).await;
    let (red, green) = (Symbol(0), Symbol(1));
    let word = vec![red, green];
    robot.must_report("run-1", 1, RunEvent::Planned { state: StateId(0), word, probability: 0.5 }).await;
    robot.must_report("run-1", 2, RunEvent::Started { sub_goal: red }).await;
    let begun = page.watch_run(|run| run.events == 2).await;
    assert_eq!((begun.phase, begun.active, begun.plan), (Phase::Running, Some(red), vec![red, green]));
    let reason = Some("out of reach".to_owned());
    robot.must_report("run-1", 3, RunEvent::Unavailable { sub_goal: red, reason }).await;
    let word = vec![green, red];
    robot.must_report("run-1", 4, RunEvent::Replanned { state: StateId(0), word, probability: 0.5 }).await;
    let replanned = page.watch_run(|run| run.events == 4).await;
    assert_eq!((replanned.replans, replanned.unavailable), (1, vec![red]));
    robot.must_report("run-1", 5, completed(1)).await;
    robot.must_report("run-1", 6, completed(0)).await;
    robot.must_report("run-1", 7, RunEvent::Finished).await;

    let over = page.watch_run(|run| run.phase == Phase::Finished).await;
    assert_eq!((over.executor.as_str(), &over.specification), ("arm", &approved.specification));
    assert_eq!((over.trail.clone(), over.departure), (vec![green, red], None));
    assert_eq!(over.log_likelihood.to_bits(), 0.5_f64.ln().to_bits());
    assert_eq!(over.states.len(), 3);
    assert_eq!(bench.relay.run("run-1").await.unwrap(), over);
    let events = bench.store.events("run-1", 0, 100).await.unwrap();
    assert_eq!(events.iter().map(|it| it.number).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(events[6].event, r#"{"event":"finished"}"#);
    page.watch_executor(|it| it.run.is_none()).await;
    assert_eq!(denial(&robot.begin("run-1", &sha256).await), Some(Denial::Over));
}

#[tokio::test]
async fn a_run_that_leaves_the_automaton_is_marked_and_goes_on() {
    let bench = Bench::new().await;
    bench.approve("Stack", &["red green"]).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    robot.must_report("run-1", 1, completed(1)).await;
    robot.must_report("run-1", 2, completed(77)).await;
    let view = bench.relay.run("run-1").await.unwrap();
    let no_way = Departure::NoWay { number: 1, state: StateId(0), sub_goal: Symbol(1) };
    assert_eq!((view.departure, view.state, view.phase), (Some(no_way), None, Phase::Running));
}

#[tokio::test]
async fn an_event_sent_again_is_acknowledged_again_and_stored_once() {
    let bench = Bench::new().await;
    bench.approve("Stack", EITHER).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    robot.must_report("run-1", 1, completed(0)).await;
    robot.must_report("run-1", 1, completed(0)).await;
    robot.must_report("run-1", 2, completed(1)).await;
    robot.must_report("run-1", 1, completed(0)).await;
    assert_eq!(bench.store.events("run-1", 0, 100).await.unwrap().len(), 2);
    assert_eq!(bench.relay.run("run-1").await.unwrap().trail, [Symbol(0), Symbol(1)]);
    assert_eq!(bench.relay.counts().events_stored, 2);
}

#[tokio::test]
async fn gaps_conflicts_and_events_after_the_end_are_refused_and_nothing_of_them_is_stored() {
    let bench = Bench::new().await;
    bench.approve("Stack", EITHER).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    robot.report("run-1", 2, completed(0)).await;
    assert_eq!(robot.hear_refusal().await, (Refusal::Gap, Some(1)));
    robot.report("run-1", 0, completed(0)).await;
    assert_eq!(robot.hear_refusal().await, (Refusal::Gap, Some(1)));
    robot.must_report("run-1", 1, completed(0)).await;
    robot.report("run-1", 1, completed(1)).await;
    assert_eq!(robot.hear_refusal().await, (Refusal::Conflict, Some(2)));
    robot.must_report("run-1", 2, RunEvent::Stopped).await;
    robot.report("run-1", 3, completed(1)).await;
    assert_eq!(robot.hear_refusal().await, (Refusal::Over, None));
    assert_eq!(bench.store.events("run-1", 0, 100).await.unwrap().len(), 2);
    assert_eq!(bench.relay.counts().messages_refused, 4);
}

#[tokio::test]
async fn many_events_at_once_are_stored_in_their_order() {
    let bench = Bench::new().await;
    bench.approve("Stack", EITHER).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    for number in 1..=500 {
        robot.report("run-1", number, RunEvent::Started { sub_goal: Symbol(number as u32) }).await;
    }
    loop {
        match robot.hear().await {
            ToExecutor::Acknowledged { number: 500, .. } => break,
            ToExecutor::Acknowledged { .. } => {}
            other => panic!("{other:?}"),
        }
    }
    let events = bench.store.events("run-1", 0, 1000).await.unwrap();
    assert!(events.iter().map(|it| it.number).eq(1..=500));
    assert_eq!(bench.relay.run("run-1").await.unwrap().active, Some(Symbol(500)));
}

#[tokio::test]
async fn a_run_begins_with_the_accepted_and_approved_revision_only() {
    let bench = Bench::new().await;
    let first = bench.approve("Stack", EITHER).await;
    let mut robot = bench.executor("arm").await;
    let ToExecutor::Specification { sha256, .. } = robot.hear().await else { panic!("no specification") };
    assert_eq!(denial(&robot.begin("run-1", &sha256).await), Some(Denial::NotAccepted));
    robot.say(&FromExecutor::Accepted { sha256: sha256.clone() }).await;
    assert_eq!(denial(&robot.begin("run-1", &"0".repeat(64)).await), Some(Denial::Stale));
    for bad in ["", "a\nb", &"x".repeat(101)] {
        assert_eq!(denial(&robot.begin(bad, &sha256).await), Some(Denial::BadId));
    }
    robot.must_begin("run-1", &sha256).await;

    let second = bench.approve_next(&first, "Stack", &["green red"]).await;
    assert_eq!(robot.accept().await, second.sha256);
    assert_eq!(denial(&robot.begin("run-2", &first.sha256).await), Some(Denial::Stale));
    assert_eq!(denial(&robot.begin("run-1", &second.sha256).await), Some(Denial::OtherSpecification));
    robot.must_report("run-1", 1, completed(0)).await;
    assert_eq!(robot.must_begin("run-1", &first.sha256).await, 1, "it goes on with its own revision");
    bench.revoke(&second).await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
    assert_eq!(denial(&robot.begin("run-2", &second.sha256).await), Some(Denial::Stale));
    robot.must_report("run-1", 2, completed(1)).await;
}

#[tokio::test]
async fn a_run_goes_on_when_its_specification_is_deleted_and_no_other_begins() {
    let bench = Bench::new().await;
    let approved = bench.approve("Stack", EITHER).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    robot.must_begin("run-1", &sha256).await;
    bench.revoke(&approved).await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
    bench.store.delete(&approved.specification, approved.revision).await.unwrap();
    assert_eq!(denial(&robot.begin("run-2", &sha256).await), Some(Denial::Stale));
    robot.must_report("run-1", 1, completed(0)).await;

    // It is hidden, not lost: also a server that knows of nothing any more lets the run go on.
    let bench = bench.restart(StoreOptions::default()).await;
    let mut robot = bench.executor("arm").await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
    assert_eq!(robot.must_begin("run-1", &sha256).await, 1);
    robot.must_report("run-1", 2, completed(1)).await;
}

#[tokio::test]
async fn runs_are_listed_newest_first_with_where_they_stand() {
    let bench = Bench::new().await;
    bench.approve("Stack", EITHER).await;
    let (mut robot, sha256) = bench.ready("arm").await;
    for run in ["first", "second", "third"] {
        robot.must_begin(run, &sha256).await;
        robot.must_report(run, 1, completed(0)).await;
    }
    robot.must_report("second", 2, RunEvent::Failed { reason: "dropped it".to_owned() }).await;
    let page = bench.relay.runs(&RunFilter::default(), &PageRequest::default()).await.unwrap();
    let listed: Vec<_> = page.rows.iter().map(|run| (run.run.as_str(), run.phase)).collect();
    let running = Phase::Running;
    assert_eq!(listed, [("third", running), ("second", Phase::Failed), ("first", running)]);
}
