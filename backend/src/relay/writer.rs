//! The one task that begins runs and stores events, in the order of their coming: what waits at the same time is stored
//! in one transaction, and nothing is answered before it is stored.

use std::collections::BTreeMap;
use std::sync::{Arc, Weak};

use goalgraph::protocol::executor::ToExecutor;
use goalgraph::run::RunEvent;
use tokio::sync::{OwnedSemaphorePermit, mpsc, oneshot, watch};

use super::offer::Offered;
use super::{Inner, begin, events};

/// How many jobs may wait. What they take in memory is bounded by [`super::RelayLimits::queue_bytes`].
pub(super) const QUEUE: usize = 4096;

/// The most jobs of one transaction.
const AT_A_TIME: usize = 512;

/// Something to do for a connection.
#[derive(Debug)]
pub(super) enum Job {
    /// Ask for a lease.
    Begin(Begin),
    /// Store an event.
    Event(Event),
    /// Tell when everything before it is done.
    Flush(oneshot::Sender<()>),
}

/// Who asks, and how the answer gets there. Every job gets one answer.
#[derive(Debug)]
pub(super) struct Asker {
    /// Name of the executor.
    pub(super) executor: String,
    /// Number of its connection.
    pub(super) link: u64,
    /// Where the answer goes. There is room for one to each job under way.
    pub(super) replies: mpsc::Sender<ToExecutor>,
    /// The memory that the job takes, until it is done.
    pub(super) _room: OwnedSemaphorePermit,
}

impl Asker {
    /// Answers. Nobody is left to hear it when the connection is gone.
    pub(super) fn tell(&self, reply: ToExecutor) {
        let _ = self.replies.try_send(reply);
    }
}

/// A lease that is asked for.
#[derive(Debug)]
pub(super) struct Begin {
    /// Who asks.
    pub(super) asker: Asker,
    /// Id of the run.
    pub(super) run: String,
    /// SHA-256 of the specification that it follows.
    pub(super) sha256: String,
    /// What is approved, whenever one looks.
    pub(super) offers: watch::Receiver<Offered>,
}

/// An event to store.
#[derive(Debug)]
pub(super) struct Event {
    /// Who reports it.
    pub(super) asker: Asker,
    /// Id of the run.
    pub(super) run: String,
    /// Its number.
    pub(super) number: u64,
    /// When, by the executor's clock.
    pub(super) at_ms: Option<i64>,
    /// What happened.
    pub(super) happened: RunEvent,
}

/// Does jobs until nobody can give any more.
pub(super) async fn work(relay: Weak<Inner>, mut jobs: mpsc::Receiver<Job>) {
    let mut waiting = Vec::new();
    while jobs.recv_many(&mut waiting, AT_A_TIME).await > 0 {
        let Some(relay) = relay.upgrade() else { return };
        do_all(&relay, waiting.drain(..)).await;
    }
}

async fn do_all(relay: &Arc<Inner>, jobs: impl Iterator<Item = Job>) {
    let mut together: BTreeMap<String, Vec<Event>> = BTreeMap::new();
    for job in jobs {
        match job {
            Job::Event(event) => together.entry(event.run.clone()).or_default().push(event),
            Job::Begin(job) => {
                events::store(relay, std::mem::take(&mut together)).await;
                let reply = begin::begin(relay, &job).await;
                job.asker.tell(reply);
            }
            Job::Flush(done) => {
                events::store(relay, std::mem::take(&mut together)).await;
                let _ = done.send(());
            }
        }
    }
    events::store(relay, together).await;
}
