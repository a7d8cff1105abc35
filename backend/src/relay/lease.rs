//! Leases: which connection may report events of a run.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use std::sync::Arc;

use tokio::time::Instant;

/// Whether the connection of an executor lives, and when it last said something. By a clock that never goes back.
#[derive(Debug)]
pub(super) struct Presence {
    since: Instant,
    heard_ms: AtomicU64,
    connected: AtomicBool,
}

impl Presence {
    /// A connection that has just said something.
    pub(super) fn begin() -> Arc<Self> {
        let connected = AtomicBool::new(true);
        Arc::new(Self { since: Instant::now(), heard_ms: AtomicU64::new(0), connected })
    }

    /// It says something now.
    pub(super) fn hear(&self) {
        let elapsed = u64::try_from(self.since.elapsed().as_millis()).unwrap_or(u64::MAX);
        self.heard_ms.fetch_max(elapsed, Ordering::Relaxed);
    }

    /// It is gone.
    pub(super) fn end(&self) {
        self.connected.store(false, Ordering::Relaxed);
    }

    /// When it last said something.
    pub(super) fn heard_at(&self) -> Instant {
        self.since + Duration::from_millis(self.heard_ms.load(Ordering::Relaxed))
    }

    /// Whether what it holds may not go to another: it lives, or went for less than `lasting` after it was last heard.
    pub(super) fn is_live(&self, lasting: Duration) -> bool {
        self.connected.load(Ordering::Relaxed) || self.heard_at().elapsed() < lasting
    }
}

/// The right to report events of a run.
///
/// `link` is the number of the connection: what an older connection of the same executor still had under way when a new
/// one took the lease is refused by it.
#[derive(Debug, Clone)]
pub(super) struct Lease {
    /// Name of the executor.
    pub(super) executor: String,
    /// Number of its connection.
    pub(super) link: u64,
    /// Whether it lives.
    pub(super) presence: Arc<Presence>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn a_lease_outlives_its_connection_by_the_time_since_it_was_heard() {
        let presence = Presence::begin();
        assert!(presence.is_live(Duration::ZERO), "connected: its own connection decides");
        presence.end();
        assert!(presence.is_live(Duration::from_hours(1)));
        assert!(!presence.is_live(Duration::ZERO));
    }
}
