//! What happens in a run, in sentences.

use std::fmt::Write;

use goalgraph::layout::drawing::probability_text;
use goalgraph::pdfa::Symbol;
use goalgraph::protocol::executor::Command;
use goalgraph::protocol::monitor::{Answer, ExecutorView, Held, RunView};
use goalgraph::run::{Departure, Phase, RunEvent};
use goalgraph::specification::Specification;

use super::text::significant;

/// What a sub-goal is called in the specification that a run follows; its id until that is known.
pub(crate) fn name(specification: Option<&Specification>, symbol: Symbol) -> String {
    specification.map_or_else(|| symbol.to_string(), |it| it.name_of(symbol))
}

/// Names of sub-goals, with commas.
pub(crate) fn names(specification: Option<&Specification>, symbols: &[Symbol]) -> String {
    let names: Vec<String> = symbols.iter().map(|&symbol| name(specification, symbol)).collect();
    if names.is_empty() { "nothing".to_owned() } else { names.join(", ") }
}

/// What happened, as a sentence without a full stop.
pub(crate) fn happened(specification: Option<&Specification>, event: &RunEvent) -> String {
    let name = |symbol: Symbol| name(specification, symbol);
    let plan = |what: &str, from, word: &[Symbol], probability| {
        let word = names(specification, word);
        format!("{what} from {from}: {word}; probability {}", probability_text(probability))
    };
    match event {
        RunEvent::Planned { state, word, probability } => plan("Planned", state, word, *probability),
        RunEvent::Replanned { state, word, probability } => plan("Re-planned", state, word, *probability),
        RunEvent::Started { sub_goal } => format!("Started {}", name(*sub_goal)),
        RunEvent::Completed { sub_goal } => format!("Completed {}", name(*sub_goal)),
        RunEvent::Unavailable { sub_goal, reason: Some(reason) } => {
            format!("{} is unavailable: {reason}", name(*sub_goal))
        }
        RunEvent::Unavailable { sub_goal, reason: None } => format!("{} is unavailable", name(*sub_goal)),
        RunEvent::Available { sub_goal } => format!("{} is available again", name(*sub_goal)),
        RunEvent::Waiting { state } => format!("Waits in {state}: no plan is left with what is available"),
        RunEvent::Paused => "Paused".to_owned(),
        RunEvent::Resumed => "Resumed".to_owned(),
        RunEvent::Finished => "Finished".to_owned(),
        RunEvent::Failed { reason } => format!("Failed: {reason}"),
        RunEvent::Stopped => "Stopped".to_owned(),
    }
}

/// A new plan: what cannot be done, and what comes now.
pub(crate) fn replanned(
    specification: Option<&Specification>,
    unavailable: &[Symbol],
    now: &[Symbol],
) -> String {
    let without = match unavailable {
        [] => "everything is available".to_owned(),
        some => format!("{} unavailable", names(specification, some)),
    };
    format!("Re-planned: {without}; now {}", names(specification, now))
}

/// How a run left the automaton.
pub(crate) fn departed(specification: Option<&Specification>, departure: &Departure) -> String {
    match departure {
        Departure::NoWay { state, sub_goal, .. } => {
            format!("Completed {} in {state}, for which there is no way", name(specification, *sub_goal))
        }
        Departure::EndedEarly { state, .. } => format!("Finished in {state}, where the task does not end"),
    }
}

/// How a run stands, in a word.
pub(crate) fn phase(phase: Phase) -> &'static str {
    match phase {
        Phase::Running => "running",
        Phase::Waiting => "waiting",
        Phase::Paused => "paused",
        Phase::Finished => "finished",
        Phase::Failed => "failed",
        Phase::Stopped => "stopped",
    }
}

/// How surprising a log-likelihood is.
pub(crate) fn surprise(log_likelihood: f64) -> String {
    format!("{} bits", significant(-log_likelihood / std::f64::consts::LN_2))
}

/// Where a run is and what it does, as what is read at its state.
pub(crate) fn doing(specification: Option<&Specification>, run: &RunView) -> String {
    if run.departure.is_some() {
        return "left the automaton".to_owned();
    }
    let mut text = phase(run.phase).to_owned();
    if let Some(active) = run.active {
        // Writing to a string cannot fail.
        let _ = write!(text, ": {}", name(specification, active));
    }
    text
}

/// The first characters of a run's id: enough to tell runs apart by eye.
pub(crate) fn short_id(id: &str) -> &str {
    id.char_indices().nth(8).map_or(id, |(end, _)| &id[..end])
}

/// What a command is called.
pub(crate) fn command(command: Command) -> &'static str {
    match command {
        Command::Start => "Start",
        Command::Pause => "Pause",
        Command::Resume => "Resume",
        Command::Stop => "Stop",
    }
}

/// Why a command makes no sense for an executor in this run; none when it does.
pub(crate) fn refusal(executor: &ExecutorView, run: Option<&RunView>, command: Command) -> Option<String> {
    let name = &executor.executor;
    if !executor.connected {
        return Some(format!("{name} is not connected"));
    }
    let open = run.filter(|run| !run.phase.is_over());
    match (command, open.map(|run| run.phase)) {
        (Command::Start, Some(_)) => Some(format!("{name} is in a run already")),
        (Command::Start, None) => match &executor.holds {
            None => Some(format!("{name} holds no specification: approve a revision")),
            Some(Held { answer: Answer::Accepted, .. }) => None,
            Some(Held { answer: Answer::Awaited, .. }) => {
                Some(format!("{name} has not accepted its specification yet"))
            }
            Some(Held { answer: Answer::Rejected { .. }, .. }) => {
                Some(format!("{name} has rejected its specification"))
            }
        },
        (_, None) => Some(format!("{name} is in no run")),
        (Command::Pause, Some(Phase::Paused)) => Some("The run is paused already".to_owned()),
        (Command::Resume, Some(Phase::Running | Phase::Waiting)) => Some("The run is not paused".to_owned()),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
