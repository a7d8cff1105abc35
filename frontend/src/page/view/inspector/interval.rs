//! How sure a probability is: a band for what the counts allow, a mark for what it is.

use goalgraph::evidence::credible_interval;
use goalgraph::layout::drawing::probability_text;
use leptos::prelude::*;

/// Width of the scale from 0 to 1.
const WIDTH: f64 = 100.0;

/// What was seen of an outcome.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evidence {
    /// How many words showed it.
    pub(super) count: u64,
    /// Of how many.
    pub(super) total: u64,
    /// How many outcomes there are in its state.
    pub(super) outcomes: usize,
    /// Whether an expert has set its weight.
    pub(super) expert: bool,
}

/// The 95 % credible interval of an outcome; the mark is at `probability`. One that an expert has set outside of it stands
/// out.
pub(super) fn band(evidence: Evidence, probability: f64) -> impl IntoView {
    let Evidence { count, total, outcomes, expert } = evidence;
    let interval = credible_interval(count, total, outcomes);
    let (low, high) = (interval.low, interval.high);
    let sentence = format!("95% between {} and {}", probability_text(low), probability_text(high));
    let outside = expert && !(low..=high).contains(&probability);
    view! {
        <span class="band" class:outside=outside title=sentence.clone()>
            <svg width=WIDTH.to_string() height="12" viewBox=format!("0 0 {WIDTH} 12") role="img" aria-label=sentence.clone()>
                <rect class="band-scale" x="0" y="5" width=WIDTH.to_string() height="2" rx="1" />
                <rect class="band-range" x=format!("{:.1}", low * WIDTH) y="2" width=format!("{:.1}", ((high - low) * WIDTH).max(1.0)) height="8" rx="2" />
                <rect class="band-mark" x=format!("{:.1}", probability.clamp(0.0, 1.0) * WIDTH - 1.0) y="0" width="2" height="12" />
            </svg>
            <span class="hint">{format!("{} to {}", probability_text(low), probability_text(high))}</span>
        </span>
    }
}
