//! Clustering parameters chosen from the data alone.

use std::collections::BTreeSet;

use crate::dbscan::DbscanParameters;
use crate::points::{distance, mean};
use crate::rest::{Kind, SubsetStays};

/// Chooses `epsilon` and `min_points` for the frames at rest of a subset, such that the rests of one place are one
/// cluster and those of different places are not.
///
/// Rests are joined to a minimum spanning tree, which is cut wherever the two sides lie apart by far more than each is
/// spread: people put a thing down at one place within some scatter, and different places differ by a multiple of it.
/// Epsilon is then between the longest edge that stays and the shortest one that is cut, with room for the sensor noise.
///
/// # Complexity
///
/// O(R²) for R rests in all demonstrations.
pub fn choose_parameters(stays: &SubsetStays, dimension: usize) -> DbscanParameters {
    let rests = rests(stays);
    let edges = spanning_tree(&rests.iter().map(|rest| rest.center).collect::<Vec<_>>());
    let kept = cut(&rests, edges, stays);
    let heap = stays.scales.heap_radius(dimension);
    let within = kept.longest_kept.max(heap);
    let between = kept.shortest_between - 2.0 * heap;
    let epsilon = if between > within { (within * between).sqrt().min(1.5 * within) } else { within };
    DbscanParameters {
        epsilon: round_up(epsilon),
        min_points: (kept.fewest_frames / 2).clamp((dimension + 1).min(5), 20),
    }
}

/// A rest: where, and in which demonstration.
struct Rest<'a> {
    center: &'a [f64],
    demonstration: usize,
    frames: usize,
    is_left_alone: bool,
}

fn rests(stays: &SubsetStays) -> Vec<Rest<'_>> {
    let mut rests = Vec::new();
    for (demonstration, stays) in stays.demonstrations.iter().enumerate() {
        let at_rest = stays.iter().filter(|stay| stay.kind.is_rest());
        rests.extend(at_rest.map(|stay| Rest {
            center: &stay.dwell.center,
            demonstration,
            frames: stay.dwell.span.len(),
            is_left_alone: stay.kind == Kind::LeftAlone,
        }));
    }
    rests
}

/// Rounds up to three significant decimal digits: nobody reads more. Above zero whatever comes in.
fn round_up(value: f64) -> f64 {
    if !(value > 0.0 && value.is_finite()) {
        return 1e-6;
    }
    let mut unit = 1.0;
    while value / unit >= 1000.0 {
        unit *= 10.0;
    }
    while value / unit < 100.0 && unit > 1e-12 {
        unit /= 10.0;
    }
    // Multiplying by a negative power of ten would leave digits behind; dividing by its inverse does not.
    let steps = (value / unit).ceil();
    if unit < 1.0 { steps / (1.0 / unit).round() } else { steps * unit }
}

/// An edge between two points, by their positions.
#[derive(Clone, Copy, Debug)]
struct Edge {
    from: usize,
    to: usize,
    length: f64,
}

/// The edges of the minimum spanning tree (Prim 1957), in no order.
fn spanning_tree(points: &[&[f64]]) -> Vec<Edge> {
    let mut edges = Vec::new();
    let mut nearest: Vec<Edge> =
        (1..points.len()).map(|to| Edge { from: 0, to, length: distance(points[0], points[to]) }).collect();
    while let Some(at) = (0..nearest.len()).min_by(|&a, &b| nearest[a].length.total_cmp(&nearest[b].length)) {
        let edge = nearest.swap_remove(at);
        for other in &mut nearest {
            let length = distance(points[edge.to], points[other.to]);
            if length < other.length {
                *other = Edge { from: edge.to, length, ..*other };
            }
        }
        edges.push(edge);
    }
    edges
}

/// What a cut of the spanning tree says about distances.
struct Cut {
    longest_kept: f64,
    shortest_between: f64,
    /// Of every place the longest rest in frames, and of those the shortest.
    fewest_frames: usize,
}

/// Two places are at least this many standard deviations of their scatter apart, and where the same demonstrations
/// visit both, which shows that they are different, at least this many.
const APART: f64 = 5.0;
const APART_IF_BOTH_VISITED: f64 = 3.0;

/// Places that different demonstrations use are one place below the first of these shares of the travel, or the second
/// where no axis is known: people do not put things down more precisely. Along the axis it is the table or the block
/// below that decides, and does so precisely.
const SAME_PLACE: f64 = 0.07;
const SAME_PLACE_WITHOUT_AXIS: f64 = 0.05;

/// Rests whose nearest neighbors are further away than this share of the travel are different places.
const NEVER_ONE_PLACE: f64 = 0.12;

/// The scatter that is expected before any is seen, as a share of the travel, and how many rests that counts for; the
/// second along the axis.
const EXPECTED_SCATTER: f64 = 0.012;
const EXPECTED_SCATTER_ALONG_AXIS: f64 = 0.004;
const EXPECTED_SCATTER_WEIGHT: f64 = 3.0;

/// Joins rests along the edges of the tree, shortest first (Kruskal 1956), except where the two sides lie apart.
fn cut(rests: &[Rest], mut edges: Vec<Edge>, stays: &SubsetStays) -> Cut {
    let mut result = Cut { longest_kept: 0.0, shortest_between: f64::INFINITY, fewest_frames: usize::MAX };
    let mut place_of: Vec<usize> = (0..rests.len()).collect();
    let mut longest = vec![0.0; rests.len()];
    let mut places: Vec<Vec<usize>> = place_of.iter().map(|&rest| vec![rest]).collect();
    edges.sort_by(|a, b| a.length.total_cmp(&b.length));
    for edge in edges {
        let (a, b) = (place_of[edge.from], place_of[edge.to]);
        let is_far = edge.length > NEVER_ONE_PLACE * stays.scales.travel;
        let is_near = edge.length <= 1.5 * stays.scales.stillness;
        if is_far || (!is_near && lie_apart(rests, &places[a], &places[b], stays)) {
            result.shortest_between = result.shortest_between.min(edge.length);
            continue;
        }
        longest[a] = edge.length;
        let joined = std::mem::take(&mut places[b]);
        for &rest in &joined {
            place_of[rest] = a;
        }
        places[a].extend(joined);
    }
    let enough = stays.demonstrations.len().div_ceil(2);
    let is_known = |place: &[usize]| {
        let known = place.iter().any(|&rest| rests[rest].is_left_alone);
        known || place.iter().map(|&rest| rests[rest].demonstration).collect::<BTreeSet<_>>().len() >= enough
    };
    for (place, longest) in places.iter().zip(longest) {
        if is_known(place) {
            result.longest_kept = result.longest_kept.max(longest);
            let most = place.iter().map(|&rest| rests[rest].frames).max().unwrap_or(0);
            result.fewest_frames = result.fewest_frames.min(most);
        }
    }
    result
}

/// Whether two groups of rests are two places: their centers are far apart for the scatter along the line between them.
fn lie_apart(rests: &[Rest], a: &[usize], b: &[usize], stays: &SubsetStays) -> bool {
    let dimension = rests[0].center.len();
    let center = |group: &[usize]| mean(dimension, group.iter().map(|&rest| rests[rest].center));
    let (left, right) = (center(a), center(b));
    let apart = distance(&left, &right);
    let line: Vec<f64> = left.iter().zip(&right).map(|(l, r)| (r - l) / apart).collect();
    let squares = |group: &[usize], center: &[f64]| -> f64 {
        let offset = |&rest: &usize| dot_from(center, rests[rest].center, &line);
        group.iter().map(offset).map(|offset| offset * offset).sum()
    };
    let is_along_axis =
        stays.axis.as_ref().is_some_and(|axis| dot_from(&left, &right, &axis.down).abs() > 0.8 * apart);
    let expected_share = if is_along_axis { EXPECTED_SCATTER_ALONG_AXIS } else { EXPECTED_SCATTER };
    let expected = expected_share * stays.scales.travel;
    let total = squares(a, &left) + squares(b, &right) + EXPECTED_SCATTER_WEIGHT * expected * expected;
    let scatter = (total / ((a.len() + b.len()) as f64 - 2.0 + EXPECTED_SCATTER_WEIGHT)).sqrt();
    if are_both_visited(rests, a, b) {
        return apart > APART_IF_BOTH_VISITED * scatter;
    }
    let same_place = if stays.axis.is_some() { SAME_PLACE } else { SAME_PLACE_WITHOUT_AXIS };
    apart > APART * scatter && (is_along_axis || apart > same_place * stays.scales.travel)
}

/// The way from `from` to `to` along the unit vector `direction`.
fn dot_from(from: &[f64], to: &[f64], direction: &[f64]) -> f64 {
    from.iter().zip(to).zip(direction).map(|((from, to), direction)| (to - from) * direction).sum()
}

/// Whether most demonstrations that rest in the smaller group rest in the other, too.
fn are_both_visited(rests: &[Rest], a: &[usize], b: &[usize]) -> bool {
    let demonstrations: BTreeSet<usize> = a.iter().map(|&rest| rests[rest].demonstration).collect();
    let both = b.iter().filter(|&&rest| demonstrations.contains(&rests[rest].demonstration)).count();
    2 * both > a.len().min(b.len())
}
