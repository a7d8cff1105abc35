//! What an inference found, for people and for machines.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use goalgraph::infer::Inference;
use goalgraph::pdfa::Semantics;
use serde::Serialize;

use crate::output::{self, count};

/// The summary that `goalgraph infer --json` prints.
#[derive(Serialize)]
pub(super) struct Report {
    name: String,
    output: String,
    semantics: Semantics,
    demonstrations: usize,
    frames: usize,
    subsets: Vec<SubsetReport>,
    sub_goals: Vec<SubGoalReport>,
    distinct_words: usize,
    states: usize,
    transitions: usize,
    accepting: usize,
    eliminated: Vec<EliminatedReport>,
    notes: Vec<String>,
    seconds: f64,
}

#[derive(Serialize)]
struct SubsetReport {
    name: String,
    epsilon: f64,
    min_points: usize,
    min_dwell: usize,
}

#[derive(Serialize)]
struct SubGoalReport {
    id: String,
    name: String,
    demonstrations: usize,
}

#[derive(Serialize)]
struct EliminatedReport {
    subset: String,
    frames: usize,
    demonstrations: usize,
    reason: String,
}

impl Report {
    /// What `inference` found in `seconds`, and where it was written.
    pub(super) fn new(inference: &Inference, output: &Path, seconds: f64) -> Self {
        let specification = &inference.specification;
        let states = &specification.pdfa.states;
        let words: BTreeSet<_> = specification.demonstrations.iter().map(|it| &it.word).collect();
        let subsets = specification.subsets.iter().map(|subset| SubsetReport {
            name: subset.name.clone(),
            epsilon: subset.epsilon,
            min_points: subset.min_points,
            min_dwell: subset.min_dwell,
        });
        let sub_goals = specification.sub_goals.iter().map(|sub_goal| SubGoalReport {
            id: sub_goal.id.to_string(),
            name: sub_goal.name.clone(),
            demonstrations: sub_goal.demonstrations,
        });
        let eliminated = inference.eliminated.iter().map(|eliminated| EliminatedReport {
            subset: eliminated.cluster.ball.subset.clone(),
            frames: eliminated.cluster.frames,
            demonstrations: eliminated.cluster.demonstrations,
            reason: eliminated.reason.clone(),
        });
        Self {
            name: specification.name.clone(),
            output: output.display().to_string(),
            semantics: specification.semantics,
            demonstrations: specification.demonstrations.len(),
            frames: specification.demonstrations.iter().map(|it| it.frames).sum(),
            subsets: subsets.collect(),
            sub_goals: sub_goals.collect(),
            distinct_words: words.len(),
            states: states.len(),
            transitions: specification.pdfa.transitions().count(),
            accepting: states.values().filter(|state| state.accepting).count(),
            eliminated: eliminated.collect(),
            notes: inference.notes.clone(),
            seconds,
        }
    }

    /// Says it on standard error.
    pub(super) fn say(&self) {
        output::say(&format!(
            "{}, {}, {}, {}, {}, {} accepting",
            count(self.demonstrations, "demonstration"),
            count(self.sub_goals.len(), "sub-goal"),
            count(self.distinct_words, "distinct word"),
            count(self.states, "state"),
            count(self.transitions, "transition"),
            self.accepting,
        ));
        for sub_goal in self.sub_goals.iter().filter(|_| !self.subsets.is_empty()) {
            let (reached, all) = (sub_goal.demonstrations, self.demonstrations);
            output::say(&format!("  {}  {}: in {reached} of {all}", sub_goal.id, sub_goal.name));
        }
        for (line, times) in self.eliminated_lines() {
            let times = if times > 1 { format!(" ({times} clusters)") } else { String::new() };
            output::say(&format!("{line}{times}"));
        }
        for note in &self.notes {
            output::say(&format!("note: {note}"));
        }
    }

    /// What was eliminated and why, equal lines once, with how often each is there.
    fn eliminated_lines(&self) -> BTreeMap<String, usize> {
        let mut lines = BTreeMap::new();
        for cluster in &self.eliminated {
            *lines.entry(format!("eliminated: {}: {}", cluster.subset, cluster.reason)).or_default() += 1;
        }
        lines
    }
}
