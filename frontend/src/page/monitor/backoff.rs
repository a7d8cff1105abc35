//! How long to wait before the next attempt.

use std::time::Duration;

/// The first wait, in milliseconds.
const FIRST_MS: f64 = 500.0;
/// The longest, in milliseconds.
const LONGEST_MS: f64 = 15_000.0;

/// Waits that double up to a limit, each shortened by chance so that many pages do not come back at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Backoff {
    delay_ms: f64,
}

impl Backoff {
    /// Before the first attempt.
    pub(super) fn new() -> Self {
        Self { delay_ms: FIRST_MS }
    }

    /// The next wait; `chance` is from 0 to 1.
    pub(super) fn next_delay(&mut self, chance: f64) -> Duration {
        let delay_ms = self.delay_ms * (1.0 - 0.5 * chance);
        self.delay_ms = (2.0 * self.delay_ms).min(LONGEST_MS);
        Duration::from_millis(delay_ms as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waits_double_up_to_a_limit() {
        let mut backoff = Backoff::new();
        let waits: Vec<u128> = (0..7).map(|_| backoff.next_delay(0.0).as_millis()).collect();
        assert_eq!(waits, [500, 1000, 2000, 4000, 8000, 15_000, 15_000]);
    }

    #[test]
    fn chance_shortens_a_wait_by_half_at_most() {
        assert_eq!(Backoff::new().next_delay(1.0).as_millis(), 250);
    }
}
