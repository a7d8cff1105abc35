//! The one source of chance.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A seeded stream of draws, the same on every machine.
pub(crate) struct Chance(ChaCha8Rng);

impl Chance {
    /// Streams of one seed are independent: a further demonstration changes none of the others.
    pub(crate) fn new(seed: u64, stream: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream);
        Self(generator)
    }

    /// Uniform in `0..1`, a multiple of 2^-53.
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between the two ends of the span.
    pub(crate) fn within(&mut self, (low, high): (f64, f64)) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Zero with this probability, else uniform between zero and `high`.
    pub(crate) fn zero_or_up_to(&mut self, zero_probability: f64, high: f64) -> f64 {
        if self.happens(zero_probability) { 0.0 } else { self.within((0.0, high)) }
    }

    /// A whole number from `low` to `high`, both included.
    pub(crate) fn whole(&mut self, low: usize, high: usize) -> usize {
        let span = high.saturating_sub(low) as u64 + 1;
        low + (self.0.next_u64() % span) as usize
    }

    pub(crate) fn happens(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// One of the choices, which must not be empty.
    pub(crate) fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.whole(0, choices.len() - 1)]
    }

    pub(crate) fn shuffle<T>(&mut self, items: &mut [T]) {
        for index in (1..items.len()).rev() {
            items.swap(index, self.whole(0, index));
        }
    }

    /// Standard normal but for the tails, which end at six: twelve uniforms less their mean.
    ///
    /// Needs no logarithm or cosine, whose last bit differs between machines.
    pub(crate) fn gaussian(&mut self) -> f64 {
        (0..12).map(|_| self.unit()).sum::<f64>() - 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaussian_has_mean_zero_and_variance_one() {
        let mut chance = Chance::new(7, 0);
        let draws: Vec<f64> = (0..20_000).map(|_| chance.gaussian()).collect();
        let mean = draws.iter().sum::<f64>() / 20_000.0;
        let variance = draws.iter().map(|draw| draw * draw).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 0.03, "{mean}");
        assert!((variance - 1.0).abs() < 0.05, "{variance}");
    }

    #[test]
    fn the_stream_of_a_seed_is_fixed_for_good() {
        let mut chance = Chance::new(1, 2);
        let draws: Vec<usize> = (0..6).map(|_| chance.whole(0, 99)).collect();
        assert_eq!(draws, [50, 53, 63, 45, 4, 81]);
    }
}
