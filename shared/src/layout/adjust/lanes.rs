//! Lanes: how edges with the same ends stand beside each other.

use std::collections::BTreeMap;

use super::fates::Fate;
use super::sides::sides;
use super::spots::Spot;
use crate::layout::graph::Graph;
use crate::layout::route::FAN_GAP;

/// Least distance of two ways that an edge can bow out to.
const LEAST_LANE: f64 = 34.0;

/// How an edge stands beside others with the same ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lane {
    /// How far it bows out.
    pub(super) at: f64,
    /// How far its neighbors are from it.
    pub(super) apart: f64,
    /// An edge that stays, which it stands beside.
    pub(super) beside: Option<usize>,
}

/// The lanes of the edges that are routed anew: spread evenly, or in turn to both sides of those that stay.
///
/// # Complexity
///
/// O(E log E) for E edges.
pub(super) fn lanes(graph: &Graph, spots: &[Spot], fates: &[Fate]) -> Vec<Lane> {
    let mut groups: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for at in (0..graph.edges.len()).filter(|&at| !graph.is_loop(at)) {
        let (a, b) = (graph.edges[at].source, graph.edges[at].target);
        groups.entry((a.min(b), a.max(b))).or_default().push(at);
    }
    let mut lanes = vec![Lane { at: 0.0, apart: LEAST_LANE, beside: None }; graph.edges.len()];
    for ((a, b), group) in groups {
        let (routed, kept): (Vec<usize>, Vec<usize>) =
            group.iter().copied().partition(|&edge| fates[edge].is_routed());
        if routed.is_empty() {
            continue;
        }
        let sides = sides(&spots[a].rect(), &spots[b].rect());
        let size = |&edge: &usize| {
            let label = graph.edges[edge].label;
            if sides[0].is_along() { label.height } else { label.width }
        };
        let apart = group.iter().map(size).fold(0.0, f64::max) + FAN_GAP;
        for (at, &edge) in routed.iter().enumerate() {
            let step = match () {
                () if sides[0] == sides[1] => (at + kept.len()) as f64,
                () if kept.is_empty() => at as f64 - (routed.len() - 1) as f64 / 2.0,
                () => aside(at, kept.len()),
            };
            let beside = kept.first().copied();
            lanes[edge] = Lane { at: step * apart, apart: apart.max(LEAST_LANE), beside };
        }
    }
    lanes
}

/// Lanes in turn to both sides of `kept` ones around the middle: 1, -1, 2, -2, ..
fn aside(at: usize, kept: usize) -> f64 {
    let step = (at / 2 + 1) as f64 + (kept - 1) as f64 / 2.0;
    if at.is_multiple_of(2) { step } else { -step }
}
