//! Short lines that say what is being done and how long it has taken so far.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

static STARTED: OnceLock<Instant> = OnceLock::new();

/// Starts the clock of [`say`].
pub(crate) fn start() {
    STARTED.get_or_init(Instant::now);
}

/// Prints one line with the time since [`start`].
pub(crate) fn say(line: &str) {
    println!("[{:>6}] {line}", duration(elapsed()));
}

/// The time since [`start`].
pub(crate) fn elapsed() -> Duration {
    STARTED.get_or_init(Instant::now).elapsed()
}

/// A duration for a reader: `0.4s`, `12s`, `3m 07s`.
pub(crate) fn duration(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..10 => format!("{:.1}s", time.as_secs_f64()),
        10..60 => format!("{seconds}s"),
        _ => format!("{}m {:02}s", seconds / 60, seconds % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_as_exact_as_a_reader_needs() {
        let text = |milliseconds| duration(Duration::from_millis(milliseconds));
        assert_eq!([text(420), text(12_900), text(187_000)], ["0.4s", "12s", "3m 07s"]);
    }
}
