//! One subset of an inference seen by itself: how its points lie, and what another epsilon would find in it.

use goalgraph::demonstration::Demonstration;
use goalgraph::infer::{InferRequest, Method, RadiusRule};
use goalgraph::k_distance::k_distances;
use goalgraph::points::Track;
use goalgraph::rest::{SubsetRecording, SubsetStays, stays};
use goalgraph::sub_goal::{Cluster, clustered_points, find_sub_goals};
use goalgraph::subset::{SubsetRequest, propose_subsets};

use super::recordings::eliminated;
use super::thin::{curve, largest};
use crate::protocol::{Clusters, FileId, FoundCluster, KDistanceCurve, SubsetOf};

/// How many points are measured: as many as a wide screen has columns.
const MEASURED: usize = 1000;

/// What the searches of an inference start from, whatever their parameters are.
pub(super) struct Look {
    files: Vec<FileId>,
    method: Method,
    subsets: Vec<SubsetRequest>,
    recordings: Vec<SubsetRecording>,
    stays: Option<Vec<SubsetStays>>,
}

impl Look {
    /// Looks at `demonstrations`, those of `files`, through the subsets of `request`.
    pub(super) fn new(files: &[FileId], request: &InferRequest, demonstrations: &[&Demonstration]) -> Self {
        let subsets = match demonstrations.first() {
            Some(first) if request.subsets.is_empty() => propose_subsets(first.features()),
            _ => request.subsets.clone(),
        };
        let recordings: Vec<_> = subsets.iter().map(|subset| recording(subset, demonstrations)).collect();
        let (recordings, stays) = match request.method {
            Method::Published => (recordings, None),
            Method::AtRest => {
                let cleaned: Vec<_> = recordings.iter().map(SubsetRecording::cleaned).collect();
                let stays = stays(&cleaned);
                (cleaned, Some(stays))
            }
        };
        Self { files: files.to_vec(), method: request.method, subsets, recordings, stays }
    }

    /// Whether it is a look at the same files in the same way.
    pub(super) fn is_of(&self, files: &[FileId], request: &InferRequest) -> bool {
        let is_same = |(a, b): (&SubsetRequest, &SubsetRequest)| a.name == b.name && a.features == b.features;
        let same_subsets = request.subsets.is_empty()
            || (request.subsets.len() == self.subsets.len()
                && request.subsets.iter().zip(&self.subsets).all(is_same));
        self.files == files && self.method == request.method && same_subsets
    }

    /// The subset that `of` names.
    pub(super) fn subset(&self, of: &SubsetOf) -> Result<SubsetLook<'_>, String> {
        let index = self.subsets.iter().position(|subset| subset.name == of.subset.name);
        let index = index.ok_or_else(|| format!("there is no subset {}", of.subset.name))?;
        let stays = self.stays.as_ref().map(|stays| &stays[index]);
        Ok(SubsetLook { recording: &self.recordings[index], stays, radius: of.request.radius })
    }
}

/// One subset of a look.
pub(super) struct SubsetLook<'a> {
    recording: &'a SubsetRecording,
    stays: Option<&'a SubsetStays>,
    radius: RadiusRule,
}

impl SubsetLook<'_> {
    /// How far the clustered points are from their neighbors.
    pub(super) fn k_distances(&self, neighbor: usize) -> KDistanceCurve {
        let points = clustered_points(self.recording, self.stays);
        curve(&points, &k_distances(&points, neighbor, MEASURED))
    }

    /// What is found with the parameters of `request`.
    pub(super) fn clusters(&self, request: &SubsetRequest) -> Clusters {
        let search = find_sub_goals(self.recording, self.stays, request, self.radius);
        Clusters {
            found_in_all: search.found.len(),
            eliminated_in_all: search.eliminated.len(),
            found: largest(search.found, |cluster| cluster.frames).into_iter().map(found).collect(),
            eliminated: largest(search.eliminated, |it| it.cluster.frames)
                .into_iter()
                .map(eliminated)
                .collect(),
        }
    }
}

fn recording(subset: &SubsetRequest, demonstrations: &[&Demonstration]) -> SubsetRecording {
    let track = |demonstration: &&Demonstration| {
        let columns = subset.features.iter().filter_map(|name| demonstration.feature_index(name));
        Track::new(demonstration, &columns.collect::<Vec<_>>())
    };
    SubsetRecording::new(&subset.name, &subset.features, demonstrations.iter().map(track).collect())
}

fn found(Cluster { ball, frames, demonstrations }: Cluster) -> FoundCluster {
    FoundCluster { center: ball.center, radius: ball.radius, frames, demonstrations }
}
