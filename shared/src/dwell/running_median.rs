//! The median of numbers that become more.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The lower and the upper half of the numbers so far: [`median`](crate::points::median) is between them.
///
/// # Complexity
///
/// O(log n) for each number.
#[derive(Clone, Debug, Default)]
pub(super) struct RunningMedian {
    /// As large as the other, or one smaller.
    lower: BinaryHeap<Ordered>,
    upper: BinaryHeap<Reverse<Ordered>>,
}

impl RunningMedian {
    pub(super) fn add(&mut self, number: f64) {
        self.lower.push(Ordered(number));
        let largest = self.lower.pop();
        self.upper.extend(largest.map(Reverse));
        if self.upper.len() > self.lower.len() + 1 {
            let smallest = self.upper.pop();
            self.lower.extend(smallest.map(|Reverse(number)| number));
        }
    }

    /// Zero when there are none.
    pub(super) fn median(&self) -> f64 {
        let upper = self.upper.peek().map_or(0.0, |&Reverse(Ordered(number))| number);
        let lower = self.lower.peek().filter(|_| self.lower.len() == self.upper.len());
        lower.map_or(upper, |&Ordered(lower)| f64::midpoint(lower, upper))
    }
}

/// A number in the total order of numbers.
#[derive(Clone, Copy, Debug)]
struct Ordered(f64);

impl Ord for Ordered {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Ordered {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ordered {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Ordered {}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::median;

    proptest! {
        #[test]
        fn it_is_the_median_after_each_number(
            numbers in prop::collection::vec(prop_oneof![-1.0..1.0, Just(0.0), Just(-0.0), Just(0.5)], 0..60),
        ) {
            let mut running = RunningMedian::default();
            prop_assert_eq!(running.median().to_bits(), 0);
            for count in 1..=numbers.len() {
                running.add(numbers[count - 1]);
                prop_assert_eq!(running.median().to_bits(), median(numbers[..count].to_vec()).to_bits());
            }
        }
    }
}
