//! The direction in which things are put down.

mod account;
mod agreement;
mod way;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Kind, Stay, SubsetRecording, SubsetStays};
use crate::points::{Track, distance, median};
use account::Account;
use agreement::{Known, agreed_direction};
use way::{Stop, Way, arrival, departure};

/// The one direction in which a thing is put down, opposite to the one in which it is taken up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

/// The share of arrivals and departures that must agree, and where the axis accounts for the other stays as well.
const AGREEING: f64 = 0.6;
const AGREEING_IF_ACCOUNTED: f64 = 0.85;

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

/// The axis of each subset, where there is one: learned from the starts and certain rests of all subsets that have the
/// same kind of features, at the reach where those agree best.
pub(super) fn learn(recordings: &[SubsetRecording], subsets: &[SubsetStays]) -> Vec<Option<Axis>> {
    let mut kinds: BTreeMap<Vec<&str>, Vec<usize>> = BTreeMap::new();
    for (index, recording) in recordings.iter().enumerate() {
        kinds.entry(kind_of_features(recording)).or_default().push(index);
    }
    kinds.retain(|features, _| features.len() >= FEWEST_FEATURES);
    let mut axes = vec![None; recordings.len()];
    for members in kinds.into_values() {
        let Some((down, share)) = best_direction(recordings, subsets, &members) else {
            continue;
        };
        for member in members {
            axes[member] = Some(Axis { down: down.clone(), reach: reach(&subsets[member], share) });
        }
    }
    axes
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
        let ways: Vec<Known> = members
            .iter()
            .flat_map(|&member| downs(&recordings[member], &subsets[member], reach(&subsets[member], share)))
            .collect();
        let agreed = agreed_direction(&ways)?;
        let account = Account::of(recordings, subsets, members, &agreed.down, share);
        let lifts = members
            .iter()
            .flat_map(|&member| lifts_per_carry(&recordings[member], &subsets[member], &agreed.down));
        let lift = median(lifts.collect());
        let is_alone = members.len() == 1;
        let is_clear = !is_alone || (lift < 1.0 && is_left_at_several_places(&subsets[members[0]]));
        let needed = if is_clear { AGREEMENT } else { AGREEMENT_ALONE };
        let is_usual = agreed.closeness > needed && agreed.part >= AGREEING;
        let is_accounted = agreed.closeness > AGREEMENT
            && agreed.part > AGREEING_IF_ACCOUNTED
            && account.explains_the_brief_stays();
        let is_lifted = LIFT_PER_CARRY.contains(&lift);
        let is_believed = is_accounted
            || (is_lifted && agreed.is_upright(&ways))
            || (is_lifted && is_usual && !(is_alone && account.contradicts_the_long_stays()));
        is_believed.then_some((agreed.closeness, (agreed.down, share)))
    };
    REACHES.into_iter().filter_map(at_share).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, best)| best)
}

/// Whether a thing is left alone at more places than one, of those that are counted apart.
fn is_left_at_several_places(subset: &SubsetStays) -> bool {
    let left_alone = subset.demonstrations.iter().flatten().filter(|stay| stay.kind == Kind::LeftAlone);
    let mut places = left_alone.map(|stay| &stay.dwell.center);
    let same_place = SAME_PLACE * subset.scales.travel;
    places.next().is_some_and(|first| places.any(|other| distance(first, other) > same_place))
}

/// The ways on which a thing comes to where it is left alone, and those on which it leaves that or its start.
fn downs(recording: &SubsetRecording, subset: &SubsetStays, reach: f64) -> Vec<Known> {
    let mut downs = Vec::new();
    for (track, stays) in recording.tracks.iter().zip(&subset.demonstrations) {
        for (index, stay) in stays.iter().enumerate() {
            if stay.kind == Kind::LeftAlone {
                let down = arrival(track, stays, index, reach, Stop::Never).direction();
                downs.extend(down.map(|down| Known { down, is_arrival: true }));
            }
            if matches!(stay.kind, Kind::LeftAlone | Kind::Start) {
                let up = departure(track, stays, index, reach, Stop::Never).direction();
                downs.extend(up.map(|up| Known { down: negated(&up), is_arrival: false }));
            }
        }
    }
    downs
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dwell::Dwell;
    use crate::points::Points;

    /// Verdict on the middle one of three stops, between which a thing is seen at the corners of its way.
    fn verdict(corners: &[[f64; 2]]) -> Verdict {
        let [start, end] = [[-9.0, 0.0], [9.0, 0.0]];
        let middle = [0.0, 0.0];
        let at = corners.iter().position(|corner| distance(corner, &middle) < 1e-9).unwrap();
        let rows = [&[start][..], corners, &[end]].concat();
        let points = Points::from_rows(2, rows.concat());
        let stay = |index: usize, center: [f64; 2]| Stay {
            dwell: Dwell { span: index..index + 1, center: center.to_vec() },
            kind: Kind::Rest,
        };
        let stays = [stay(0, start), stay(at + 1, middle), stay(rows.len() - 1, end)];
        let track = Track::observed_throughout(points);
        Axis { down: vec![0.0, -1.0], reach: 1.0 }.verdict(&track, &stays, 1)
    }

    #[test]
    fn a_thing_that_comes_down_and_leaves_up_is_put_down() {
        assert_eq!(verdict(&[[0.0, 2.0], [0.0, 0.0], [0.0, 2.0]]), Verdict::PutDown);
    }

    #[test]
    fn a_thing_that_goes_on_down_or_comes_up_is_held() {
        assert_eq!(verdict(&[[0.0, 2.0], [0.0, 0.0], [0.0, -2.0]]), Verdict::Held);
        assert_eq!(verdict(&[[0.0, -2.0], [0.0, 0.0], [2.0, 0.0]]), Verdict::Held);
    }

    #[test]
    fn sideways_on_one_end_is_slid_and_on_both_unknown() {
        assert_eq!(verdict(&[[0.0, 2.0], [0.0, 0.0], [2.0, 0.0]]), Verdict::Slid);
        assert_eq!(verdict(&[[-2.0, 0.0], [0.0, 0.0], [2.0, 0.0]]), Verdict::Unknown);
    }

    #[test]
    fn directions_agree_when_most_are_alike() {
        let agreed = agreed_direction(&ways(&[[0.0, 1.0], [0.0, 1.0], [1.0, 0.0]])).unwrap();
        assert!(agreed.closeness > 0.99 && agreed.part > 0.6 && agreed.down == [0.0, 1.0]);
        assert!(agreed_direction(&[]).is_none());
    }

    #[test]
    fn an_axis_is_upright_when_some_arrivals_and_some_departures_are_along_a_feature() {
        let is_upright = |ways: &[Known]| agreed_direction(ways).unwrap().is_upright(ways);
        assert!(is_upright(&ways(&[[0.0, 1.0], [0.0, 1.0], [1.0, 0.0], [-1.0, 0.0]])));
        assert!(!is_upright(&ways(&[[0.6, 0.8], [0.6, 0.8]])));
        assert!(!is_upright(&ways(&[[0.0, 1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]])));
    }

    /// Arrivals and departures in turn.
    fn ways(downs: &[[f64; 2]]) -> Vec<Known> {
        let known =
            |(index, down): (usize, &[f64; 2])| Known { down: down.to_vec(), is_arrival: index % 2 == 0 };
        downs.iter().enumerate().map(known).collect()
    }
}
