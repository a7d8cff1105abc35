//! How long to wait before the next attempt to connect.

use std::time::Duration;

const FIRST: Duration = Duration::from_millis(250);
const LONGEST: Duration = Duration::from_secs(10);

/// Waits that double up to ten seconds, each cut by chance to between half and all of it: a thousand executors that lost
/// the same server do not come back in the same moment.
#[derive(Clone, Debug, Default)]
pub(super) struct Backoff {
    attempts: u32,
}

impl Backoff {
    /// How long to wait now; `chance` is any number at random.
    pub(super) fn next(&mut self, chance: u64) -> Duration {
        let whole = FIRST.saturating_mul(1 << self.attempts.min(16)).min(LONGEST);
        self.attempts = self.attempts.saturating_add(1);
        let half = whole / 2;
        half + half.mul_f64((chance % 1000) as f64 / 1000.0)
    }

    /// The connection stood: the next wait is the shortest again.
    pub(super) fn reset(&mut self) {
        self.attempts = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waits_double_up_to_a_limit_and_chance_shortens_them_by_half_at_most() {
        let waits = |chance| {
            let mut backoff = Backoff::default();
            let mut waits: Vec<u128> = (0..8).map(|_| backoff.next(chance).as_millis()).collect();
            backoff.reset();
            waits.push(backoff.next(chance).as_millis());
            waits
        };
        assert_eq!(waits(0), [125, 250, 500, 1000, 2000, 4000, 5000, 5000, 125]);
        assert_eq!(waits(500), [187, 375, 750, 1500, 3000, 6000, 7500, 7500, 187]);
    }
}
