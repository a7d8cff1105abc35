//! docs/executor-session.jsonl, said to the real relay over a real socket.

use std::collections::BTreeMap;

use goalgraph::protocol::executor::{FromExecutor, Spoken, ToExecutor};
use serde_json::Value;

use super::bench::Bench;
use super::client::Client;
use crate::executor_session::transcript;

/// Without what the server chooses: the id of the specification and the place of its approval.
fn comparable(message: &ToExecutor) -> Value {
    let mut value = serde_json::to_value(message).unwrap();
    value.as_object_mut().unwrap().retain(|key, _| key != "specification" && key != "approval");
    value
}

/// Reads until the server has acknowledged events up to this number; it may acknowledge several at once.
async fn acknowledged(client: &mut Client, last: &mut BTreeMap<String, u64>, run: String, number: u64) {
    while last.get(&run).is_none_or(|&last| last < number) {
        match client.hear().await {
            ToExecutor::Acknowledged { run, number } => last.insert(run, number),
            other => panic!("an acknowledgment of event {number} was expected, not {other:?}"),
        };
    }
}

#[tokio::test]
async fn the_relay_says_what_the_server_of_the_transcript_says() {
    let bench = Bench::new().await;
    let approved = bench.approve("Blue on top", &["red blue", "red blue", "green blue"]).await;
    let mut client = bench.connect().await;
    let mut last = BTreeMap::new();
    for (index, spoken) in transcript().into_iter().enumerate() {
        match spoken {
            Spoken::Executor(message) => {
                if index > 0 && matches!(message, FromExecutor::Hello { .. }) {
                    // The transcript loses the connection before the last two events are stored.
                    client = bench.connect().await;
                }
                client.say(&message).await;
            }
            Spoken::Server(ToExecutor::Command { command }) => {
                // What was said before has been read once this is answered.
                client.say(&FromExecutor::Heartbeat).await;
                assert_eq!(client.hear().await, ToExecutor::Heartbeat);
                bench.relay.command("cell 4", command).unwrap();
                assert_eq!(client.hear().await, ToExecutor::Command { command });
            }
            Spoken::Server(ToExecutor::Acknowledged { run, number }) => {
                acknowledged(&mut client, &mut last, run, number).await;
            }
            Spoken::Server(ToExecutor::Granted { run, stored }) if stored > 0 => {
                // What was said just before may have been stored, or not.
                let ToExecutor::Granted { run: granted, stored: at_least } = client.hear().await else {
                    panic!("a lease was expected")
                };
                assert!(granted == run && (stored..=stored + 2).contains(&at_least), "{at_least}");
            }
            Spoken::Server(expected) => assert_eq!(comparable(&client.hear().await), comparable(&expected)),
        }
    }
    let view = bench.relay.run("5f1d9c1e-2f44-4f0e-9f62-0a7c2f3b8d11").await.unwrap();
    assert_eq!((view.specification, view.events, view.departure), (approved.specification, 9, None));
}
