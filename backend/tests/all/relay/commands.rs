use goalgraph::protocol::executor::{Command, ToExecutor};
use goalgraph::run::RunEvent;
use goalgraph_server::relay::CommandError;

use super::bench::Bench;

#[tokio::test]
async fn commands_reach_the_executor_they_make_sense_for() {
    let bench = Bench::new().await;
    let command = |command| bench.relay.command("arm", command);
    assert_eq!(command(Command::Start), Err(CommandError::NotConnected("arm".to_owned())));
    let first = bench.approve("Stack", &["red green"]).await;
    let mut page = bench.monitor().await;
    let mut robot = bench.executor("arm").await;
    page.watch_executor(|it| it.holds.is_some()).await;
    assert_eq!(command(Command::Start), Err(CommandError::NotAccepted("arm".to_owned())));
    assert_eq!(command(Command::Pause), Err(CommandError::Idle("arm".to_owned())));
    assert_eq!(robot.accept().await, first.sha256);
    robot.must_begin("run-0", &first.sha256).await;
    robot.must_report("run-0", 1, RunEvent::Stopped).await;

    command(Command::Start).unwrap();
    assert_eq!(robot.hear().await, ToExecutor::Command { command: Command::Start });
    robot.must_begin("run-1", &first.sha256).await;
    let busy = CommandError::Busy { executor: "arm".to_owned(), run: "run-1".to_owned() };
    assert_eq!(command(Command::Start), Err(busy));
    for wanted in [Command::Pause, Command::Resume, Command::Stop, Command::Stop] {
        command(wanted).unwrap();
        assert_eq!(robot.hear().await, ToExecutor::Command { command: wanted });
    }
    robot.must_report("run-1", 1, RunEvent::Stopped).await;
    assert_eq!(command(Command::Stop), Err(CommandError::Idle("arm".to_owned())));
}
