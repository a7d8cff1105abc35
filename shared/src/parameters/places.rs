//! Rests put together to places.

use std::collections::BTreeMap;

use petgraph::unionfind::UnionFind;

use super::Rest;
use super::spanning_tree::Edge;
use crate::points::distance;
use crate::rest::SubsetStays;

/// What a cut of the spanning tree says about distances.
pub(super) struct Cut {
    pub(super) longest_kept: f64,
    pub(super) shortest_between: f64,
    /// Of every place the longest rest in frames, and of those the shortest.
    pub(super) fewest_frames: usize,
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
///
/// # Complexity
///
/// O(R log² R) for R rests; a place is told by sums over its rests, and the smaller joins the larger.
pub(super) fn cut(rests: &[Rest], edges: &[Edge], stays: &SubsetStays) -> Cut {
    let mut shortest_between = f64::INFINITY;
    let mut joined: UnionFind<usize> = UnionFind::new(rests.len());
    let mut places: Vec<Option<Place>> = rests.iter().map(|rest| Some(Place::of(rest))).collect();
    for edge in edges {
        let ends = [edge.from, edge.to].map(|end| joined.find_mut(end));
        let [Some(a), Some(b)] = ends.map(|end| places[end].take()) else {
            continue;
        };
        let is_far = edge.length > NEVER_ONE_PLACE * stays.scales.travel;
        let is_near = edge.length <= 1.5 * stays.scales.stillness;
        if is_far || (!is_near && lie_apart(&a, &b, stays)) {
            shortest_between = shortest_between.min(edge.length);
            (places[ends[0]], places[ends[1]]) = (Some(a), Some(b));
        } else {
            joined.union(ends[0], ends[1]);
            places[joined.find_mut(ends[0])] = Some(a.with(b, edge.length));
        }
    }
    let enough = stays.demonstrations.len().div_ceil(2);
    let is_known = |place: &&Place| place.is_left_alone || place.visits.len() >= enough;
    let known = || places.iter().flatten().filter(is_known);
    Cut {
        longest_kept: known().map(|place| place.longest_edge).fold(0.0, f64::max),
        shortest_between,
        fewest_frames: known().map(|place| place.most_frames).min().unwrap_or(usize::MAX),
    }
}

/// Rests that are joined.
struct Place {
    rests: usize,
    /// Mean of their centers.
    center: Vec<f64>,
    /// For each pair of features the sum of the products of the offsets from `center`; nothing for one rest.
    scatter: Vec<f64>,
    /// How many rests each demonstration has here.
    visits: BTreeMap<usize, usize>,
    /// Of the edges that join them.
    longest_edge: f64,
    /// The frames of the longest of them.
    most_frames: usize,
    /// Whether one of them is.
    is_left_alone: bool,
}

impl Place {
    fn of(rest: &Rest) -> Self {
        Self {
            rests: 1,
            center: rest.center.to_vec(),
            scatter: Vec::new(),
            visits: BTreeMap::from([(rest.demonstration, 1)]),
            longest_edge: 0.0,
            most_frames: rest.frames,
            is_left_alone: rest.is_left_alone,
        }
    }

    /// Both, joined by an edge that is no shorter than any before. The sums are those of Chan, Golub and `LeVeque` (1983).
    fn with(self, other: Self, edge: f64) -> Self {
        let (mut all, less) =
            if self.visits.len() < other.visits.len() { (other, self) } else { (self, other) };
        let rests = all.rests + less.rests;
        let way: Vec<f64> = all.center.iter().zip(&less.center).map(|(from, to)| to - from).collect();
        let weight = all.rests as f64 * less.rests as f64 / rests as f64;
        let share = less.rests as f64 / rests as f64;
        all.scatter.resize(way.len() * way.len(), 0.0);
        all.scatter.iter_mut().zip(&less.scatter).for_each(|(sum, more)| *sum += more);
        for (row, x) in all.scatter.chunks_exact_mut(way.len().max(1)).zip(&way) {
            row.iter_mut().zip(&way).for_each(|(sum, y)| *sum += weight * (x * y));
        }
        all.center.iter_mut().zip(&way).for_each(|(center, way)| *center += share * way);
        for (demonstration, visits) in less.visits {
            *all.visits.entry(demonstration).or_default() += visits;
        }
        all.rests = rests;
        all.longest_edge = edge;
        all.most_frames = all.most_frames.max(less.most_frames);
        all.is_left_alone |= less.is_left_alone;
        all
    }

    /// The sum of the squared offsets from the center along the unit vector `line`.
    fn squares_along(&self, line: &[f64]) -> f64 {
        let rows = self.scatter.chunks_exact(line.len().max(1));
        rows.zip(line).map(|(row, x)| x * dot(row, line)).sum::<f64>().max(0.0)
    }
}

/// Whether two groups of rests are two places: their centers are far apart for the scatter along the line between them.
fn lie_apart(a: &Place, b: &Place, stays: &SubsetStays) -> bool {
    let apart = distance(&a.center, &b.center);
    let line: Vec<f64> = a.center.iter().zip(&b.center).map(|(a, b)| (b - a) / apart).collect();
    let is_along_axis = stays.axis.as_ref().is_some_and(|axis| dot(&line, &axis.down).abs() > 0.8);
    let expected_share = if is_along_axis { EXPECTED_SCATTER_ALONG_AXIS } else { EXPECTED_SCATTER };
    let expected = expected_share * stays.scales.travel;
    let total =
        a.squares_along(&line) + b.squares_along(&line) + EXPECTED_SCATTER_WEIGHT * expected * expected;
    let scatter = (total / ((a.rests + b.rests) as f64 - 2.0 + EXPECTED_SCATTER_WEIGHT)).sqrt();
    if are_both_visited(a, b) {
        return apart > APART_IF_BOTH_VISITED * scatter;
    }
    let same_place = if stays.axis.is_some() { SAME_PLACE } else { SAME_PLACE_WITHOUT_AXIS };
    apart > APART * scatter && (is_along_axis || apart > same_place * stays.scales.travel)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Whether most demonstrations that rest in the smaller group rest in the other, too.
fn are_both_visited(a: &Place, b: &Place) -> bool {
    // Looked up in the one with more demonstrations; the rests that are counted are those of `b`.
    let both: usize = if b.visits.len() < a.visits.len() {
        b.visits
            .iter()
            .filter(|(demonstration, _)| a.visits.contains_key(demonstration))
            .map(|(_, visits)| visits)
            .sum()
    } else {
        a.visits.keys().filter_map(|demonstration| b.visits.get(demonstration)).sum()
    };
    2 * both > a.rests.min(b.rests)
}
