//! Numbers told apart to a tenth, and how many there are of each: what many of them show together is seldom changed by one
//! more.

use crate::points::quantile_rank;

/// Numbers in a class have the same exponent and, once rounded, the same three binary digits.
const SHIFT: u32 = 49;

/// How many classes there are: those of numbers that are not negative, infinity and what is none included.
const CLASSES: usize = 1 << 14;

/// The class of a number; its sign does not count.
fn class(number: f64) -> u16 {
    ((number.abs().to_bits() + (1 << (SHIFT - 1))) >> SHIFT) as u16
}

/// The number in the middle of a class: zero, or at most a sixteenth away from all others.
fn middle(class: u16) -> f64 {
    f64::from_bits(u64::from(class) << SHIFT)
}

/// The `number`, not negative, rounded to three binary digits behind the first.
pub(super) fn rounded(number: f64) -> f64 {
    middle(class(number))
}

/// How many numbers there are in each class.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Classes(Vec<(u16, u32)>);

impl Classes {
    /// Those of `numbers` that are not negative.
    ///
    /// # Complexity
    ///
    /// O(n log n).
    pub(super) fn of(numbers: impl Iterator<Item = f64>) -> Self {
        let mut classes: Vec<u16> = numbers.map(class).collect();
        classes.sort_unstable();
        let counted = |alike: &[u16]| (alike[0], alike.len() as u32);
        Self(classes.chunk_by(|a, b| a == b).map(counted).collect())
    }
}

/// How many numbers there are in each class of many [`Classes`].
pub(super) struct Sum {
    counts: Vec<usize>,
    total: usize,
}

impl Sum {
    pub(super) fn of<'a>(all: impl Iterator<Item = &'a Classes>) -> Self {
        let mut sum = Self { counts: vec![0; CLASSES], total: 0 };
        for &(class, count) in all.flat_map(|classes| &classes.0) {
            sum.counts[usize::from(class)] += count as usize;
            sum.total += count as usize;
        }
        sum
    }

    /// How many numbers there are.
    pub(super) fn total(&self) -> usize {
        self.total
    }

    /// The [`quantile`](crate::points::quantile) of all numbers, rounded; zero when there are none.
    pub(super) fn quantile(&self, share: f64) -> f64 {
        if self.total == 0 {
            return 0.0;
        }
        let rank = quantile_rank(self.total, share);
        let mut passed = 0;
        let is_reached = |count: &usize| {
            passed += count;
            passed > rank
        };
        middle(self.counts.iter().position(is_reached).unwrap_or(0) as u16)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::quantile;

    #[test]
    fn a_number_is_rounded_to_the_nearest_of_eight_to_the_octave() {
        for (number, expected) in [(0.0, 0.0), (1.06, 1.0), (1.07, 1.125), (1.95, 2.0), (1e-3, 1.0 / 1024.0)]
        {
            assert_eq!(rounded(number).to_bits(), f64::to_bits(expected), "{number}");
        }
        assert!(rounded(f64::INFINITY).is_infinite());
    }

    proptest! {
        #[test]
        fn rounding_keeps_the_order_and_nearly_the_size(a in 0.0..1e9, b in 1e-300..1e-3) {
            for x in [a, b] {
                prop_assert!((rounded(x) - x).abs() <= x / 16.0);
                prop_assert_eq!(rounded(rounded(x)).to_bits(), rounded(x).to_bits());
            }
            prop_assert!((a <= b) == (rounded(a) <= rounded(b)) || rounded(a).to_bits() == rounded(b).to_bits());
        }

        #[test]
        fn the_quantile_of_classes_is_that_of_all_numbers_rounded(
            parts in prop::collection::vec(
                prop::collection::vec(prop_oneof![0.0..1e-4, 0.0..1e3, Just(0.0), Just(1e200)], 0..20),
                0..4,
            ),
            share in 0.0..=1.0,
        ) {
            let classes: Vec<Classes> = parts.iter().map(|part| Classes::of(part.iter().copied())).collect();
            let sum = Sum::of(classes.iter());
            prop_assert_eq!(sum.total(), parts.concat().len());
            prop_assert_eq!(sum.quantile(share).to_bits(), rounded(quantile(parts.concat(), share)).to_bits());
        }
    }
}
