//! A field for a name.

use leptos::prelude::*;

/// A field that shows `name` and gives what somebody typed to `rename` when it is left or Enter is pressed.
pub(crate) fn name_field(
    label: &'static str,
    name: impl Fn() -> String + Copy + Send + Sync + 'static,
    rename: impl Fn(String) + Copy + 'static,
) -> impl IntoView {
    let changed = move |event: web_sys::Event| {
        let typed = event_target_value(&event);
        if typed != untrack(name) {
            rename(typed);
        }
        // What was refused does not stay in the field.
        event_target::<web_sys::HtmlInputElement>(&event).set_value(&untrack(name));
    };
    view! {
        <label class="field">
            <span>{label}</span>
            <input type="text" dir="auto" data-name-field="" prop:value=name on:change=changed />
        </label>
    }
}
