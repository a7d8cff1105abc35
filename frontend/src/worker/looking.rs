//! One subset by itself: how its points lie, and what another epsilon would find in it.

use goalgraph::k_distance::k_distances;
use goalgraph::rest::{SubsetRecording, SubsetStays};
use goalgraph::sub_goal::{Cluster, SubGoalSearch, clustered_points};

use super::recordings::eliminated;
use super::thin::{curve, largest};
use crate::protocol::{Clusters, FoundCluster, KDistanceCurve};

/// How many points are measured: as many as a wide screen has columns.
const MEASURED: usize = 1000;

/// How far the points of a subset that is clustered are from their neighbors.
pub(super) fn curve_of(
    (recording, stays): (&SubsetRecording, Option<&SubsetStays>),
    neighbor: usize,
) -> KDistanceCurve {
    let points = clustered_points(recording, stays);
    curve(&points, &k_distances(&points, neighbor, MEASURED))
}

/// What a search has found, as it travels to the page.
pub(super) fn clusters(search: SubGoalSearch) -> Clusters {
    let (found_in_all, eliminated_in_all) = (search.found.len(), search.eliminated.len());
    let largest_found = largest(search.found, |cluster| cluster.frames);
    let largest_eliminated = largest(search.eliminated, |eliminated| eliminated.cluster.frames);
    Clusters {
        found: largest_found.into_iter().map(found).collect(),
        found_in_all,
        eliminated: largest_eliminated.into_iter().map(eliminated).collect(),
        eliminated_in_all,
    }
}

fn found(Cluster { ball, frames, demonstrations }: Cluster) -> FoundCluster {
    FoundCluster { center: ball.center, radius: ball.radius, frames, demonstrations }
}
