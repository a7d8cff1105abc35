//! How much the relay takes on.

use std::num::NonZeroU32;
use std::time::Duration;

use goalgraph::protocol::executor::MAX_MESSAGE_BYTES;

/// Bounds of everything that somebody on the other end of a connection could make grow, and how long the relay waits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RelayLimits {
    /// The most executors connected at a time.
    pub executors: usize,
    /// The most monitors connected at a time.
    pub monitors: usize,
    /// Longest message of an executor, in bytes.
    pub message_bytes: usize,
    /// How many messages a second are taken of one executor in the long run.
    pub messages_per_second: NonZeroU32,
    /// How many messages of one executor are taken at once after a quiet time.
    pub burst: NonZeroU32,
    /// How often an executor may send more than that before its connection ends.
    pub strikes: u32,
    /// How many events of one connection may wait for the store; the next is read when one of them is answered.
    pub in_flight: usize,
    /// How many bytes of events may wait for the store, of all connections together.
    pub queue_bytes: usize,
    /// How many runs one executor may hold at a time.
    pub leases: usize,
    /// How many events a run may have, its last not counted.
    pub events_per_run: u64,
    /// How many runs that are not over are kept in memory without a lease; older ones are read again when they go on.
    pub idle_runs: usize,
    /// How many runs that are over a monitor is shown.
    pub finished_runs: usize,
    /// How long an executor may be silent before its leases end.
    pub lease: Duration,
    /// How often an executor is asked to send a heartbeat, and how often the server pings.
    pub heartbeat: Duration,
    /// How long one message may take to be sent before the connection is dropped.
    pub send: Duration,
    /// The shortest time between two messages to a monitor.
    pub monitor_pause: Duration,
}

impl Default for RelayLimits {
    fn default() -> Self {
        Self {
            executors: 4096,
            monitors: 256,
            message_bytes: MAX_MESSAGE_BYTES,
            messages_per_second: NonZeroU32::MIN.saturating_add(999),
            burst: NonZeroU32::MIN.saturating_add(3999),
            strikes: 100,
            in_flight: 64,
            queue_bytes: 32 * 1024 * 1024,
            leases: 8,
            events_per_run: 100_000,
            idle_runs: 1000,
            finished_runs: 50,
            lease: Duration::from_secs(15),
            heartbeat: Duration::from_secs(5),
            send: Duration::from_secs(10),
            monitor_pause: Duration::from_millis(20),
        }
    }
}
