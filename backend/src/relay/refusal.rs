//! What an executor is told when its message is not taken, in one clear sentence each.

use goalgraph::protocol::executor::{Denial, MAX_ID, Refusal, ToExecutor};

/// A refusal that is about no run.
pub(super) fn refused(reason: Refusal, message: impl Into<String>) -> ToExecutor {
    ToExecutor::Refused { reason, message: message.into(), run: None, expected: None }
}

/// A refusal about a run.
pub(super) fn refused_in(
    run: &str,
    reason: Refusal,
    message: impl Into<String>,
    expected: Option<u64>,
) -> ToExecutor {
    // A run that no id could be of is not repeated.
    let run = is_id(run).then(|| run.to_owned());
    ToExecutor::Refused { reason, message: message.into(), run, expected }
}

/// No lease.
pub(super) fn denied(run: &str, reason: Denial) -> ToExecutor {
    let message = match reason {
        Denial::Held => format!("run {run}: another executor holds its lease"),
        Denial::Stale => format!("run {run}: a run may begin with the approved revision only"),
        Denial::NotAccepted => format!("run {run}: accept the specification before a run of it begins"),
        Denial::Over => format!("run {run}: it is over"),
        Denial::OtherSpecification => format!("run {run}: it follows a revision with another SHA-256"),
        Denial::BadId => {
            format!("the id of a run has 1 to {MAX_ID} characters, none of them a control character")
        }
    };
    let run: String = run.chars().take(MAX_ID).collect();
    ToExecutor::Denied { run, reason, message }
}

/// An event before it is missing.
pub(super) fn gap(run: &str, number: u64, expected: u64) -> ToExecutor {
    let message = format!("run {run}: event {number} came where event {expected} was expected");
    refused_in(run, Refusal::Gap, message, Some(expected))
}

/// The number has another event.
pub(super) fn conflict(run: &str, number: u64, expected: u64) -> ToExecutor {
    let message = format!("run {run}: another event {number} is stored; event {expected} is expected");
    refused_in(run, Refusal::Conflict, message, Some(expected))
}

/// The run is over.
pub(super) fn over(run: &str, last: u64) -> ToExecutor {
    refused_in(run, Refusal::Over, format!("run {run}: it is over since event {last}"), None)
}

/// Somebody else holds the run, or nobody.
pub(super) fn no_lease(run: &str) -> ToExecutor {
    let message = "this connection does not hold the run's lease; begin the run first";
    refused_in(run, Refusal::NoLease, message, None)
}

/// The store does not store.
pub(super) fn unavailable(run: &str, expected: Option<u64>) -> ToExecutor {
    refused_in(
        run,
        Refusal::Unavailable,
        "nothing can be stored at the moment; send it again later",
        expected,
    )
}

/// The run has as many events as a run may have.
pub(super) fn too_long(run: &str, limit: u64, expected: u64) -> ToExecutor {
    let message =
        format!("run {run}: it has {limit} events, the most that are taken; end it and begin another");
    refused_in(run, Refusal::TooMany, message, Some(expected))
}

/// Whether `text` can be the id of a run or the name of an executor.
pub(super) fn is_id(text: &str) -> bool {
    // In bytes first: the text may be as long as a message.
    let is_short = text.len() <= 4 * MAX_ID && text.chars().count() <= MAX_ID;
    is_short && !text.is_empty() && !text.chars().any(char::is_control)
}
