//! Small parts that many views use: buttons of commands, chips of sub-goals.

use goalgraph::pdfa::Symbol;
use leptos::prelude::*;

use crate::page::commands::command;
use crate::page::keys::shown;
use crate::page::update::App;

/// The button of the command `id`.
pub(crate) fn button(app: App, id: &'static str) -> impl IntoView {
    command(id).map(|command| {
        view! {
            <button
                type="button"
                class="button"
                class:primary=move || id == "open" || (id == "infer" && app.derived.outdated.get())
                title=title(command.help, command.key)
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
                title=title(command.label, command.key)
                disabled=move || !(command.enabled)(app)
                on:click=move |_| (command.run)(app)
            >
                <span aria-hidden="true">{sign}</span>
            </button>
        }
    })
}

fn title(text: &str, key: Option<&str>) -> String {
    key.map_or_else(|| text.to_owned(), |key| format!("{text} ({})", shown(key)))
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
                title=title(command.label, command.key)
                disabled=move || !(command.enabled)(app)
                on:click=move |_| (command.run)(app)
            >
                {text}
            </button>
        }
    })
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
