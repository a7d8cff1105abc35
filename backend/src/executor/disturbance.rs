//! What goes wrong during a simulated run, and when.

use std::collections::BTreeSet;
use std::str::FromStr;

use goalgraph::execution::Observation;
use goalgraph::pdfa::Symbol;
use goalgraph::specification::Specification;

use crate::alphabet;

/// What goes wrong, with sub-goals as people call them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Disturbances {
    /// What is unavailable from the beginning.
    pub unavailable: Vec<String>,
    /// What becomes unavailable during the run.
    pub lost: Vec<Timed>,
    /// What becomes available again during the run.
    pub regained: Vec<Timed>,
    /// At what the robot fails when it works on it.
    pub failing: Vec<String>,
}

/// A sub-goal and a time, written `g1@5`.
#[derive(Clone, Debug, PartialEq)]
pub struct Timed {
    /// The sub-goal, as people call it.
    pub sub_goal: String,
    /// Seconds after the run has begun.
    pub after_s: f64,
}

impl FromStr for Timed {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("{text:?}: expected a sub-goal and seconds, such as g1@5");
        let (sub_goal, seconds) = text.rsplit_once('@').ok_or_else(expected)?;
        let after_s: f64 = seconds.trim().parse().map_err(|_| expected())?;
        if sub_goal.trim().is_empty() || !(0.0..=1e9).contains(&after_s) {
            return Err(expected());
        }
        Ok(Self { sub_goal: sub_goal.trim().to_owned(), after_s })
    }
}

/// The disturbances of one run, by symbols.
#[derive(Clone, Debug, Default)]
pub(super) struct Schedule {
    /// What is unavailable from the beginning.
    pub(super) unavailable: BTreeSet<Symbol>,
    /// What is to come, the next one last.
    ahead: Vec<(f64, Observation)>,
    failing: BTreeSet<Symbol>,
}

impl Disturbances {
    /// What they are in terms of a specification, and one sentence for each that it does not know.
    pub(super) fn schedule(&self, specification: &Specification) -> (Schedule, Vec<String>) {
        let mut faults = Vec::new();
        let mut find =
            |text: &str| alphabet::find(specification, text.trim()).map_err(|fault| faults.push(fault)).ok();
        let unavailable = self.unavailable.iter().filter_map(|text| find(text)).collect();
        let failing = self.failing.iter().filter_map(|text| find(text)).collect();
        let mut ahead: Vec<(f64, Observation)> = Vec::new();
        for Timed { sub_goal, after_s } in &self.lost {
            ahead.extend(find(sub_goal).map(|symbol| (*after_s, Observation::Unavailable(symbol, None))));
        }
        for Timed { sub_goal, after_s } in &self.regained {
            ahead.extend(find(sub_goal).map(|symbol| (*after_s, Observation::Available(symbol))));
        }
        ahead.sort_by(|a, b| b.0.total_cmp(&a.0));
        (Schedule { unavailable, ahead, failing }, faults)
    }
}

impl Schedule {
    /// What has happened since the last call, `elapsed_s` seconds into the run.
    pub(super) fn due(&mut self, elapsed_s: f64) -> Vec<Observation> {
        let first_due = self.ahead.partition_point(|(after_s, _)| *after_s > elapsed_s);
        self.ahead.split_off(first_due).into_iter().rev().map(|(_, observation)| observation).collect()
    }

    /// Whether the robot fails when it works on the sub-goal.
    pub(super) fn fails_at(&self, sub_goal: Symbol) -> bool {
        self.failing.contains(&sub_goal)
    }
}

#[cfg(test)]
mod tests {
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;

    use super::*;

    #[test]
    fn a_time_is_written_after_an_at_sign() {
        let timed = |text: &str| Timed::from_str(text).map(|it| (it.sub_goal, it.after_s));
        assert_eq!(timed("g1@5"), Ok(("g1".to_owned(), 5.0)));
        assert_eq!(timed("at@home @ 0.5"), Ok(("at@home".to_owned(), 0.5)));
        for text in ["g1", "g1@", "@5", "g1@soon", "g1@-1", "g1@NaN", "g1@inf"] {
            assert_eq!(timed(text), Err(format!("{text:?}: expected a sub-goal and seconds, such as g1@5")));
        }
    }

    #[test]
    fn what_happens_comes_in_the_order_of_its_time_and_once() {
        let words = vec!["red".to_owned(), "blue".to_owned()];
        let specification = infer_words("", Semantics::default(), &[words]);
        let timed = |text: &str| Timed::from_str(text).unwrap();
        let disturbances = Disturbances {
            unavailable: vec!["g0".to_owned(), "green".to_owned()],
            lost: vec![timed("blue@2")],
            regained: vec![timed("red@1"), timed("blue@3")],
            failing: vec!["bl".to_owned()],
        };
        let (mut schedule, faults) = disturbances.schedule(&specification);
        assert_eq!(faults, ["there is no sub-goal \"green\"; the sub-goals are g0 (red), g1 (blue)"]);
        assert_eq!(schedule.unavailable, [Symbol(0)].into());
        assert!(schedule.fails_at(Symbol(1)) && !schedule.fails_at(Symbol(0)));
        assert_eq!(schedule.due(0.5), []);
        let expected = [Observation::Available(Symbol(0)), Observation::Unavailable(Symbol(1), None)];
        assert_eq!(schedule.due(2.0), expected);
        assert_eq!(schedule.due(9.0), [Observation::Available(Symbol(1))]);
        assert_eq!(schedule.due(9.0), []);
    }
}
