use goalgraph::protocol::executor::{FromExecutor, Refusal, SUBPROTOCOL, ToExecutor};
use goalgraph::protocol::monitor::Answer;

use super::bench::Bench;
use super::client::open;

#[tokio::test]
async fn an_executor_is_welcomed_and_gets_what_is_approved() {
    let bench = Bench::new().await;
    let approved = bench.approve("Two blocks", &["red green", "green red"]).await;
    let mut robot = bench.connect().await;
    robot.say(&FromExecutor::Hello { executor: "arm".to_owned(), software: None }).await;
    let welcome =
        ToExecutor::Welcome { heartbeat_ms: 5_000, lease_ms: 15_000, max_message_bytes: 256 * 1024 };
    assert_eq!(robot.hear().await, welcome);
    let row = bench.store.approved(&approved.specification).await.unwrap().unwrap();
    let offer = ToExecutor::Specification {
        specification: approved.specification,
        revision: 1,
        approval: row.sequence,
        sha256: approved.sha256,
        content: approved.content,
    };
    assert_eq!(robot.hear().await, offer);
    robot.say(&FromExecutor::Heartbeat).await;
    assert_eq!(robot.hear().await, ToExecutor::Heartbeat);
}

#[tokio::test]
async fn an_approval_and_a_revocation_reach_whoever_is_connected() {
    let bench = Bench::new().await;
    let mut robot = bench.executor("arm").await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
    let first = bench.approve("Stack", &["red green"]).await;
    assert_eq!(robot.accept().await, first.sha256);
    let second = bench.approve_next(&first, "Stack", &["green red"]).await;
    assert_eq!(robot.accept().await, second.sha256);
    bench.revoke(&second).await;
    assert_eq!(robot.hear().await, ToExecutor::Withdrawn);
}

#[tokio::test]
async fn an_executor_follows_the_specification_it_asked_for_and_the_others_the_last_approved() {
    let bench = Bench::new().await;
    let stack = bench.approve("Stack", &["red green"]).await;
    let path = format!("/executor?specification={}", stack.specification);
    let mut of_stack = open(bench.address, &path, Some(SUBPROTOCOL)).await.unwrap();
    of_stack.greet("arm").await;
    assert_eq!(of_stack.accept().await, stack.sha256);
    let (mut of_latest, sha256) = bench.ready("hand").await;
    assert_eq!(sha256, stack.sha256);

    let sort = bench.approve("Sort", &["blue"]).await;
    assert_eq!(of_latest.accept().await, sort.sha256);
    let next = bench.approve_next(&stack, "Stack", &["green red"]).await;
    assert_eq!(of_stack.accept().await, next.sha256, "not the other specification before it");
    assert_eq!(of_latest.accept().await, next.sha256);
    bench.revoke(&next).await;
    assert_eq!(of_stack.hear().await, ToExecutor::Withdrawn);
    assert_eq!(of_latest.accept().await, sort.sha256, "the last approved of those that still are");
}

#[tokio::test]
async fn a_monitor_sees_what_executors_hold_and_answered() {
    let bench = Bench::new().await;
    let approved = bench.approve("Stack", &["red green"]).await;
    let mut page = bench.monitor().await;
    let mut robot = bench.executor("arm").await;
    let waiting = page.watch_executor(|it| it.holds.is_some()).await;
    let held = waiting.holds.unwrap();
    assert_eq!(
        (held.specification, held.name, held.revision, held.sha256, held.answer),
        (approved.specification, "Stack".to_owned(), 1, approved.sha256, Answer::Awaited)
    );
    robot.accept().await;
    let answer_of =
        |it: &goalgraph::protocol::monitor::ExecutorView| it.holds.clone().map(|held| held.answer);
    let accepted = page.watch_executor(|it| answer_of(it) == Some(Answer::Accepted)).await;
    assert_eq!((accepted.executor.as_str(), accepted.software.as_deref()), ("arm", Some("test 1")));

    let next = bench.approve("Sort", &["blue"]).await;
    let ToExecutor::Specification { sha256, .. } = robot.hear().await else { panic!("no specification") };
    assert_eq!(sha256, next.sha256);
    robot.say(&FromExecutor::Rejected { sha256, reason: "no gripper for blue".to_owned() }).await;
    let rejected = Answer::Rejected { reason: "no gripper for blue".to_owned() };
    page.watch_executor(|it| answer_of(it) == Some(rejected.clone())).await;

    drop(robot);
    let gone = page.watch_executor(|it| !it.connected).await;
    assert_eq!((gone.executor.as_str(), gone.holds), ("arm", None));
    assert!(bench.relay.executors().is_empty());
}

#[tokio::test]
async fn an_answer_to_a_specification_that_was_not_sent_is_refused_and_a_late_one_is_not() {
    let bench = Bench::new().await;
    let first = bench.approve("Stack", &["red green"]).await;
    let (mut robot, _) = bench.ready("arm").await;
    robot.say(&FromExecutor::Accepted { sha256: "0".repeat(64) }).await;
    assert_eq!(robot.hear_refusal().await.0, Refusal::UnknownSpecification);
    let next = bench.approve_next(&first, "Stack", &["green red"]).await;
    let ToExecutor::Specification { .. } = robot.hear().await else { panic!("no specification") };
    robot.say(&FromExecutor::Accepted { sha256: first.sha256 }).await;
    robot.say(&FromExecutor::Heartbeat).await;
    assert_eq!(robot.hear().await, ToExecutor::Heartbeat, "no refusal before it");
    let held = bench.relay.executors()[0].holds.clone().unwrap();
    assert_eq!((held.sha256, held.answer), (next.sha256, Answer::Awaited));
}
