//! The program is told to stop.

use std::process::Command;

use futures_util::{SinkExt, StreamExt};
use goalgraph::protocol::executor::{FromExecutor, SUBPROTOCOL};
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;

use crate::program::Program;

#[cfg(unix)]
#[tokio::test]
async fn executors_are_told_that_the_server_ends() {
    let folder = tempfile::tempdir().unwrap();
    let mut program = Program::start(folder.path());
    let mut request = format!("ws://{}/api/v1/executor", program.address).into_client_request().unwrap();
    request.headers_mut().insert("sec-websocket-protocol", SUBPROTOCOL.parse().unwrap());
    let (mut socket, _) = connect_async(request).await.unwrap();
    let hello = FromExecutor::Hello { executor: "arm".to_owned(), software: None };
    socket.send(Message::text(serde_json::to_string(&hello).unwrap())).await.unwrap();
    // The welcome: the connection counts from here on.
    assert!(matches!(socket.next().await, Some(Ok(Message::Text(_)))));

    let told = Command::new("kill").arg(program.id().to_string()).status().unwrap();
    assert!(told.success());
    let code = loop {
        match socket.next().await {
            Some(Ok(Message::Close(frame))) => break frame.map(|frame| u16::from(frame.code)),
            Some(Ok(_)) => {}
            other => panic!("a close frame was expected, not {other:?}"),
        }
    };
    assert_eq!(code, Some(1001));
    assert!(program.wait().success());
}
