//! How often one may ask.

use std::net::IpAddr;
use std::num::NonZeroU32;

use governor::{DefaultKeyedRateLimiter, Quota, RateLimiter};

/// Requests a second that one address may send for long.
const REQUESTS: NonZeroU32 = NonZeroU32::new(200).expect("not zero");
/// Requests that one address may send at once.
const REQUESTS_AT_ONCE: NonZeroU32 = NonZeroU32::new(2_000).expect("not zero");
/// Wrong tokens a second that one address may show for long.
const WRONG_TOKENS: NonZeroU32 = NonZeroU32::new(1).expect("not zero");
/// Wrong tokens that one address may show at once.
const WRONG_TOKENS_AT_ONCE: NonZeroU32 = NonZeroU32::new(20).expect("not zero");
/// So many addresses are remembered before those that have been quiet are forgotten.
const REMEMBERED: usize = 10_000;

/// Counts what each address sends.
pub(super) struct Rates {
    requests: DefaultKeyedRateLimiter<IpAddr>,
    wrong_tokens: DefaultKeyedRateLimiter<IpAddr>,
}

impl Rates {
    /// Nothing was sent yet.
    pub(super) fn new() -> Self {
        let quota = |rate, at_once| Quota::per_second(rate).allow_burst(at_once);
        Self {
            requests: RateLimiter::keyed(quota(REQUESTS, REQUESTS_AT_ONCE)),
            wrong_tokens: RateLimiter::keyed(quota(WRONG_TOKENS, WRONG_TOKENS_AT_ONCE)),
        }
    }

    /// Counts a request; whether it may be answered.
    pub(super) fn take_request(&self, address: IpAddr) -> bool {
        allowed(&self.requests, address)
    }

    /// Counts a wrong token; whether another may be tried.
    pub(super) fn take_wrong_token(&self, address: IpAddr) -> bool {
        allowed(&self.wrong_tokens, address)
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
        let taken = (0..1_000).filter(|_| rates.take_wrong_token(one)).count();
        assert!((20..500).contains(&taken), "{taken}");
        assert!(rates.take_wrong_token(other));
    }
}
