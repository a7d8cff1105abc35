//! A run on the graph: a ring with a label where it is, and what is said of what it passed and what lies ahead.

use goalgraph::layout::drawing::BOX_RADIUS;
use leptos::prelude::*;

use crate::page::derived::{StateMark, TransitionMark, Way};
use crate::page::run_text::phase;

/// How far the ring is from the box, in pixels.
const RING_GAP: f64 = 6.0;
/// How high the label is, in pixels.
const LABEL_HEIGHT: f64 = 18.0;
/// How wide a character of the label is about, in pixels.
const CHARACTER: f64 = 6.6;

/// The ring around the box of the state that the run is in, with what it does there.
pub(super) fn ring(mark: &StateMark, width: f64, height: f64) -> Option<impl IntoView + use<>> {
    let text = mark.here.clone()?;
    let (full_width, full_height) = (width + 2.0 * RING_GAP, height + 2.0 * RING_GAP);
    let label_width = text.chars().count() as f64 * CHARACTER + 16.0;
    let y = -full_height / 2.0 - LABEL_HEIGHT / 2.0 - 2.0;
    Some(view! {
        <g class=format!("live-ring {}", phase(mark.phase)) aria-hidden="true">
            <rect
                class="ring"
                x=(-full_width / 2.0).to_string()
                y=(-full_height / 2.0).to_string()
                width=full_width.to_string()
                height=full_height.to_string()
                rx=(BOX_RADIUS + RING_GAP).to_string()
            />
            <rect
                class="live-label-back"
                x=format!("{:.1}", -label_width / 2.0)
                y=format!("{:.1}", y - LABEL_HEIGHT / 2.0)
                width=format!("{label_width:.1}")
                height=LABEL_HEIGHT.to_string()
                rx=(LABEL_HEIGHT / 2.0).to_string()
            />
            <text class="live-label" y=format!("{y:.1}")>{text}</text>
        </g>
    })
}

/// The name that tests know the live state by: how the run stands.
pub(super) fn hook(mark: &StateMark) -> Option<&'static str> {
    mark.here.is_some().then(|| phase(mark.phase))
}

/// How faint something is that was passed so many steps ago: from 0 to 4.
pub(super) fn shade(age: usize) -> String {
    age.min(4).to_string()
}

/// What is said of a state.
pub(super) fn state_label(mark: &StateMark, label: String) -> String {
    match (&mark.here, mark.age, mark.ahead) {
        (Some(doing), _, _) if mark.departed => format!("{label}, the run left the automaton here, {doing}"),
        (Some(doing), _, _) => format!("{label}, the run is here, {doing}"),
        (None, Some(_), _) => format!("{label}, passed"),
        (None, None, true) => format!("{label}, ahead"),
        (None, None, false) => label,
    }
}

/// What is said of a transition.
pub(super) fn transition_label(mark: TransitionMark, label: &str) -> String {
    let way = match mark.way {
        Way::Beside => "",
        Way::Taken(_) => ", taken",
        Way::Active => ", being done",
        Way::Ahead => ", ahead",
        Way::Abandoned => ", left by the new plan",
    };
    let unavailable = if mark.unavailable { ", unavailable" } else { "" };
    format!("{label}{way}{unavailable}")
}

/// How faint a transition is.
pub(super) fn age_of(mark: TransitionMark) -> Option<String> {
    match mark.way {
        Way::Taken(age) => Some(shade(age)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_of_a_transition_tells_where_the_run_is_with_it() {
        let said =
            |way, unavailable| transition_label(TransitionMark { way, unavailable }, "red from q0 to q1");
        assert_eq!(said(Way::Beside, false), "red from q0 to q1");
        assert_eq!(said(Way::Taken(3), false), "red from q0 to q1, taken");
        assert_eq!(said(Way::Abandoned, true), "red from q0 to q1, left by the new plan, unavailable");
    }

    #[test]
    fn what_is_said_of_a_state_tells_whether_the_run_is_there() {
        let here = StateMark { here: Some("running: red".to_owned()), ..StateMark::default() };
        assert_eq!(state_label(&here, "State q1".to_owned()), "State q1, the run is here, running: red");
        let passed = StateMark { age: Some(1), ahead: true, ..StateMark::default() };
        assert_eq!(state_label(&passed, "State q1".to_owned()), "State q1, passed");
    }
}
