//! The specification as text, beside the picture.

use goalgraph::export::{ExportFormat, export};
use leptos::prelude::*;

use crate::page::model::TextPane;
use crate::page::update::{Action, App};
use crate::page::view::chips::short_button;

/// The text, where somebody wants it.
pub(crate) fn text_pane(app: App) -> impl IntoView {
    move || app.model.text_pane.get().map(|pane| shown(app, pane))
}

fn shown(app: App, pane: TextPane) -> impl IntoView {
    let text = move || {
        let specification = app.derived.specification.get()?;
        Some(match pane {
            TextPane::Json => specification.to_json(),
            TextPane::Dot => export(&specification, ExportFormat::Dot),
        })
    };
    let choice = move |name: &'static str, of: TextPane| {
        view! {
            <button
                type="button"
                class="button"
                aria-pressed=(pane == of).to_string()
                on:click=move |_| app.act(Action::ShowText(Some(of)))
            >
                {name}
            </button>
        }
    };
    let export = if pane == TextPane::Dot { "export-dot" } else { "export-json" };
    view! {
        <section class="text-pane" aria-label="Text">
            <div class="row">
                {choice("DOT", TextPane::Dot)}
                {choice("JSON", TextPane::Json)}
                <span class="hint">"Follows every edit. Drop a DOT or specification file on the page to open it."</span>
                <div class="row end">{short_button(app, export, "Save")} {short_button(app, "text", "Close")}</div>
            </div>
            <pre tabindex="0" aria-label="Text of the specification">{text}</pre>
        </section>
    }
}
