//! On which scales a thing moves and trembles.

use serde::{Deserialize, Serialize};

use super::start_point;
use crate::parallel;
use crate::points::{Track, median, quantile, quantile_rank, squared_distance};

/// The scales on which a subset moves and trembles, in the unit of its features.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scales {
    /// Standard deviation of the sensor noise in one feature.
    pub noise: f64,
    /// How far the thing typically gets from where it was first observed, when it is moved at all.
    pub travel: f64,
    /// Within this distance of a dwell's center a thing counts as still.
    pub stillness: f64,
}

impl Scales {
    /// How far the bulk of a dwell's partial states are from its center.
    pub fn heap_radius(&self, dimension: usize) -> f64 {
        (self.noise * ((dimension as f64).sqrt() + 1.5)).max(0.3 * self.stillness)
    }
}

/// Share of the noisiest frames that the noise estimate does not look at: those in which the thing moves.
const QUIET_QUANTILE: f64 = 0.3;

/// A thing is still within this share of its travel, however quiet the sensor is.
const STILL_SHARE_OF_TRAVEL: f64 = 0.012;

/// A track that gets less far than this share of the farthest is one in which the thing was left where it was.
const MOVED: f64 = 0.1;

/// The scales of a subset from all its tracks; zeros when nothing moves.
///
/// The noise comes from second differences of neighboring frames, which vanish for smooth motion; of those the quietest
/// third stands for rest, compared with the same quantile of a chi-squared distribution (Wilson and Hilferty 1931).
///
/// # Complexity
///
/// O(frames x features).
pub fn scales(tracks: &[Track]) -> Scales {
    let dimension = tracks.first().map_or(1, |track| track.points.dimension());
    let squares = || tracks.iter().flat_map(squared_second_differences);
    // A second difference x1 - (x0 + x2) / 2 has 1.5 times the variance of x.
    let variance = quantile_of_squares(squares, QUIET_QUANTILE) / (1.5 * chi_squared_quantile_30(dimension));
    let (noise, travel) = (variance.sqrt(), typical_travel(tracks));
    let reach = noise * ((dimension as f64).sqrt() + 3.2);
    Scales { noise, travel, stillness: reach.max(STILL_SHARE_OF_TRAVEL * travel) }
}

fn squared_second_differences(track: &Track) -> impl Iterator<Item = f64> {
    let dimension = track.points.dimension().max(1);
    track.points.coordinates().windows(3 * dimension).step_by(dimension).map(move |triple| {
        let (before, rest) = triple.split_at(dimension);
        let (now, after) = rest.split_at(dimension);
        let axes = before.iter().zip(now).zip(after);
        axes.map(|((b, n), a)| n - f64::midpoint(*b, *a)).map(|difference| difference * difference).sum()
    })
}

/// The [`quantile`] of what `squares` yields, the same each time and not below zero. They are never held all at once:
/// one pass counts how many are about as large, a second collects those about as large as the quantile.
fn quantile_of_squares<I: Iterator<Item = f64>>(squares: impl Fn() -> I, share: f64) -> f64 {
    // The exponent and the two first binary digits: numbers above zero are ordered as their bits.
    let class = |square: f64| (square.to_bits() << 1 >> 51) as usize;
    let mut counts = vec![0_usize; 1 << 13];
    squares().for_each(|square| counts[class(square)] += 1);
    let total: usize = counts.iter().sum();
    if total == 0 {
        return 0.0;
    }
    let mut rank = quantile_rank(total, share);
    let mut wanted = 0;
    while rank >= counts[wanted] {
        rank -= counts[wanted];
        wanted += 1;
    }
    let mut alike = Vec::with_capacity(counts[wanted]);
    alike.extend(squares().filter(|&square| class(square) == wanted));
    *alike.select_nth_unstable_by(rank, f64::total_cmp).1
}

/// The 30% quantile of the chi-squared distribution with `dimension` degrees of freedom.
fn chi_squared_quantile_30(dimension: usize) -> f64 {
    let k = dimension.max(1) as f64;
    let root = 1.0 - 2.0 / (9.0 * k) - 0.5244 * (2.0 / (9.0 * k)).sqrt();
    k * root * root * root
}

/// The median of how far the thing gets in the tracks in which it is moved.
fn typical_travel(tracks: &[Track]) -> f64 {
    let mut travels = parallel::map(tracks.len(), |index| travel(&tracks[index]));
    let farthest = travels.iter().copied().fold(0.0, f64::max);
    travels.retain(|&travel| travel >= MOVED * farthest && travel >= 0.0);
    median(travels)
}

/// How far all but the farthest twentieth of the frames get from the first; below zero when there is no frame.
fn travel(track: &Track) -> f64 {
    if track.is_empty() {
        return -1.0;
    }
    let start = start_point(track);
    // The square root keeps the order, so one is enough.
    quantile(track.points.iter().map(|point| squared_distance(point, &start)).collect(), 0.95).sqrt()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::tests::track;
    use super::*;

    #[test]
    fn what_never_moves_has_no_scales() {
        let still = [track(&[0.5; 20]), track(&[])];
        assert_eq!(scales(&still), Scales { noise: 0.0, travel: 0.0, stillness: 0.0 });
        assert_eq!(scales(&[]), Scales { noise: 0.0, travel: 0.0, stillness: 0.0 });
    }

    #[test]
    fn the_travel_of_a_thing_that_is_seldom_moved_is_that_of_its_moves() {
        let tracks = [track(&[0.0; 20]), track(&[&[0.0; 10][..], &[1.0; 10]].concat()), track(&[0.1; 20])];
        assert!((scales(&tracks).travel - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_travel_does_not_count_one_wild_detection() {
        let mut x = [&[0.0; 20][..], &[1.0; 20]].concat();
        (x[1], x[30]) = (7.0, 9.0);
        assert!((scales(&[track(&x)]).travel - 1.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn a_quantile_in_two_passes_is_the_quantile(
            squares in prop::collection::vec(prop_oneof![0.0..1e-4, 0.0..1e3, Just(0.0), Just(0.25), Just(1e200)], 0..60),
            share in 0.0..=1.0,
        ) {
            let found = quantile_of_squares(|| squares.iter().copied(), share);
            prop_assert_eq!(found.to_bits(), quantile(squares.clone(), share).to_bits());
        }
    }
}
