//! Epsilon and min. points as numbers, and who has chosen them.

use goalgraph::subset::{Setting, SubsetRequest};
use leptos::prelude::*;
use web_sys::HtmlInputElement;

use super::Tuned;
use crate::page::model::Notice;
use crate::page::update::{Action, Tune};
use crate::page::view::settings::{set_epsilon, set_min_points};

/// Both fields, and the button that gives them back to the engine.
pub(super) fn fields(tuned: Tuned) -> impl IntoView {
    let app = tuned.app;
    let chosen = Memo::new(move |_| app.derived.tuning.of.get().map(|of| of.subset).unwrap_or_default());
    let automatic = Memo::new(move |_| {
        chosen.with(|subset| (subset.epsilon == Setting::Auto, subset.min_points == Setting::Auto))
    });
    let epsilon = move || tuned.epsilon.get().to_string();
    let min_points =
        move || app.derived.tuning.subset.with(|it| it.as_ref().map(|it| it.min_points.to_string()));
    let is_tried = move || app.model.tuning.attempt.with(Option::is_some);
    let give_back = move |_| {
        let (epsilon, min_points) = (Some(Setting::Auto), Some(Setting::Auto));
        app.act(Action::Tune(Tune::Choose { epsilon, min_points }));
    };
    view! {
        <div class="field-pair">
            <label class="field">
                <span>{move || format!("epsilon{}", in_brackets(&tuned.unit.get()))}</span>
                <input
                    inputmode="decimal"
                    prop:value=epsilon
                    on:change=move |event| take(tuned, &event, set_epsilon, &untrack(epsilon))
                />
            </label>
            <label class="field">
                <span>"min. points"</span>
                <input
                    inputmode="numeric"
                    prop:value=move || min_points().unwrap_or_default()
                    on:change=move |event| take(tuned, &event, set_min_points, &untrack(min_points).unwrap_or_default())
                />
            </label>
        </div>
        <div class="row">
            <button
                type="button"
                class="button"
                title="Let the engine choose both"
                disabled=move || automatic.get() == (true, true)
                on:click=give_back
            >
                "Automatic"
            </button>
            <span class="hint">{move || (!is_tried()).then(|| chosen_by(automatic.get()))}</span>
        </div>
    }
}

fn in_brackets(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" ({})", unit.trim()) }
}

/// Who has chosen epsilon and min. points.
fn chosen_by((epsilon, min_points): (bool, bool)) -> &'static str {
    match (epsilon, min_points) {
        (true, true) => "chosen by the engine",
        (false, true) => "epsilon by hand",
        (true, false) => "min. points by hand",
        (false, false) => "both by hand",
    }
}

/// Takes what was typed into a field that showed `before`; what makes no sense does not stay in it.
fn take(
    tuned: Tuned,
    event: &web_sys::Event,
    change: fn(&mut SubsetRequest, &str) -> Result<(), String>,
    before: &str,
) {
    let app = tuned.app;
    let Some(of) = app.derived.tuning.of.get_untracked() else { return };
    let mut subset = of.subset.clone();
    let typed = event_target_value(event);
    match change(&mut subset, typed.trim()) {
        Ok(()) if subset == of.subset || typed == before => {}
        Ok(()) => {
            let (epsilon, min_points) = (Some(subset.epsilon), Some(subset.min_points));
            return app.act(Action::Tune(Tune::Choose { epsilon, min_points }));
        }
        Err(reason) => app.act(Action::Say(Notice::alarm(reason))),
    }
    event_target::<HtmlInputElement>(event).set_value(before);
}
