//! What a command is doing, told only when it takes long.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::output;

const INTERVAL: Duration = Duration::from_secs(1);

/// Tells on standard error what is being done: nothing for the first second, then at most one line per second.
pub(crate) struct Progress {
    stages: Option<Sender<String>>,
    teller: Option<JoinHandle<()>>,
}

impl Progress {
    /// Starts the clock.
    pub(crate) fn start() -> Self {
        let (stages, received) = channel();
        Self { stages: Some(stages), teller: Some(thread::spawn(move || tell(&received))) }
    }

    /// From now on `stage` is being done.
    pub(crate) fn stage(&self, stage: impl Into<String>) {
        if let Some(stages) = &self.stages {
            // The teller outlives this value.
            let _ = stages.send(stage.into());
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.stages = None;
        if let Some(teller) = self.teller.take() {
            let _ = teller.join();
        }
    }
}

/// Keeps the newest stage and says it when the second is over, until there will be no more.
fn tell(stages: &Receiver<String>) {
    let mut newest = None;
    let mut next = Instant::now() + INTERVAL;
    loop {
        match stages.recv_timeout(next.saturating_duration_since(Instant::now())) {
            Ok(stage) => newest = Some(stage),
            Err(RecvTimeoutError::Timeout) => {
                if let Some(stage) = newest.take() {
                    output::say(&format!("{stage} ..."));
                }
                next = Instant::now() + INTERVAL;
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}
