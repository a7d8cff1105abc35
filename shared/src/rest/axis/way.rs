//! The ways on which a thing comes to a dwell and leaves it.

use super::super::Stay;
use crate::dwell::Dwell;
use crate::points::{Track, distance};

/// How far a thing may get while it is not observed, as a share of the reach, for its direction to be known.
const LARGEST_STEP: f64 = 0.4;

/// How a thing comes to a dwell or leaves it.
pub(super) enum Way {
    /// Along this unit vector.
    Direction(Vec<f64>),
    /// It was not seen.
    Unseen,
    /// It is never far from the dwell.
    Near,
}

impl Way {
    pub(super) fn direction(self) -> Option<Vec<f64>> {
        match self {
            Self::Direction(direction) => Some(direction),
            Self::Unseen | Self::Near => None,
        }
    }
}

/// How the thing comes to stay `index` from `reach` away, or from the stay before where that is nearer.
pub(super) fn arrival(track: &Track, stays: &[Stay], index: usize, reach: f64, stop: Stop) -> Way {
    let dwell = &stays[index].dwell;
    let earlier = index.checked_sub(1).map(|before| &stays[before].dwell).filter(|_| stop == Stop::AtStays);
    let first = earlier.map_or(0, |earlier| earlier.span.end - 1);
    let edge = far_edge(track, dwell, (first..dwell.span.start).rev(), dwell.span.start, reach);
    edge.way(track, earlier, |far| direction(far, &dwell.center))
}

/// How the thing leaves stay `index` until it is `reach` away, or to the stay after where that is nearer.
pub(super) fn departure(track: &Track, stays: &[Stay], index: usize, reach: f64, stop: Stop) -> Way {
    let dwell = &stays[index].dwell;
    let later = stays.get(index + 1).map(|after| &after.dwell).filter(|_| stop == Stop::AtStays);
    let last = later.map_or(track.len(), |later| later.span.start + 1);
    let edge = far_edge(track, dwell, dwell.span.end..last, dwell.span.end - 1, reach);
    edge.way(track, later, |far| direction(&dwell.center, far))
}

/// Whether a direction is taken to the neighboring stay when that is nearer than the reach.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
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
        if track.frame(index).abs_diff(track.frame(previous)) > 1 && step > LARGEST_STEP * reach {
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
