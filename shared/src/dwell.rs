//! Where a thing stays still: dwells in the track of a feature subset.

use serde::{Deserialize, Serialize};

use crate::points::{Points, Track, distance, median, median_point, quantile, squared_distance};

/// A stretch of a track in which the partial state stays at one place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dwell {
    /// Positions in the track of the first observed frame and of the one after the last.
    pub span: std::ops::Range<usize>,
    /// Median of its partial states.
    pub center: Vec<f64>,
}

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
pub fn scales<'a>(tracks: impl Iterator<Item = &'a Track> + Clone) -> Scales {
    let dimension = tracks.clone().map(|track| track.points.dimension()).next().unwrap_or(1);
    let squares = tracks.clone().flat_map(|track| squared_second_differences(&track.points)).collect();
    // A second difference x1 - (x0 + x2) / 2 has 1.5 times the variance of x.
    let variance = quantile(squares, QUIET_QUANTILE) / (1.5 * chi_squared_quantile_30(dimension));
    let (noise, travel) = (variance.sqrt(), typical_travel(tracks));
    let reach = noise * ((dimension as f64).sqrt() + 3.2);
    Scales { noise, travel, stillness: reach.max(STILL_SHARE_OF_TRAVEL * travel) }
}

fn squared_second_differences(points: &Points) -> Vec<f64> {
    let triples = (2..points.len()).map(|index| [index - 2, index - 1, index].map(|at| points.point(at)));
    triples
        .map(|[before, now, after]| {
            let axes = before.iter().zip(now).zip(after);
            axes.map(|((b, n), a)| n - f64::midpoint(*b, *a)).map(|difference| difference * difference).sum()
        })
        .collect()
}

/// The 30% quantile of the chi-squared distribution with `dimension` degrees of freedom.
fn chi_squared_quantile_30(dimension: usize) -> f64 {
    let k = dimension.max(1) as f64;
    let root = 1.0 - 2.0 / (9.0 * k) - 0.5244 * (2.0 / (9.0 * k)).sqrt();
    k * root * root * root
}

/// The median of how far the thing gets in the tracks in which it is moved.
fn typical_travel<'a>(tracks: impl Iterator<Item = &'a Track>) -> f64 {
    let mut travels: Vec<f64> = tracks.filter(|track| !track.is_empty()).map(travel).collect();
    let farthest = travels.iter().copied().fold(0.0, f64::max);
    travels.retain(|&travel| travel >= MOVED * farthest);
    median(travels)
}

/// How far all but the farthest twentieth of the frames get from the first.
fn travel(track: &Track) -> f64 {
    let start = start_point(track);
    quantile(track.points.iter().map(|point| distance(point, &start)).collect(), 0.95)
}

/// Where a track starts: the median of its first three observed frames, so that one wild detection does not count.
/// Empty for an empty track.
pub fn start_point(track: &Track) -> Vec<f64> {
    if track.is_empty() {
        return Vec::new();
    }
    median_point(track.points.dimension(), &track.points.iter().take(3))
}

/// How many frames in a row may be wild detections without ending a dwell.
const WILD_FRAMES: usize = 2;

/// The dwells of a track in the order of time: stretches of at least `min_dwell` observed frames within
/// [`Scales::stillness`] of their center that drift less than a slow passage through that ball would.
///
/// Single wild detections do not interrupt a dwell; neighboring stretches at one place are one dwell.
///
/// # Complexity
///
/// O(frames x features) where things rest; a dwell is grown frame by frame from its first.
pub fn dwells(track: &Track, scales: Scales, min_dwell: usize) -> Vec<Dwell> {
    let mut dwells: Vec<Dwell> = Vec::new();
    let mut start = 0;
    while start < track.len() {
        let end = grow(track, start, scales.stillness);
        if let Some(dwell) = dwell_of(track, start..end, scales, min_dwell) {
            start = dwell.span.end;
            join_or_push(&mut dwells, dwell, track, scales);
        } else {
            start += 1;
        }
    }
    dwells
}

/// The end of the stretch that starts at `start` and stays within `stillness` of its running mean.
fn grow(track: &Track, start: usize, stillness: f64) -> usize {
    let mut center = track.points.point(start).to_vec();
    let mut count = 1.0;
    let mut end = start + 1;
    while end < track.len() {
        let is_near =
            |index: usize| index < track.len() && distance(track.points.point(index), &center) <= stillness;
        let Some(next) = (end..=end + WILD_FRAMES).find(|&index| is_near(index)) else {
            break;
        };
        count += 1.0;
        for (mean, x) in center.iter_mut().zip(track.points.point(next)) {
            *mean += (x - *mean) / count;
        }
        end = next + 1;
    }
    end
}

/// The dwell over `span`, when it is long enough and does not drift.
fn dwell_of(track: &Track, span: std::ops::Range<usize>, scales: Scales, min_dwell: usize) -> Option<Dwell> {
    if span.len() < min_dwell.max(1) {
        return None;
    }
    let center = center(track, span.clone());
    let middle = span.start + span.len() / 2;
    let drift = match span.len() {
        0 | 1 => 0.0,
        _ => {
            let halves = [span.start..middle, middle..span.end].map(|half| self::center(track, half));
            distance(&halves[0], &halves[1])
        }
    };
    // A passage at constant speed through the whole ball drifts by its radius.
    (drift <= 0.6 * scales.stillness).then_some(Dwell { span, center })
}

fn center(track: &Track, span: std::ops::Range<usize>) -> Vec<f64> {
    median_point(track.points.dimension(), &span.map(|index| track.points.point(index)))
}

/// Adds `dwell`, or lengthens the last one when it is at the same place.
fn join_or_push(dwells: &mut Vec<Dwell>, dwell: Dwell, track: &Track, scales: Scales) {
    if let Some(last) = dwells.last_mut()
        && squared_distance(&last.center, &dwell.center) <= scales.stillness * scales.stillness
    {
        last.span.end = dwell.span.end;
        last.center = center(track, last.span.clone());
    } else {
        dwells.push(dwell);
    }
}

/// Shortest dwell in frames.
const SHORTEST_DWELL: usize = 3;

/// For how many observed frames a thing stays at one place at least: clearly longer than a passage through that place at
/// the usual speed takes, and at least three.
///
/// # Complexity
///
/// O(frames x features).
pub fn min_dwell(tracks: &[Track], scales: Scales) -> usize {
    let Some(speed) = usual_speed(tracks, scales) else {
        return SHORTEST_DWELL;
    };
    SHORTEST_DWELL.max((5.0 * scales.stillness / speed) as usize)
}

/// How far a moving thing usually gets in a frame, measured over as few frames as the noise allows.
fn usual_speed(tracks: &[Track], scales: Scales) -> Option<f64> {
    for frames in [1, 2, 4, 8, 16, 32, 64] {
        let moves: Vec<f64> = tracks
            .iter()
            .flat_map(|track| {
                let pairs = (frames..track.len()).map(|index| (index - frames, index));
                let seen = pairs.filter(|&(from, to)| track.frames[to] - track.frames[from] == frames);
                seen.map(|(from, to)| distance(track.points.point(from), track.points.point(to)))
            })
            .collect();
        let moving: Vec<f64> =
            moves.iter().copied().filter(|&moved| moved > 2.0 * scales.stillness).collect();
        if 20 * moving.len() > moves.len() {
            return Some(median(moving) / frames as f64);
        }
    }
    None
}

/// A track without its [wild detections](wild_detections).
///
/// # Complexity
///
/// O(frames x features).
pub fn without_wild_detections(track: &Track, scales: Scales) -> Track {
    track.clone().without(&wild_detections(track, scales))
}

/// The positions in `track` at which the thing was seen far from where it was shortly before and after, ascending.
///
/// A frame is wild when it is far from the median of the five around it, compared with how far those are from it
/// (Hampel's identifier, 1974).
///
/// # Complexity
///
/// O(frames x features).
pub fn wild_detections(track: &Track, scales: Scales) -> Vec<usize> {
    const WINDOW: usize = 5;
    if track.len() < WINDOW {
        return Vec::new();
    }
    let dimension = track.points.dimension();
    let is_wild = |&index: &usize| {
        let first = index.saturating_sub(WINDOW / 2).min(track.len() - WINDOW);
        let around = (first..first + WINDOW).map(|at| track.points.point(at));
        let center = median_point(dimension, &around);
        let spread = median(around.map(|point| distance(point, &center)).collect());
        let from_center = distance(track.points.point(index), &center);
        from_center > 4.0 * spread + 2.0 * scales.stillness
    };
    (0..track.len()).filter(is_wild).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALES: Scales = Scales { noise: 0.001, travel: 1.0, stillness: 0.01 };

    fn track(x: &[f64]) -> Track {
        Track { frames: (0..x.len()).collect(), points: Points::from_rows(1, x.to_vec()) }
    }

    /// Start and end of each dwell.
    fn spans(x: &[f64], min_dwell: usize) -> Vec<[usize; 2]> {
        dwells(&track(x), SCALES, min_dwell).into_iter().map(|it| [it.span.start, it.span.end]).collect()
    }

    #[test]
    fn stretches_at_one_place_are_dwells() {
        let x = [0.0, 0.001, 0.0, 0.3, 0.6, 1.0, 1.001, 1.0, 0.999];
        assert_eq!(spans(&x, 3), [[0, 3], [5, 9]]);
        assert_eq!(spans(&x, 4), [[5, 9]]);
        assert_eq!(spans(&[], 3), [[0; 2]; 0]);
    }

    #[test]
    fn a_slow_passage_is_no_dwell() {
        let x: Vec<f64> = (0..40).map(|index| 0.004 * f64::from(index)).collect();
        assert_eq!(spans(&x, 4), [[0; 2]; 0]);
    }

    #[test]
    fn a_wild_detection_does_not_end_a_dwell() {
        assert_eq!(spans(&[0.0, 0.0, 0.0, 0.7, 0.0, 0.0, 0.0], 3), [[0, 7]]);
    }

    #[test]
    fn wild_detections_are_left_out_and_moves_are_not() {
        let x = [0.0, 0.0, 0.0, 0.7, 0.0, 0.0, 0.1, 0.2, 0.3, 0.4, 0.4, 0.4];
        let clean = without_wild_detections(&track(&x), SCALES);
        assert_eq!(clean.frames, [0, 1, 2, 4, 5, 6, 7, 8, 9, 10, 11]);
        assert_eq!(without_wild_detections(&track(&x[..4]), SCALES), track(&x[..4]));
    }

    #[test]
    fn what_never_moves_has_no_scales() {
        let still = [track(&[0.5; 20]), track(&[])];
        assert_eq!(scales(still.iter()), Scales { noise: 0.0, travel: 0.0, stillness: 0.0 });
        assert_eq!(min_dwell(&still, scales(still.iter())), SHORTEST_DWELL);
        assert_eq!(scales([].iter()), Scales { noise: 0.0, travel: 0.0, stillness: 0.0 });
    }

    #[test]
    fn the_travel_of_a_thing_that_is_seldom_moved_is_that_of_its_moves() {
        let tracks = [track(&[0.0; 20]), track(&[&[0.0; 10][..], &[1.0; 10]].concat()), track(&[0.1; 20])];
        assert!((scales(tracks.iter()).travel - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_travel_and_the_start_do_not_count_one_wild_detection() {
        let mut x = [&[0.0; 20][..], &[1.0; 20]].concat();
        (x[1], x[30]) = (7.0, 9.0);
        assert!((scales([track(&x)].iter()).travel - 1.0).abs() < 1e-12);
        assert_eq!(start_point(&track(&x)), [0.0]);
    }
}
