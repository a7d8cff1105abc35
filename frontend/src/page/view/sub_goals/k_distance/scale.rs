//! The scale of epsilon: from numbers to heights and back.

use crate::protocol::KDistanceCurve;

/// So many decades are shown at most: nobody looks for an epsilon far below all distances but a few.
const DECADES: f64 = 6.0;
/// From this ratio of its ends on a scale is logarithmic.
const WIDE: f64 = 20.0;
/// So many steps lead from one end to the other.
const STEPS: f64 = 100.0;

/// Which epsilon is at which height: 0 at the bottom, 1 at the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    low: f64,
    high: f64,
    is_logarithmic: bool,
}

impl Scale {
    /// A scale with room for the distances of `curve`, for an epsilon that makes everything one cluster, and for
    /// `epsilon`, which is above 0.
    pub(super) fn new(curve: &KDistanceCurve, epsilon: f64) -> Self {
        let largest = curve.distances.last().copied().unwrap_or(0.0);
        let high = curve.extent.max(largest).max(epsilon);
        let least = high / 10_f64.powf(DECADES);
        let smallest = curve.distances.iter().copied().find(|&distance| distance >= least);
        let low = smallest.unwrap_or(high / 10.0).min(epsilon);
        // Something is left to drag where all that is known is one number.
        let (low, high) = (low / 1.25, high * 1.25);
        Self { low, high, is_logarithmic: high / low >= WIDE }
    }

    /// The smallest and the largest epsilon.
    pub(super) fn ends(self) -> (f64, f64) {
        (readable(self.low), readable(self.high))
    }

    /// Whether equal heights are equal ratios.
    pub(super) fn is_logarithmic(self) -> bool {
        self.is_logarithmic
    }

    /// The height of a value; what is below or above the scale is at its end.
    pub(super) fn height(self, value: f64) -> f64 {
        let height = if self.is_logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        // Zero has no logarithm, and lies at the bottom.
        height.clamp(0.0, 1.0)
    }

    /// The value at a height, as a number that people can read.
    pub(super) fn value(self, height: f64) -> f64 {
        let height = height.clamp(0.0, 1.0);
        readable(if self.is_logarithmic {
            self.low * (self.high / self.low).powf(height)
        } else {
            self.low + (self.high - self.low) * height
        })
    }

    /// The value some steps above `value`, or below it.
    pub(super) fn step(self, value: f64, steps: f64) -> f64 {
        let times = |times: f64| self.value(self.height(value) + times * steps / STEPS);
        // A small step may be rounded away.
        let next = times(1.0);
        if next.total_cmp(&value).is_eq() { times(2.0) } else { next }
    }

    /// Round values to write beside the scale, from below.
    pub(super) fn ticks(self) -> Vec<f64> {
        if !self.is_logarithmic {
            let step = crate::page::geometry::round_length(self.high - self.low);
            let first = (self.low / step).ceil();
            return (0..10)
                .map(|number| readable((first + f64::from(number)) * step))
                .filter(|&it| self.holds(it))
                .collect();
        }
        let decades = (self.high / self.low).log10();
        let digits: &[f64] = if decades > 2.5 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let first = self.low.log10().floor() as i32;
        let powers = (first..=first + decades.ceil() as i32).map(|power| 10_f64.powi(power));
        let values = powers.flat_map(|power| digits.iter().map(move |digit| readable(digit * power)));
        values.filter(|&it| self.holds(it)).collect()
    }

    fn holds(self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

/// The number with three significant digits that is nearest to `value`: nobody reads more.
fn readable(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(distances: &[f64], extent: f64, epsilon: f64) -> Scale {
        Scale::new(
            &KDistanceCurve { distances: distances.to_vec(), points: distances.len(), extent },
            epsilon,
        )
    }

    #[test]
    fn a_wide_scale_is_logarithmic_and_has_room_for_everything() {
        let scale = scale(&[0.0, 0.001, 0.002, 0.1], 0.5, 0.01);
        assert!(scale.is_logarithmic());
        assert_eq!(scale.ends(), (0.0008, 0.625));
        assert_eq!(scale.ticks(), [0.001, 0.01, 0.1]);
        assert_eq!((scale.height(0.0), scale.height(7.0)), (0.0, 1.0));
    }

    #[test]
    fn a_narrow_scale_is_linear() {
        let scale = scale(&[2.0, 3.0, 4.0], 5.0, 3.0);
        assert!(!scale.is_logarithmic());
        assert_eq!(scale.ends(), (1.6, 6.25));
        assert_eq!(scale.ticks(), [2.0, 3.0, 4.0, 5.0, 6.0]);
    }

    #[test]
    fn heights_lead_back_to_values_of_three_digits() {
        for scale in [scale(&[0.001, 0.1], 0.5, 0.01), scale(&[2.0, 4.0], 5.0, 3.0)] {
            for value in [2.5, 3.25, 0.012] {
                if scale.holds(value) {
                    assert_eq!(scale.value(scale.height(value)).to_string(), value.to_string());
                }
            }
        }
    }

    #[test]
    fn steps_up_and_down_lead_from_end_to_end() {
        let scale = scale(&[0.001, 0.1], 0.5, 0.01);
        let mut value = scale.ends().0;
        for _ in 0..110 {
            let next = scale.step(value, 1.0);
            assert!(next >= value);
            value = next;
        }
        assert_eq!(value.to_string(), scale.ends().1.to_string());
        assert_eq!(scale.step(value, -1000.0).to_string(), scale.ends().0.to_string());
    }

    #[test]
    fn points_that_all_lie_in_one_place_have_a_scale_as_well() {
        let scale = scale(&[0.0, 0.0], 0.0, 0.000_001);
        let (low, high) = scale.ends();
        assert!(low > 0.0 && low < 0.000_001 && high > 0.000_001);
    }
}
