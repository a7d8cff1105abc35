//! How often one may ask.

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::num::NonZeroU32;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use governor::{DefaultKeyedRateLimiter, Quota, RateLimiter};

/// Requests a second that one address may send for long.
const REQUESTS: NonZeroU32 = NonZeroU32::new(200).expect("not zero");
/// Requests that one address may send at once.
const REQUESTS_AT_ONCE: NonZeroU32 = NonZeroU32::new(2_000).expect("not zero");
/// Wrong tokens a second that one address may show for long.
const WRONG_TOKENS: NonZeroU32 = NonZeroU32::new(1).expect("not zero");
/// Wrong tokens that one address may show at once.
const WRONG_TOKENS_AT_ONCE: NonZeroU32 = NonZeroU32::new(20).expect("not zero");
/// How long an address waits that showed more.
const WAIT: Duration = Duration::from_secs(2);
/// So many addresses are remembered before those that have been quiet are forgotten.
const REMEMBERED: usize = 10_000;

/// Counts what each address sends.
pub(super) struct Rates {
    requests: DefaultKeyedRateLimiter<IpAddr>,
    wrong_tokens: DefaultKeyedRateLimiter<IpAddr>,
    /// Until when an address that showed too many wrong tokens is not listened to.
    waiting: Mutex<BTreeMap<IpAddr, Instant>>,
}

impl Rates {
    /// Nothing was sent yet.
    pub(super) fn new() -> Self {
        let quota = |rate, at_once| Quota::per_second(rate).allow_burst(at_once);
        Self {
            requests: RateLimiter::keyed(quota(REQUESTS, REQUESTS_AT_ONCE)),
            wrong_tokens: RateLimiter::keyed(quota(WRONG_TOKENS, WRONG_TOKENS_AT_ONCE)),
            waiting: Mutex::default(),
        }
    }

    /// Counts a request; whether it may be answered.
    pub(super) fn take_request(&self, address: IpAddr) -> bool {
        allowed(&self.requests, address)
    }

    /// Counts a wrong token.
    pub(super) fn count_wrong_token(&self, address: IpAddr) {
        if !allowed(&self.wrong_tokens, address) {
            let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
            if waiting.len() >= REMEMBERED {
                waiting.retain(|_, until| *until > Instant::now());
            }
            waiting.insert(address, Instant::now() + WAIT);
        }
    }

    /// Whether the address showed too many wrong tokens just now: what it shows is not even looked at, as that takes time.
    pub(super) fn must_wait(&self, address: IpAddr) -> bool {
        let waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.get(&address).is_some_and(|until| *until > Instant::now())
    }
}

fn allowed(limiter: &DefaultKeyedRateLimiter<IpAddr>, address: IpAddr) -> bool {
    if limiter.len() > REMEMBERED {
        limiter.retain_recent();
    }
    limiter.check_key(&address).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_address_is_bounded_and_another_is_not() {
        let rates = Rates::new();
        let [one, other] = [[10, 0, 0, 1], [10, 0, 0, 2]].map(IpAddr::from);
        let counted =
            (0..1_000).take_while(|_| !rates.must_wait(one)).map(|_| rates.count_wrong_token(one)).count();
        assert!((20..500).contains(&counted), "{counted}");
        assert!(!rates.must_wait(other));
    }
}
