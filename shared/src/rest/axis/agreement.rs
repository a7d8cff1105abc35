//! The direction on which the ways of things agree.

use super::dot;
use crate::points::mean;

/// Cosine of the largest angle between directions that agree.
const SAME_DIRECTION: f64 = 0.75;

/// Cosine of the largest angle to one of the features at which an axis is upright, and how closely arrivals and departures
/// must agree on it: most recordings have a feature that is height, and chance seldom points along one.
const UPRIGHT: f64 = 0.995;

/// Where an axis is upright, the share of the arrivals and of the departures, each, that must show it: the others may slide.
const AGREEING_IF_UPRIGHT: f64 = 0.34;

/// A way of a thing that is known to be put down or taken up.
pub(super) struct Known {
    /// The direction in which it comes, or against which it leaves.
    pub(super) down: Vec<f64>,
    /// Whether it comes there.
    pub(super) is_arrival: bool,
}

/// A direction on which ways agree.
pub(super) struct Agreed {
    /// The mean of those that agree, as a unit vector.
    pub(super) down: Vec<f64>,
    /// The share of the ways that agree.
    pub(super) part: f64,
    /// How closely those do, from 0 to 1.
    pub(super) closeness: f64,
}

impl Agreed {
    /// Whether it is along a feature, very closely, for some of the arrivals and of the departures: each kind alone agrees
    /// with itself wherever a thing starts or ends at one place.
    pub(super) fn is_upright(&self, ways: &[Known]) -> bool {
        let is_along_feature = self.down.iter().any(|x| x.abs() > UPRIGHT);
        let is_shown_by = |is_arrival: bool| {
            let of_kind: Vec<&Known> = ways.iter().filter(|way| way.is_arrival == is_arrival).collect();
            let alike = of_kind.iter().filter(|way| dot(&way.down, &self.down) > SAME_DIRECTION).count();
            alike as f64 > AGREEING_IF_UPRIGHT * of_kind.len() as f64
        };
        is_along_feature && self.closeness > UPRIGHT && is_shown_by(true) && is_shown_by(false)
    }
}

/// The direction on which most ways agree.
pub(super) fn agreed_direction(ways: &[Known]) -> Option<Agreed> {
    const CANDIDATES: usize = 64;
    let alike = |a: &Known, b: &Known| dot(&a.down, &b.down) > SAME_DIRECTION;
    let candidates = ways.iter().step_by(ways.len().div_ceil(CANDIDATES).max(1));
    let best = candidates.max_by_key(|candidate| ways.iter().filter(|way| alike(way, candidate)).count())?;
    let same: Vec<&[f64]> =
        ways.iter().filter(|way| alike(way, best)).map(|way| way.down.as_slice()).collect();
    let part = same.len() as f64 / ways.len() as f64;
    let sum = mean(best.down.len(), same.into_iter());
    let closeness = dot(&sum, &sum).sqrt();
    let down = sum.iter().map(|x| x / closeness).collect();
    (closeness > 0.0).then_some(Agreed { down, part, closeness })
}
