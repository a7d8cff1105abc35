//! One subset by itself: how its points lie, and what another epsilon would find in it.

use goalgraph::infer::Study;
use goalgraph::k_distance::k_distances;
use goalgraph::sub_goal::{Cluster, clustered_points};

use super::recordings::eliminated;
use super::thin::{curve, largest};
use crate::protocol::{Clusters, FoundCluster, KDistanceCurve, SubsetOf};

/// How many points are measured: as many as a wide screen has columns.
const MEASURED: usize = 1000;

/// How far the points of a subset that is clustered are from their neighbors; none where `study` does not know it.
pub(super) fn curve_of(study: &Study, of: &SubsetOf, neighbor: usize) -> Option<KDistanceCurve> {
    let (recording, stays) = study.recording(&of.subset)?;
    let points = clustered_points(recording, stays);
    Some(curve(&points, &k_distances(&points, neighbor, MEASURED)))
}

/// What is found in a subset with the parameters that it has; none where `study` does not know it.
pub(super) fn clusters_of(study: &Study, of: &SubsetOf) -> Option<Clusters> {
    let search = study.sub_goals(&of.subset, of.request.radius)?;
    let (found_in_all, eliminated_in_all) = (search.found.len(), search.eliminated.len());
    let largest_found = largest(search.found, |cluster| cluster.frames);
    let largest_eliminated = largest(search.eliminated, |eliminated| eliminated.cluster.frames);
    Some(Clusters {
        found: largest_found.into_iter().map(found).collect(),
        found_in_all,
        eliminated: largest_eliminated.into_iter().map(eliminated).collect(),
        eliminated_in_all,
    })
}

fn found(Cluster { ball, frames, demonstrations }: Cluster) -> FoundCluster {
    FoundCluster { center: ball.center, radius: ball.radius, frames, demonstrations }
}
