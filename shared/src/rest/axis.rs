//! The direction in which things are put down.

use std::collections::BTreeMap;

use super::{Kind, Stay, SubsetRecording, SubsetStays};
use crate::dwell::Dwell;
use crate::points::{Track, distance, mean, median};

/// The one direction in which a thing is put down, opposite to the one in which it is taken up.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Unit vector.
    pub down: Vec<f64>,
    /// How far from a dwell directions are taken, in the unit of the features.
    pub reach: f64,
}

/// In fewer features nothing is seen of being lifted: they are a view from above, or joint angles.
const FEWEST_FEATURES: usize = 3;

/// How closely arrivals and departures must agree: the length of the mean of those that agree at all.
const AGREEMENT: f64 = 0.95;

/// The share of arrivals and departures that must agree.
const AGREEING: f64 = 0.6;

/// Cosine of the largest angle between directions that agree.
const SAME_DIRECTION: f64 = 0.75;

/// How far from a dwell directions are looked for, as shares of the travel.
const REACHES: [f64; 3] = [0.05, 0.1, 0.2];

/// Places nearer to each other than this share of the travel are counted once.
const SAME_PLACE: f64 = 0.1;

/// By which multiples of the way that it is carried a thing is typically lifted.
const LIFT_PER_CARRY: std::ops::Range<f64> = 0.05..2.0;

/// How closely they must agree where one thing alone shows it and is lifted further than it is carried, or is put down at
/// one place only: its way may bend back by chance.
const AGREEMENT_ALONE: f64 = 0.99;

/// Cosine of the largest angle at which a direction still counts as down or up.
const ALONG: f64 = 0.6;

/// How far a thing may get while it is not observed, as a share of the reach, for its direction to be known.
const LARGEST_STEP: f64 = 0.4;

impl Axis {
    /// What the ways to a stay and from it say of it.
    pub(super) fn verdict(&self, track: &Track, stays: &[Stay], index: usize) -> Verdict {
        let down = |way: Way| match way {
            Way::Direction(direction) => Some(dot(&direction, &self.down)),
            Way::Near => Some(0.0),
            Way::Unseen => None,
        };
        let comes_down = down(arrival(track, stays, index, self.reach, Stop::AtStays));
        let leaves_up = down(departure(track, stays, index, self.reach, Stop::AtStays)).map(|down| -down);
        let both = [comes_down, leaves_up];
        let along = both.iter().flatten().filter(|&&cosine| cosine > ALONG).count();
        let against = both.iter().flatten().any(|&cosine| cosine < -ALONG);
        let seen = both.iter().flatten().count();
        match (against, along, seen) {
            (true, ..) => Verdict::Held,
            (_, 2, _) | (_, 1, 1) => Verdict::PutDown,
            (_, 1, _) => Verdict::Slid,
            _ => Verdict::Unknown,
        }
    }
}

/// What the ways to a stay and from it say of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// The thing comes down or leaves up, as far as is seen.
    PutDown,
    /// It comes down or leaves up, but not both.
    Slid,
    /// It comes or leaves sideways, or is not seen.
    Unknown,
    /// It comes up, or goes on down.
    Held,
}

/// How a thing comes to a dwell or leaves it.
enum Way {
    /// Along this unit vector.
    Direction(Vec<f64>),
    /// It was not seen.
    Unseen,
    /// It is never far from the dwell.
    Near,
}

impl Way {
    fn direction(self) -> Option<Vec<f64>> {
        match self {
            Self::Direction(direction) => Some(direction),
            Self::Unseen | Self::Near => None,
        }
    }
}

pub(super) struct Axes;

impl Axes {
    /// The axis of each subset, where there is one: learned from the starts and certain rests of all subsets that have
    /// the same kind of features, at the reach where those agree best.
    pub(super) fn learn(recordings: &[SubsetRecording], subsets: &[SubsetStays]) -> Vec<Option<Axis>> {
        let mut kinds: BTreeMap<Vec<&str>, Vec<usize>> = BTreeMap::new();
        for (index, recording) in recordings.iter().enumerate() {
            kinds.entry(kind_of_features(recording)).or_default().push(index);
        }
        let mut axes = vec![None; recordings.len()];
        for members in
            kinds.into_values().filter(|members| recordings[members[0]].features.len() >= FEWEST_FEATURES)
        {
            let Some((down, share)) = best_direction(recordings, subsets, &members) else {
                continue;
            };
            for member in members {
                axes[member] = Some(Axis { down: down.clone(), reach: reach(&subsets[member], share) });
            }
        }
        axes
    }
}

/// The features' names without what they have in common with the subset's: `x y z` for a block, `q1 q2` for an arm.
fn kind_of_features(recording: &SubsetRecording) -> Vec<&str> {
    recording.features.iter().map(|name| name.strip_prefix(&recording.name).unwrap_or(name)).collect()
}

fn reach(stays: &SubsetStays, share: f64) -> f64 {
    (4.0 * stays.scales.stillness).max(share * stays.scales.travel)
}

fn best_direction(
    recordings: &[SubsetRecording],
    subsets: &[SubsetStays],
    members: &[usize],
) -> Option<(Vec<f64>, f64)> {
    let at_share = |share: f64| {
        let directions: Vec<Vec<f64>> = members
            .iter()
            .flat_map(|&member| downs(&recordings[member], &subsets[member], reach(&subsets[member], share)))
            .collect();
        let (agreement, down) = agreed_direction(&directions)?;
        let lifts =
            members.iter().flat_map(|&member| lifts_per_carry(&recordings[member], &subsets[member], &down));
        let lift = median(lifts.collect());
        let is_clear = members.len() > 1 || (lift < 1.0 && places_shown(subsets, members) > 2);
        let needed = if is_clear { AGREEMENT } else { AGREEMENT_ALONE };
        (agreement > needed && LIFT_PER_CARRY.contains(&lift)).then_some((agreement, (down, share)))
    };
    REACHES.into_iter().filter_map(at_share).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, best)| best)
}

/// At how many places things are seen to be put down or taken up: those where they are left alone, and the start of each.
fn places_shown(subsets: &[SubsetStays], members: &[usize]) -> usize {
    let places_of = |member: &usize| {
        let subset = &subsets[*member];
        let mut places: Vec<&[f64]> = Vec::new();
        for stay in subset.demonstrations.iter().flatten().filter(|stay| stay.kind == Kind::LeftAlone) {
            let known =
                |place: &&[f64]| distance(place, &stay.dwell.center) <= SAME_PLACE * subset.scales.travel;
            if !places.iter().any(known) {
                places.push(&stay.dwell.center);
            }
        }
        places.len() + 1
    };
    members.iter().map(places_of).sum()
}

/// The directions in which a thing comes to where it is left alone, and those against which it leaves.
fn downs(recording: &SubsetRecording, subset: &SubsetStays, reach: f64) -> Vec<Vec<f64>> {
    let mut downs = Vec::new();
    for (track, stays) in recording.tracks.iter().zip(&subset.demonstrations) {
        for (index, stay) in stays.iter().enumerate() {
            if stay.kind == Kind::LeftAlone {
                downs.extend(arrival(track, stays, index, reach, Stop::Never).direction());
            }
            if matches!(stay.kind, Kind::LeftAlone | Kind::Start) {
                downs.extend(
                    departure(track, stays, index, reach, Stop::Never).direction().map(|up| negated(&up)),
                );
            }
        }
    }
    downs
}

/// The mean of the directions that agree, as a unit vector, and how well they do, from 0 to 1.
fn agreed_direction(directions: &[Vec<f64>]) -> Option<(f64, Vec<f64>)> {
    const CANDIDATES: usize = 64;
    let agreeing =
        |with: &[f64]| directions.iter().filter(|direction| dot(direction, with) > SAME_DIRECTION).count();
    let candidates = directions.iter().step_by(directions.len().div_ceil(CANDIDATES).max(1));
    let best = candidates.max_by_key(|candidate| agreeing(candidate))?;
    let same: Vec<&[f64]> = directions
        .iter()
        .map(Vec::as_slice)
        .filter(|direction| dot(direction, best) > SAME_DIRECTION)
        .collect();
    if (same.len() as f64) < AGREEING * directions.len() as f64 {
        return None;
    }
    let sum = mean(best.len(), same.into_iter());
    let length = dot(&sum, &sum).sqrt();
    (length > 0.0).then(|| (length, sum.iter().map(|x| x / length).collect()))
}

/// For each way between two places where the thing is known to be left: how high it is lifted, by how far it is carried
/// across `down`.
fn lifts_per_carry(recording: &SubsetRecording, subset: &SubsetStays, down: &[f64]) -> Vec<f64> {
    let mut lifts = Vec::new();
    for (track, stays) in recording.tracks.iter().zip(&subset.demonstrations) {
        let known: Vec<&Stay> =
            stays.iter().filter(|stay| matches!(stay.kind, Kind::LeftAlone | Kind::Start)).collect();
        for pair in known.windows(2) {
            let (from, to) = (&pair[0].dwell, &pair[1].dwell);
            let height = |point: &[f64]| -> f64 {
                point.iter().zip(&from.center).zip(down).map(|((x, start), down)| (start - x) * down).sum()
            };
            let way = distance(&from.center, &to.center);
            let carried = (way * way - height(&to.center) * height(&to.center)).max(0.0).sqrt();
            let lifted =
                (from.span.end..to.span.start).map(|at| height(track.points.point(at))).fold(0.0, f64::max);
            lifts.push(if carried > 0.0 { lifted / carried } else { f64::INFINITY });
        }
    }
    lifts
}

fn negated(vector: &[f64]) -> Vec<f64> {
    vector.iter().map(|x| -x).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// How the thing comes to stay `index` from `reach` away, or from the stay before where that is nearer.
fn arrival(track: &Track, stays: &[Stay], index: usize, reach: f64, stop: Stop) -> Way {
    let dwell = &stays[index].dwell;
    let earlier = index.checked_sub(1).map(|before| &stays[before].dwell).filter(|_| stop == Stop::AtStays);
    let first = earlier.map_or(0, |earlier| earlier.span.end - 1);
    let edge = far_edge(track, dwell, (first..dwell.span.start).rev(), dwell.span.start, reach);
    edge.way(track, earlier, |far| direction(far, &dwell.center))
}

/// How the thing leaves stay `index` until it is `reach` away, or to the stay after where that is nearer.
fn departure(track: &Track, stays: &[Stay], index: usize, reach: f64, stop: Stop) -> Way {
    let dwell = &stays[index].dwell;
    let later = stays.get(index + 1).map(|after| &after.dwell).filter(|_| stop == Stop::AtStays);
    let last = later.map_or(track.len(), |later| later.span.start + 1);
    let edge = far_edge(track, dwell, dwell.span.end..last, dwell.span.end - 1, reach);
    edge.way(track, later, |far| direction(&dwell.center, far))
}

/// Whether a direction is taken to the neighboring stay when that is nearer than the reach.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stop {
    AtStays,
    Never,
}

/// Where the way from a dwell is looked at.
enum Edge {
    /// At this position in the track.
    At(usize),
    /// It was lost from sight before.
    Lost,
    /// At the neighboring stay, which comes first.
    Neighbor,
}

impl Edge {
    fn way(
        self,
        track: &Track,
        neighbor: Option<&Dwell>,
        direction: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Way {
        let found = match (self, neighbor) {
            (Self::At(index), _) => direction(track.points.point(index)),
            (Self::Neighbor, Some(neighbor)) => direction(&neighbor.center),
            (Self::Neighbor, None) => None,
            (Self::Lost, _) => return Way::Unseen,
        };
        found.map_or(Way::Near, Way::Direction)
    }
}

/// The first of `indices` at which the thing is `reach` away from the dwell, unless it is lost from sight on the way.
fn far_edge(
    track: &Track,
    dwell: &Dwell,
    indices: impl Iterator<Item = usize>,
    edge: usize,
    reach: f64,
) -> Edge {
    let mut previous = edge;
    for index in indices {
        let step = distance(track.points.point(index), track.points.point(previous));
        if track.frames[index].abs_diff(track.frames[previous]) > 1 && step > LARGEST_STEP * reach {
            return Edge::Lost;
        }
        if distance(track.points.point(index), &dwell.center) >= reach {
            return Edge::At(index);
        }
        previous = index;
    }
    Edge::Neighbor
}

fn direction(from: &[f64], to: &[f64]) -> Option<Vec<f64>> {
    let length = distance(from, to);
    (length > 0.0).then(|| from.iter().zip(to).map(|(a, b)| (b - a) / length).collect())
}
