//! Sub-goals that are not used, or whose balls overlap.

use std::collections::BTreeSet;

use super::{Problem, ProblemKind, Severity};
use crate::specification::{Ball, Specification};

pub(super) fn sub_goal_problems(specification: &Specification) -> Vec<Problem> {
    let used: BTreeSet<_> = specification.pdfa.transitions().map(|(_, symbol, _)| symbol).collect();
    let severity = Severity::Warning;
    let mut problems = Vec::new();
    for (index, sub_goal) in specification.sub_goals.iter().enumerate() {
        if !used.contains(&sub_goal.id) {
            let message = format!("{} is used by no transition", sub_goal.name);
            problems.push(Problem { severity, kind: ProblemKind::Unused(sub_goal.id), message });
        }
        for other in &specification.sub_goals[..index] {
            if let (Some(ball), Some(other_ball)) = (&sub_goal.ball, &other.ball)
                && overlap(ball, other_ball)
            {
                let message = format!("the balls of {} and {} overlap", other.name, sub_goal.name);
                let kind = ProblemKind::Overlap(other.id, sub_goal.id);
                problems.push(Problem { severity, kind, message });
            }
        }
    }
    problems
}

fn overlap(a: &Ball, b: &Ball) -> bool {
    if a.subset != b.subset {
        return false;
    }
    let squared: f64 = a.center.iter().zip(&b.center).map(|(x, y)| (x - y) * (x - y)).sum();
    squared.sqrt() < a.radius + b.radius
}
