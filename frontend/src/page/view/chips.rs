//! Small parts that many views use: buttons of commands, chips of sub-goals.

use goalgraph::edit::Edit;
use goalgraph::pdfa::{StateId, Symbol};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, KeyboardEvent};

use crate::page::commands::command;
use crate::page::keys::shown;
use crate::page::model::Selection;
use crate::page::update::{Action, App};

/// The button of the command `id`.
pub(crate) fn button(app: App, id: &'static str) -> impl IntoView {
    command(id).map(|command| {
        view! {
            <button
                type="button"
                class="button"
                class:primary=move || matches!(id, "open" | "apply") || (id == "infer" && app.derived.outdated.get())
                title=title(command.help, command.keys)
                disabled=move || !(command.enabled)(app)
                on:click=move |_| (command.run)(app)
            >
                {command.label}
            </button>
        }
    })
}

/// The button of the command `id` with a sign in place of its label.
pub(crate) fn icon_button(app: App, id: &'static str, sign: &'static str) -> impl IntoView {
    command(id).map(|command| {
        view! {
            <button
                type="button"
                class="icon-button"
                aria-label=command.label
                title=title(command.label, command.keys)
                disabled=move || !(command.enabled)(app)
                on:click=move |_| (command.run)(app)
            >
                <span aria-hidden="true">{sign}</span>
            </button>
        }
    })
}

fn title(text: &str, keys: &[&str]) -> String {
    keys.first().map_or_else(|| text.to_owned(), |key| format!("{text} ({})", shown(key)))
}

/// A button of the command `id` that shows less than its whole label.
pub(crate) fn short_button(app: App, id: &'static str, text: &'static str) -> impl IntoView {
    command(id).map(|command| {
        view! {
            <button
                type="button"
                class="button"
                class:primary={id == "open"}
                aria-label=command.label
                title=title(command.label, command.keys)
                disabled=move || !(command.enabled)(app)
                on:click=move |_| (command.run)(app)
            >
                {text}
            </button>
        }
    })
}

/// A button for edits: resting on it shows what they would do, pressing it begins them.
pub(crate) fn edit_button(
    app: App,
    label: &'static str,
    edits: impl Fn() -> Vec<Edit> + Clone + 'static,
) -> impl IntoView {
    let (enter, focus, begin) = (edits.clone(), edits.clone(), edits);
    on_cleanup(move || app.act(Action::ConsiderNoMore));
    view! {
        <button
            type="button"
            class="button"
            on:pointerenter=move |_| app.act(Action::Consider(enter()))
            on:pointerleave=move |_| app.act(Action::ConsiderNoMore)
            on:focus=move |_| app.act(Action::Consider(focus()))
            on:blur=move |_| app.act(Action::ConsiderNoMore)
            on:click=move |_| app.act(Action::Begin(begin()))
        >
            {label}
        </button>
    }
}

/// A state to go to.
pub(crate) fn to_state(app: App, id: StateId) -> impl IntoView {
    let go = move |_| app.act(Action::Select(Some(Selection::State(id))));
    view! { <button type="button" class="link" on:click=go>{id.to_string()}</button> }
}

/// Arrow keys go from tab to tab of `number` ones; `go` shows one and gives the id of its button.
pub(crate) fn step_tabs(event: &KeyboardEvent, at: usize, number: usize, go: impl Fn(usize) -> String) {
    let next = match event.key().as_str() {
        "ArrowRight" => (at + 1) % number,
        "ArrowLeft" => at.checked_sub(1).unwrap_or(number - 1),
        "Home" => 0,
        "End" => number - 1,
        _ => return,
    };
    event.prevent_default();
    let button = document().get_element_by_id(&go(next));
    if let Some(button) = button.and_then(|button| button.dyn_into::<HtmlElement>().ok()) {
        // An element of this page always takes the focus.
        let _ = button.focus();
    }
}

/// A sub-goal: its name on its color.
pub(crate) fn chip(app: App, symbol: Symbol) -> impl IntoView {
    let name =
        app.derived.specification.with(|specification| specification.as_ref().map(|it| it.name_of(symbol)));
    let class = app.derived.colors.with(|colors| colors.get(&symbol).map(|color| color.class()));
    view! { <span class=format!("chip {}", class.unwrap_or_default())>{name}</span> }
}

/// What a tab shows while there is no automaton.
pub(crate) fn nothing_yet(app: App, sentence: &'static str) -> impl IntoView {
    view! {
        <section class="nothing">
            <p>{sentence}</p>
            <div class="row">{button(app, "open")} {button(app, "sample")}</div>
        </section>
    }
}
