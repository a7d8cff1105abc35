//! What a check found, for people and for machines.

use goalgraph::specification::{Problem, Severity, Specification};
use serde::Serialize;

use super::Read;
use crate::output::count;
use goalgraph::conformance::{Conformance, follow};

/// What `goalgraph check --json` prints.
#[derive(Serialize)]
pub(super) struct Report {
    name: String,
    states: usize,
    transitions: usize,
    sub_goals: usize,
    problems: Vec<ProblemReport>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    conformance: Option<ConformanceReport>,
}

#[derive(Serialize)]
struct ProblemReport {
    severity: &'static str,
    place: String,
    message: String,
}

/// How the demonstrations fare together.
#[derive(Serialize)]
struct ConformanceReport {
    demonstrations: Vec<DemonstrationReport>,
    accepted: usize,
    share: f64,
    /// Sum over the accepted ones.
    log_likelihood: f64,
}

#[derive(Serialize)]
struct DemonstrationReport {
    name: String,
    accepted: bool,
    word: Vec<Option<String>>,
    names: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    log_likelihood: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    deviation: Option<Deviation>,
}

/// Where a demonstration leaves the automaton.
#[derive(Serialize)]
struct Deviation {
    /// Position in the word, from 1; one behind its end when it ends too early.
    position: usize,
    state: String,
    message: String,
}

impl Report {
    /// The findings on `specification`, and on what was `read` with it.
    pub(super) fn new(specification: &Specification, problems: &[Problem], read: Option<&[Read]>) -> Self {
        let problem = |problem: &Problem| ProblemReport {
            severity: match problem.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            place: problem.place().to_string(),
            message: problem.message.clone(),
        };
        Self {
            name: specification.name.clone(),
            states: specification.pdfa.states.len(),
            transitions: specification.pdfa.transitions().count(),
            sub_goals: specification.sub_goals.len(),
            problems: problems.iter().map(problem).collect(),
            conformance: read.map(|read| ConformanceReport::new(specification, read)),
        }
    }

    /// One line for the specification, one per problem, one per demonstration, and one for these together.
    pub(super) fn text(&self) -> String {
        let mut lines = vec![format!(
            "{}: {}, {}, {}, {}",
            self.name,
            count(self.sub_goals, "sub-goal"),
            count(self.states, "state"),
            count(self.transitions, "transition"),
            count(self.problems.len(), "problem")
        )];
        lines.extend(self.problems.iter().map(ProblemReport::line));
        if let Some(conformance) = &self.conformance {
            lines.extend(conformance.demonstrations.iter().map(DemonstrationReport::line));
            lines.push(conformance.line());
        }
        lines.join("\n") + "\n"
    }
}

impl ProblemReport {
    fn line(&self) -> String {
        format!("{}: {}: {}", self.severity, self.place, self.message)
    }
}

impl ConformanceReport {
    fn new(specification: &Specification, read: &[Read]) -> Self {
        let probabilities = specification.pdfa.probabilities(specification.semantics);
        let report = |read: &Read| {
            let symbols: Vec<_> = read.word.iter().map(|(symbol, _)| *symbol).collect();
            DemonstrationReport::new(read, follow(&specification.pdfa, &probabilities, &symbols))
        };
        let demonstrations: Vec<_> = read.iter().map(report).collect();
        let accepted = demonstrations.iter().filter(|demonstration| demonstration.accepted).count();
        let share =
            if demonstrations.is_empty() { 0.0 } else { accepted as f64 / demonstrations.len() as f64 };
        // Not `sum`, which begins with a negative zero.
        let log_likelihood = demonstrations.iter().filter_map(|it| it.log_likelihood).fold(0.0, |a, b| a + b);
        Self { demonstrations, accepted, share, log_likelihood }
    }

    fn line(&self) -> String {
        let (accepted, all) = (self.accepted, self.demonstrations.len());
        let (percent, log_likelihood) = (100.0 * self.share, self.log_likelihood);
        format!("{accepted} of {all} accepted ({percent:.1} %), log-likelihood {log_likelihood:.4}")
    }
}

impl DemonstrationReport {
    fn new(read: &Read, conformance: Conformance) -> Self {
        let names: Vec<String> = read.word.iter().map(|(_, name)| name.clone()).collect();
        let (log_likelihood, deviation) = match conformance {
            Conformance::Accepted { log_likelihood } => (Some(log_likelihood), None),
            Conformance::Deviates { position, state } => {
                let (symbol, name) = &read.word[position];
                let message = match symbol {
                    Some(_) => format!("{name} does not follow in {state}"),
                    None => format!("{name} is no sub-goal"),
                };
                (None, Some(Deviation { position: position + 1, state: state.to_string(), message }))
            }
            Conformance::EndsEarly { state } => {
                let message = format!("it ends in {state}, where the task does not");
                (None, Some(Deviation { position: names.len() + 1, state: state.to_string(), message }))
            }
        };
        let word = read.word.iter().map(|(symbol, _)| symbol.map(|symbol| symbol.to_string())).collect();
        let (name, accepted) = (read.name.clone(), deviation.is_none());
        Self { name, accepted, word, names, log_likelihood, deviation }
    }

    fn line(&self) -> String {
        let word = if self.names.is_empty() { "no sub-goal".to_owned() } else { self.names.join(", ") };
        match (&self.deviation, self.log_likelihood) {
            (Some(Deviation { position, message, .. }), _) => {
                format!("{}: not accepted: position {position}: {message} [{word}]", self.name)
            }
            (None, log_likelihood) => {
                let log_likelihood = log_likelihood.unwrap_or_default();
                format!("{}: accepted, log-likelihood {log_likelihood:.4} [{word}]", self.name)
            }
        }
    }
}
