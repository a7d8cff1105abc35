//! The socket of the simulated robot: made, used, and made again when it is lost.

mod address;
mod trust;

use std::future::Future;
use std::pin::Pin;
use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use goalgraph::protocol::executor::close;
use tokio::net::TcpStream;
use tokio::time::{Instant, Interval, MissedTickBehavior, interval, sleep, timeout};
use tokio_tungstenite::tungstenite::{self, Message};
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async_tls_with_config};
use uuid::Uuid;

use super::backoff::Backoff;
use super::session::Session;
use crate::clock::now_ms;
pub use address::{Address, ConnectionError};

/// How often the robot moves.
const STEP: Duration = Duration::from_millis(20);

/// How long it may take to connect, and to send a message.
const PATIENCE: Duration = Duration::from_secs(10);

/// How long a robot that is stopped waits for its last events to be stored.
const FAREWELL: Duration = Duration::from_secs(3);

type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

/// Why a connection is no more, or was never made.
enum Lost {
    /// Another attempt may succeed; why it is lost.
    ForNow(String),
    /// No other attempt would.
    ForGood(ConnectionError),
}

/// Runs the robot at the server until the session is done, or until `stop` ends and what is left is stored or cannot be.
/// Hands every line about what happens to `say`.
///
/// # Errors
///
/// When the server does not take this robot, so that another attempt would fare no better.
pub async fn run(
    address: &Address,
    session: Session,
    say: impl FnMut(&str),
    stop: impl Future<Output = ()> + 'static,
) -> Result<(), ConnectionError> {
    let mut ticks = interval(STEP);
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let stop: Pin<Box<dyn Future<Output = ()>>> = Box::pin(stop);
    let mut shell =
        Shell { session, say, stop: Some(stop), deadline: None, ticks, last_tick: Instant::now() };
    let mut backoff = Backoff::default();
    while !shell.is_over() {
        let lost = match Box::pin(shell.connection(address)).await {
            Ok(()) => return Ok(()),
            Err(Lost::ForGood(error)) => return Err(error),
            Err(Lost::ForNow(why)) => why,
        };
        if shell.session.is_welcomed() {
            backoff.reset();
        }
        shell.session.disconnected();
        let wait = backoff.next(Uuid::new_v4().as_u64_pair().1);
        (shell.say)(&format!("{lost}; tries again in {:.1} s", wait.as_secs_f64()));
        shell.meanwhile(sleep(wait)).await;
    }
    Ok(())
}

/// The session with everything around it that is not pure.
struct Shell<S> {
    session: Session,
    say: S,
    /// Ends when somebody wants the program to end; none once it has.
    stop: Option<Pin<Box<dyn Future<Output = ()>>>>,
    /// When it ends at last, whatever is not stored.
    deadline: Option<Instant>,
    ticks: Interval,
    last_tick: Instant,
}

impl<S: FnMut(&str)> Shell<S> {
    /// One connection, from its attempt to its end; an end without error is that of the session.
    async fn connection(&mut self, address: &Address) -> Result<(), Lost> {
        let connecting = connect_async_tls_with_config(address.request(), None, true, address.connector());
        let attempt = timeout(PATIENCE, connecting);
        let socket = match Box::pin(self.meanwhile(attempt)).await {
            None => return Ok(()),
            Some(Ok(Ok((socket, _)))) => socket,
            Some(Ok(Err(error))) => return Err(address.explain(error)),
            Some(Err(_)) => return Err(Lost::ForNow(format!("{address} does not answer"))),
        };
        self.talk(socket).await
    }

    async fn talk(&mut self, mut socket: Socket) -> Result<(), Lost> {
        self.session.connected();
        loop {
            for message in self.session.take_messages() {
                let text =
                    serde_json::to_string(&message).map_err(|error| Lost::ForNow(error.to_string()))?;
                let sending = timeout(PATIENCE, socket.send(Message::text(text))).await;
                sending.map_err(|_| silent())?.map_err(|error| lost(&error))?;
            }
            self.say_lines();
            if self.is_over() {
                // Whether the server hears the good-bye makes no difference.
                let _ = timeout(PATIENCE, socket.close(None)).await;
                return Ok(());
            }
            if self.session.is_deaf() {
                return Err(silent());
            }
            tokio::select! {
                message = socket.next() => self.read(message)?,
                () = self.step() => {}
            }
        }
    }

    fn read(&mut self, message: Option<Result<Message, tungstenite::Error>>) -> Result<(), Lost> {
        match message {
            Some(Ok(Message::Text(text))) => match serde_json::from_str(&text) {
                Ok(message) => self.session.heard(message),
                Err(error) => (self.say)(&format!("the server said what is not understood here: {error}")),
            },
            Some(Ok(Message::Close(Some(frame)))) => return Err(closed(frame.code.into(), &frame.reason)),
            Some(Ok(_)) => {}
            Some(Err(error)) => return Err(lost(&error)),
            None => return Err(Lost::ForNow("the connection ended".to_owned())),
        }
        Ok(())
    }

    /// Awaits `future` while the robot works on; none when it is all over before.
    async fn meanwhile<T>(&mut self, future: impl Future<Output = T>) -> Option<T> {
        tokio::pin!(future);
        while !self.is_over() {
            tokio::select! {
                value = &mut future => return Some(value),
                () = self.step() => self.say_lines(),
            }
        }
        None
    }

    /// One step of the robot, as long as it took; or that it is told to stop.
    async fn step(&mut self) {
        let Self { stop, ticks, .. } = self;
        let stopped = async {
            match stop {
                Some(stop) => stop.await,
                None => std::future::pending().await,
            }
        };
        let told = tokio::select! {
            () = stopped => true,
            _ = ticks.tick() => false,
        };
        if told {
            (self.stop, self.deadline) = (None, Some(Instant::now() + FAREWELL));
            self.session.stop();
        }
        let passed = self.last_tick.elapsed();
        self.last_tick = Instant::now();
        self.session.advance(passed, now_ms());
    }

    fn is_over(&self) -> bool {
        self.session.is_done() || self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    fn say_lines(&mut self) {
        for line in self.session.take_lines() {
            (self.say)(&line);
        }
    }
}

fn silent() -> Lost {
    Lost::ForNow("the server has gone silent".to_owned())
}

fn lost(error: &tungstenite::Error) -> Lost {
    Lost::ForNow(format!("the connection was lost: {error}"))
}

fn closed(code: u16, reason: &str) -> Lost {
    match code {
        close::REPLACED => Lost::ForGood(ConnectionError::Replaced),
        close::REVOKED => Lost::ForGood(ConnectionError::Revoked),
        _ => Lost::ForNow(format!("the server closed the connection ({code} {reason})")),
    }
}
