//! On which scales a thing moves and trembles.

use serde::{Deserialize, Serialize};

use super::classes::{Classes, Sum, rounded};
use super::start_point;
use crate::parallel;
use crate::points::{Track, median, quantile, squared_distance};

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

/// What one track tells of the scales of its subset.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// How far all but the farthest twentieth of the frames get from the first; below zero when there is no frame.
    travel: f64,
    /// Squared second differences of neighboring frames.
    squares: Classes,
}

impl Tally {
    /// The tally of a track.
    ///
    /// # Complexity
    ///
    /// O(n x features + n log n) for n frames.
    pub fn of(track: &Track) -> Self {
        Self { travel: travel(track), squares: Classes::of(squared_second_differences(track)) }
    }
}

/// The scales of a subset from all its tracks; zeros when nothing moves.
///
/// # Complexity
///
/// That of a [`Tally`] for each track.
pub fn scales(tracks: &[Track]) -> Scales {
    let dimension = tracks.first().map_or(1, |track| track.points.dimension());
    let tallies = parallel::map(tracks.len(), |index| Tally::of(&tracks[index]));
    scales_of(dimension, tallies.iter())
}

/// The scales of a subset of `dimension` features from what each of its tracks tells; zeros when nothing moves.
///
/// The noise comes from second differences of neighboring frames, which vanish for smooth motion; of those the quietest
/// third stands for rest, compared with the same quantile of a chi-squared distribution (Wilson and Hilferty 1931).
///
/// Noise and travel are rounded to a few percent. They are estimates, no better than that, and rounded they are mostly the
/// same with one demonstration more or less: then everything that is seen of a track by them stays as it is.
///
/// # Complexity
///
/// O(T log F) for T tracks of F frames each.
pub fn scales_of<'a>(dimension: usize, tallies: impl Iterator<Item = &'a Tally> + Clone) -> Scales {
    let squares = Sum::of(tallies.clone().map(|tally| &tally.squares));
    // A second difference x1 - (x0 + x2) / 2 has 1.5 times the variance of x.
    let variance = squares.quantile(QUIET_QUANTILE) / (1.5 * chi_squared_quantile_30(dimension));
    let (noise, travel) = (variance.sqrt(), rounded(typical_travel(tallies)));
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

/// The 30% quantile of the chi-squared distribution with `dimension` degrees of freedom.
fn chi_squared_quantile_30(dimension: usize) -> f64 {
    let k = dimension.max(1) as f64;
    let root = 1.0 - 2.0 / (9.0 * k) - 0.5244 * (2.0 / (9.0 * k)).sqrt();
    k * root * root * root
}

/// The median of how far the thing gets in the tracks in which it is moved.
fn typical_travel<'a>(tallies: impl Iterator<Item = &'a Tally>) -> f64 {
    let mut travels: Vec<f64> = tallies.map(|tally| tally.travel).collect();
    let farthest = travels.iter().copied().fold(0.0, f64::max);
    travels.retain(|&travel| travel >= MOVED * farthest && travel >= 0.0);
    median(travels)
}

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
        fn one_more_of_many_alike_changes_no_scale(shakes in prop::collection::vec(-0.01..0.01, 3..40)) {
            let way = |shift: f64| {
                let there = [&[0.0; 20][..], &[1.0; 20]].concat();
                track(&there.iter().zip(shakes.iter().cycle()).map(|(x, shake)| x + shake * shift).collect::<Vec<_>>())
            };
            let many = vec![way(1.0); 200];
            let more = [&many[..], &[way(0.5)]].concat();
            let tallies: Vec<Tally> = more.iter().map(Tally::of).collect();
            prop_assert_eq!(scales_of(1, tallies.iter()), scales(&more));
            prop_assert_eq!(scales(&more).travel.to_bits(), scales(&many).travel.to_bits());
        }
    }
}
