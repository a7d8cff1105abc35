//! What happens, one line each, for whoever looks on.

use goalgraph::pdfa::Symbol;
use goalgraph::run::RunEvent;
use goalgraph::specification::Specification;

use super::work::Report;

/// The line about an event, such as `3 completed red 1 (g0)`.
pub(super) fn of_event(specification: &Specification, report: &Report) -> String {
    let name = |symbol: &Symbol| format!("{} ({symbol})", specification.name_of(*symbol));
    let order = |word: &[Symbol]| {
        word.iter().map(|&symbol| specification.name_of(symbol)).collect::<Vec<_>>().join(", ")
    };
    let text = match &report.happened {
        RunEvent::Planned { state, word, probability } => {
            format!("plan from {state}, probability {probability:.4}: {}", order(word))
        }
        RunEvent::Replanned { state, word, probability } => {
            format!("new plan from {state}, probability {probability:.4}: {}", order(word))
        }
        RunEvent::Started { sub_goal } => format!("works on {}", name(sub_goal)),
        RunEvent::Completed { sub_goal } => format!("completed {}", name(sub_goal)),
        RunEvent::Unavailable { sub_goal, reason: None } => format!("{} is unavailable", name(sub_goal)),
        RunEvent::Unavailable { sub_goal, reason: Some(reason) } => {
            format!("{} is unavailable: {reason}", name(sub_goal))
        }
        RunEvent::Available { sub_goal } => format!("{} is available again", name(sub_goal)),
        RunEvent::Waiting { state } => {
            format!("no plan from {state}: waits until something becomes available")
        }
        RunEvent::Paused => "paused".to_owned(),
        RunEvent::Resumed => "goes on after the pause".to_owned(),
        RunEvent::Finished => "finished".to_owned(),
        RunEvent::Failed { reason } => format!("failed: {reason}"),
        RunEvent::Stopped => "stopped".to_owned(),
    };
    format!("{:>4} {text}", report.number)
}

/// The beginning of a SHA-256, enough to compare by eye.
pub(super) fn short(sha256: &str) -> &str {
    sha256.get(..12).unwrap_or(sha256)
}
