//! The stays of a subset by where they are.

use crate::points::median;
use crate::rest::{Kind, Stay, SubsetStays};
use crate::specification::Ball;
use crate::sub_goal::arranged::Arranged;

/// A stay with its demonstration.
pub(super) type Visit<'a> = (usize, &'a Stay);

/// The stays of a subset by where they are.
pub(super) struct ArrangedStays<'a> {
    /// All, in the order of demonstrations and time.
    visits: Vec<Visit<'a>>,
    by_center: Arranged,
    /// How many demonstrations there are.
    pub(super) demonstrations: usize,
    /// For how many frames a thing typically stays where it is not known to be left alone.
    pub(super) typical: f64,
}

impl<'a> ArrangedStays<'a> {
    pub(super) fn new(dimension: usize, stays: &'a SubsetStays) -> Self {
        let of_demonstration = |(demonstration, stays): (usize, &'a Vec<Stay>)| {
            stays.iter().map(move |stay| (demonstration, stay))
        };
        let visits: Vec<Visit> = stays.demonstrations.iter().enumerate().flat_map(of_demonstration).collect();
        let centers = visits.iter().map(|(_, stay)| stay.dwell.center.as_slice());
        Self {
            by_center: Arranged::new(dimension, centers),
            demonstrations: stays.demonstrations.len(),
            typical: typical_length(&visits).max(stays.shortest_left),
            visits,
        }
    }

    /// Those whose centers are in `ball`, demonstration by demonstration.
    pub(super) fn inside(&self, ball: &Ball) -> Vec<Visit<'a>> {
        self.by_center.inside(ball).into_iter().map(|position| self.visits[position]).collect()
    }
}

/// The median of the frames of rests that are not known to be left alone.
pub(super) fn typical_length(visits: &[Visit]) -> f64 {
    let unclear = visits.iter().filter(|(_, stay)| stay.kind == Kind::Rest);
    median(unclear.map(|(_, stay)| stay.dwell.span.len() as f64).collect())
}

/// Whether the thing is known to be left alone on one of the visits.
pub(super) fn is_left_alone(visits: &[Visit]) -> bool {
    visits.iter().any(|(_, stay)| stay.kind == Kind::LeftAlone)
}
