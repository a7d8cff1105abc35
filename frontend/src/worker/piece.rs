//! The pieces of an inference that can be done anywhere. No browser here.

use std::sync::Arc;

use goalgraph::demonstration::{Demonstration, Feature};
use goalgraph::dwell::Scales;
use goalgraph::infer::{DemonstrationKey, Found, Method, RadiusRule, Seen, SubsetStudy};
use goalgraph::points::Track;
use goalgraph::rest::SubsetStays;
use goalgraph::subset::SubsetRequest;
use serde::{Deserialize, Serialize};

/// How a subset is looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Look {
    /// Its name.
    pub(super) name: String,
    /// Its features.
    pub(super) features: Vec<String>,
    /// Which frames count.
    pub(super) method: Method,
}

/// How a subset is searched.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Search {
    /// The subset and its parameters.
    pub(super) request: SubsetRequest,
    /// How large balls are.
    pub(super) radius: RadiusRule,
    /// The scales of its tracks.
    pub(super) scales: Scales,
    /// Its stays, where frames at rest are looked at.
    pub(super) stays: Option<SubsetStays>,
}

/// A piece of an inference: with the values of the subset's tracks it can be done anywhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Piece {
    /// Looks at a subset.
    Look {
        /// How.
        look: Look,
        /// How many frames of each demonstration are beside it.
        lengths: Vec<usize>,
    },
    /// Searches a subset.
    Search {
        /// How.
        search: Search,
        /// How many frames of each demonstration are beside it.
        lengths: Vec<usize>,
    },
}

/// What came of a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Outcome {
    /// What was seen.
    Seen(Seen),
    /// What was found.
    Found(Option<Found>),
}

impl Piece {
    /// Does this piece; `values` are those that belong to it.
    pub(super) fn perform(self, values: &[f64]) -> Outcome {
        match self {
            Self::Look { look: Look { name, features, method }, lengths } => {
                let tracks = tracks_of(&features, &lengths, values);
                let mut study = SubsetStudy::default();
                study.look(&name, &features, method, &keys(&tracks), |index| tracks[index].clone());
                Outcome::Seen(study.seen())
            }
            Self::Search { search: Search { request, radius, scales, stays }, lengths } => {
                let tracks = tracks_of(&request.features, &lengths, values);
                // The tracks are those without wild detections.
                let wild = vec![Vec::new(); tracks.len()];
                let seen = Seen { unclean: scales, clean: scales, wild, stays: stays.clone() };
                let mut study = SubsetStudy::default();
                let track = |index: usize| tracks[index].clone();
                study.look_through(&request.name, &request.features, &keys(&tracks), track, seen);
                study.set_stays(stays);
                study.search(&request, radius);
                Outcome::Found(study.found().cloned())
            }
        }
    }
}

fn keys(tracks: &[Track]) -> Vec<DemonstrationKey> {
    (0..tracks.len()).map(|number| DemonstrationKey(number as u64)).collect()
}

/// How many frames each track reaches over, and the partial state in each of them, undefined where none was observed.
pub(super) fn values_of(tracks: &[Track]) -> (Vec<usize>, Vec<f64>) {
    let (mut lengths, mut values) = (Vec::new(), Vec::new());
    for track in tracks {
        let dimension = track.points.dimension();
        let length = track.len().checked_sub(1).map_or(1, |last| track.frame(last) + 1);
        let start = values.len();
        values.resize(start + length * dimension, f64::NAN);
        for (position, point) in track.points.iter().enumerate() {
            let at = start + track.frame(position) * dimension;
            values[at..at + dimension].copy_from_slice(point);
        }
        lengths.push(length);
    }
    (lengths, values)
}

/// The tracks that reach over so many frames and have these values.
fn tracks_of(names: &[String], lengths: &[usize], mut values: &[f64]) -> Vec<Track> {
    let features: Arc<[Feature]> = names.iter().map(Feature::new).collect();
    let track = |&length: &usize| {
        let (own, others) = values.split_at_checked(length * names.len())?;
        values = others;
        let demonstration = Demonstration::new("", "", Arc::clone(&features), own.to_vec()).ok()?;
        Some(Track::of_features(&demonstration, names))
    };
    lengths.iter().map(track).map(Option::unwrap_or_default).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tracks_are_the_same_after_the_way_between_workers() {
        let names = ["x".to_owned(), "y".to_owned()];
        let features: Arc<[Feature]> = names.iter().map(Feature::new).collect();
        let gap = f64::NAN;
        let recordings: [&[f64]; 4] = [
            &[0.1, 0.2, -3e-7, 1e99],
            &[gap, 1.0],
            &[gap, 1.0, 5.0, 6.0, 7.0, gap, 8.0, 9.0],
            &[1.0, 2.0, gap, gap],
        ];
        let track = |values: &[f64]| {
            let demonstration = Demonstration::new("", "", Arc::clone(&features), values.to_vec()).unwrap();
            Track::of_features(&demonstration, &names)
        };
        let mut tracks = recordings.map(track).to_vec();
        tracks.push(tracks[0].clone().without(&[0]));
        let (lengths, values) = values_of(&tracks);
        assert_eq!(tracks_of(&names, &lengths, &values), tracks);
    }
}
