//! Clusterings kept for when there is more to cluster.

use super::candidates::Candidates;
use crate::dbscan::{Before, DbscanParameters, Labels, dbscan, dbscan_of_more};

/// What the last search in a subset knows of the clusters that it looked for.
#[derive(Clone, Debug, Default)]
pub struct Clusterings {
    /// Those of the places where sub-goals are looked for.
    pub(super) places: Option<Clustering>,
    /// Those of the starts.
    pub(super) starts: Option<Clustering>,
    /// Those of the pauses.
    pub(super) pauses: Option<Clustering>,
}

impl Clusterings {
    /// Takes note of other demonstrations: for each one its position among those before, if it was there with the same
    /// track and the same dwells, whatever kinds of stays these are.
    pub fn follow(&mut self, positions: &[Option<usize>]) {
        for clustering in [&mut self.places, &mut self.starts, &mut self.pauses] {
            *clustering = clustering.take().and_then(|clustering| clustering.following(positions));
        }
    }
}

/// Which cluster each candidate was in.
#[derive(Clone, Debug)]
pub(super) struct Clustering {
    density: DbscanParameters,
    reach: f64,
    /// For each demonstration its stretches, ascending by their stays; none for one that has come since.
    demonstrations: Vec<Option<Vec<Labeled>>>,
}

/// The candidates of one stay.
#[derive(Clone, Debug)]
struct Labeled {
    stay: usize,
    points: usize,
    /// What was said of each; of all where it is one.
    before: Vec<Before>,
}

impl Clustering {
    /// The labels of `candidates`, of which some may be known.
    pub(super) fn labels(known: Option<&Self>, candidates: &Candidates, density: DbscanParameters) -> Labels {
        let before = known
            .filter(|known| known.density == density && known.reach.to_bits() == candidates.reach.to_bits())
            .and_then(|known| known.before(candidates));
        match before {
            Some(before) => dbscan_of_more(&candidates.points, density, &before),
            None => dbscan(&candidates.points, density),
        }
    }

    /// What is known of `candidates` that have these labels.
    pub(super) fn of(candidates: &Candidates, density: DbscanParameters, labels: &Labels) -> Self {
        let mut demonstrations = vec![Vec::new(); candidates.demonstrations];
        let mut start = 0;
        for stretch in &candidates.stretches {
            let each =
                (start..stretch.end).map(|at| labels.cluster(at).map_or(Before::Noise, Before::Cluster));
            let mut before: Vec<Before> = each.clone().collect();
            before.dedup();
            if before.len() > 1 {
                before = each.collect();
            }
            let labeled = Labeled { stay: stretch.stay, points: stretch.end - start, before };
            demonstrations[stretch.demonstration].push(labeled);
            start = stretch.end;
        }
        let demonstrations = demonstrations.into_iter().map(Some).collect();
        Self { density, reach: candidates.reach, demonstrations }
    }

    /// What is known of each candidate, unless some that were there are gone.
    fn before(&self, candidates: &Candidates) -> Option<Vec<Before>> {
        let mut before = Vec::with_capacity(candidates.points.len());
        let stretches = self.demonstrations.iter().map(|known| known.as_deref().unwrap_or_default());
        let mut known: Vec<_> = stretches.map(|stretches| stretches.iter().peekable()).collect();
        for stretch in &candidates.stretches {
            let points = stretch.end - before.len();
            let labeled =
                known.get_mut(stretch.demonstration)?.next_if(|labeled| labeled.stay == stretch.stay);
            match labeled {
                Some(labeled) if labeled.points != points => return None,
                Some(Labeled { before: all, .. }) if all.len() == 1 => before.resize(stretch.end, all[0]),
                Some(labeled) => before.extend_from_slice(&labeled.before),
                None => before.resize(stretch.end, Before::New),
            }
        }
        known.iter_mut().all(|left| left.peek().is_none()).then_some(before)
    }

    /// That of other demonstrations, unless some that were there are gone, or in another order, by which ties are broken.
    fn following(mut self, positions: &[Option<usize>]) -> Option<Self> {
        if !positions.iter().flatten().is_sorted() {
            return None;
        }
        let mut take = |position: &Option<usize>| self.demonstrations.get_mut((*position)?)?.take();
        let demonstrations = positions.iter().map(&mut take).collect();
        let is_gone = self.demonstrations.iter().flatten().any(|stretches| !stretches.is_empty());
        (!is_gone).then_some(Self { demonstrations, ..self })
    }
}
