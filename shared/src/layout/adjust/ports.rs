//! Ports: where edges meet the sides of their boxes.

use std::collections::BTreeMap;

use super::fates::Fate;
use super::lanes::Lane;
use super::sides::{Side, sides};
use super::spots::Spot;
use crate::layout::graph::Graph;
use crate::layout::route::port_gap;
use crate::layout::{EdgePath, StartArrow};

/// Least distance that a new port would like to keep from one that stays, what a pixel less costs, and how fine places
/// are tried.
const NEAREST: f64 = 13.0;
const NEAR_COST: f64 = 5.0;
const FINENESS: f64 = 3.0;

/// An end of an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Port {
    pub(super) side: Side,
    /// From the middle of the side.
    pub(super) offset: f64,
}

/// Ports of the edges that are routed anew, at their sources and at their targets. Edges spread evenly over a side in the
/// order of where they lead; beside edges that stay they take what is free.
///
/// # Complexity
///
/// O(E log E) for E edges.
pub(super) fn ports(
    graph: &Graph,
    spots: &[Spot],
    fates: &[Fate],
    old: &[Option<&EdgePath>],
    lanes: &[Lane],
    start: Option<&StartArrow>,
) -> Vec<[Port; 2]> {
    let mut ports = vec![[Port { side: Side::Right, offset: 0.0 }; 2]; graph.edges.len()];
    let mut groups: BTreeMap<(usize, Side), Vec<Wish>> = BTreeMap::new();
    let routed = |edge: &usize| fates[*edge].is_routed() && !graph.is_loop(*edge);
    for edge in (0..graph.edges.len()).filter(routed) {
        let ends = [graph.edges[edge].source, graph.edges[edge].target];
        let sides = sides(&spots[ends[0]].rect(), &spots[ends[1]].rect());
        for end in 0..2 {
            let other = spots[ends[1 - end]].center;
            let along = if sides[end].is_along() { other.y } else { other.x };
            let beside = lanes[edge].beside.and_then(|beside| {
                let old = old[beside]?;
                let point = if graph.edges[beside].source == ends[end] {
                    old.path.first()?.start
                } else {
                    old.arrow.tip
                };
                let (side, offset) = Side::of(&spots[ends[end]].rect(), point);
                (side == sides[end]).then_some(offset + NEAREST * lanes[edge].at / lanes[edge].apart)
            });
            let before =
                old[edge].and_then(|old| port_before(&spots[ends[end]], old, end, sides[end])).or(beside);
            groups.entry((ends[end], sides[end])).or_default().push(Wish { along, edge, end, before });
        }
    }
    let mut kept = kept_ports(graph, spots, fates, old, &groups);
    if let (Some(node), Some(start)) = (graph.initial, start) {
        let (side, offset) = Side::of(&spots[node].rect(), start.arrow.tip);
        kept.entry((node, side)).or_default().push(offset);
    }
    for ((node, side), mut wishes) in groups {
        wishes.sort_by(|a, b| a.along.total_cmp(&b.along).then(a.edge.cmp(&b.edge)));
        let kept = kept.remove(&(node, side)).unwrap_or_default();
        for (wish, offset) in wishes.iter().zip(offsets(&spots[node], side, &wishes, kept)) {
            ports[wish.edge][wish.end] = Port { side, offset };
        }
    }
    ports
}

/// An end of an edge that a side has to take.
struct Wish {
    /// Where the other end is, along the side.
    along: f64,
    edge: usize,
    /// 0 at the source, 1 at the target.
    end: usize,
    /// The offset it had, if on this side of a box that stays.
    before: Option<f64>,
}

fn port_before(spot: &Spot, old: &EdgePath, end: usize, side: Side) -> Option<f64> {
    let point = if end == 0 { old.path.first()?.start } else { old.arrow.tip };
    let (before, offset) = Side::of(&spot.rect(), point);
    (before == side && !spot.is_changed()).then_some(offset)
}

/// Offsets of the ends of edges that stay, on the sides that get new ones.
fn kept_ports(
    graph: &Graph,
    spots: &[Spot],
    fates: &[Fate],
    old: &[Option<&EdgePath>],
    groups: &BTreeMap<(usize, Side), Vec<Wish>>,
) -> BTreeMap<(usize, Side), Vec<f64>> {
    let mut touched = vec![false; spots.len()];
    for &(node, _) in groups.keys() {
        touched[node] = true;
    }
    let mut kept: BTreeMap<(usize, Side), Vec<f64>> = BTreeMap::new();
    for (at, edge) in graph.edges.iter().enumerate() {
        let (Some(shift), Some(old)) = (fates[at].shift(), old[at]) else {
            continue;
        };
        let first = old.path.first().map(|curve| curve.start);
        for (node, point) in [(edge.source, first), (edge.target, Some(old.arrow.tip))] {
            if let Some(point) = point.filter(|_| touched[node]) {
                let (side, offset) = Side::of(&spots[node].rect(), point.shifted(shift));
                kept.entry((node, side)).or_default().push(offset);
            }
        }
    }
    kept
}

/// One offset for every wish, in ascending order when no port is kept.
fn offsets(spot: &Spot, side: Side, wishes: &[Wish], mut taken: Vec<f64>) -> Vec<f64> {
    let reach = side.reach(spot.size);
    if taken.is_empty() {
        let length = if side.is_along() { spot.size.height } else { spot.size.width };
        let gap = port_gap(length, wishes.len());
        let first = (wishes.len().max(1) - 1) as f64 / 2.0;
        return (0..wishes.len()).map(|at| (at as f64 - first) * gap).collect();
    }
    let middle = if side.is_along() { spot.center.y } else { spot.center.x };
    let place = |wish: &Wish| {
        let best = wish.before.unwrap_or(wish.along - middle).clamp(-reach, reach);
        let offset = free_offset(best, reach, &taken);
        taken.push(offset);
        offset
    };
    wishes.iter().map(place).collect()
}

/// The offset close to `best` and apart from those taken.
fn free_offset(best: f64, reach: f64, taken: &[f64]) -> f64 {
    let cost = |offset: f64| {
        let near = taken.iter().map(|other| (NEAREST - (offset - other).abs()).max(0.0));
        (offset - best).abs() + NEAR_COST * near.sum::<f64>()
    };
    let steps = (2.0 * reach / FINENESS).min(200.0) as usize;
    let tries = (0..=steps).map(|step| reach * (2.0 * step as f64 / steps.max(1) as f64 - 1.0));
    let cheapest = tries.chain([best]).map(|offset| (cost(offset), offset));
    cheapest.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(best, |(_, offset)| offset)
}
