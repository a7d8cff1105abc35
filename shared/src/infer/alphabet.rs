//! Sub-goals put in the order of the alphabet.

use super::subset_study::Found;
use crate::pdfa::Symbol;
use crate::specification::SubGoal;
use crate::sub_goal::Cluster;
use crate::word::{Reached, completions};

/// The sub-goals in order, and where each was reached.
#[derive(Default)]
pub(super) struct Alphabet<'a> {
    pub(super) sub_goals: Vec<SubGoal>,
    /// For each sub-goal and demonstration the frames in which it holds.
    reached: Vec<&'a [Vec<usize>]>,
}

impl<'a> Alphabet<'a> {
    /// Adds the sub-goals of a subset, in the order of the earliest frame in which they are first reached; ties go to the
    /// smaller center.
    pub(super) fn add_subset(&mut self, found: &'a Found) {
        let reached = found.reached.iter().map(Vec::as_slice);
        let mut clusters: Vec<(&[Vec<usize>], &Cluster)> = reached.zip(&found.search.found).collect();
        clusters.sort_by(|(a_frames, a), (b_frames, b)| {
            let by_center = || {
                let pairs = a.ball.center.iter().zip(&b.ball.center);
                pairs.map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne())
            };
            let by_frame = earliest(a_frames).cmp(&earliest(b_frames));
            by_frame.then_with(|| by_center().unwrap_or(std::cmp::Ordering::Equal))
        });
        for (number, (frames, cluster)) in clusters.into_iter().enumerate() {
            self.sub_goals.push(SubGoal {
                id: Symbol(self.sub_goals.len() as u32),
                name: format!("{} {}", found.search.parameters.name, number + 1),
                ball: Some(cluster.ball.clone()),
                frames: cluster.frames,
                demonstrations: cluster.demonstrations,
                color: None,
            });
            self.reached.push(frames);
        }
    }

    /// The word of a demonstration, each symbol with the frame in which it was completed.
    pub(super) fn completions(&self, demonstration: usize) -> Vec<(Symbol, usize)> {
        let pairs = self.sub_goals.iter().zip(&self.reached);
        let reached =
            pairs.map(|(sub_goal, frames)| Reached { symbol: sub_goal.id, frames: &frames[demonstration] });
        completions(&reached.collect::<Vec<_>>())
    }
}

fn earliest(frames: &[Vec<usize>]) -> usize {
    frames.iter().filter_map(|frames| frames.first()).min().copied().unwrap_or(usize::MAX)
}
