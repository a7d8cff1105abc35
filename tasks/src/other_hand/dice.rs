//! The only source of chance.

use std::ops::RangeInclusive;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::point::Point;

/// Keeps these tasks apart from what other generators draw from the same seed.
const OTHER_HAND: u64 = 0x07e4_5a9d_c21b_3f68;

/// Seeded draws that come out the same on every machine.
pub(super) struct Dice(ChaCha8Rng);

impl Dice {
    pub(super) fn new(seed: u64) -> Self {
        Dice(ChaCha8Rng::seed_from_u64(seed.wrapping_add(OTHER_HAND)))
    }

    /// Uniform in `low..high`.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in a range given as a pair.
    pub(super) fn within(&mut self, range: (f64, f64)) -> f64 {
        self.between(range.0, range.1)
    }

    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    pub(super) fn count(&mut self, range: RangeInclusive<usize>) -> usize {
        let choices = range.end() - range.start() + 1;
        range.start() + (self.unit() * choices as f64) as usize
    }

    /// One of `choices`, which must not be empty.
    pub(super) fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.count(0..=choices.len() - 1)]
    }

    pub(super) fn shuffle<T>(&mut self, items: &mut [T]) {
        for end in (1..items.len()).rev() {
            items.swap(end, self.count(0..=end));
        }
    }

    /// Nearly Gaussian with deviation 1: a sum of twelve uniform draws, never beyond 6.
    pub(super) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.unit()).sum::<f64>() - 6.0
    }

    /// Independent axes with these deviations.
    pub(super) fn normal_point(&mut self, deviations: Point) -> Point {
        deviations.map(|deviation| deviation * self.normal())
    }

    /// A random direction of length 1; an axis of no freedom stays zero.
    pub(super) fn direction(&mut self, freedom: Point) -> Point {
        loop {
            let point = self.normal_point(freedom);
            let norm = point.iter().map(|value| value * value).sum::<f64>().sqrt();
            if norm > 0.1 {
                return point.map(|value| value / norm);
            }
        }
    }

    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }
}
