//! What there is to measure.

use std::sync::atomic::{AtomicU64, Ordering};

/// Figures of the relay at a moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RelayCounts {
    /// Executors that are connected and have said hello.
    pub executors: usize,
    /// Monitors that are connected.
    pub monitors: usize,
    /// Events stored since the program began.
    pub events_stored: u64,
    /// Messages of executors refused since the program began.
    pub messages_refused: u64,
}

/// What only grows.
#[derive(Debug, Default)]
pub(super) struct Counters {
    events_stored: AtomicU64,
    messages_refused: AtomicU64,
}

impl Counters {
    /// An event was stored.
    pub(super) fn store(&self) {
        self.events_stored.fetch_add(1, Ordering::Relaxed);
    }

    /// A message was refused.
    pub(super) fn refuse(&self) {
        self.messages_refused.fetch_add(1, Ordering::Relaxed);
    }

    /// How many events were stored.
    pub(super) fn events_stored(&self) -> u64 {
        self.events_stored.load(Ordering::Relaxed)
    }

    /// How many messages were refused.
    pub(super) fn messages_refused(&self) -> u64 {
        self.messages_refused.load(Ordering::Relaxed)
    }
}
