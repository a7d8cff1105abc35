//! The Automaton tab: lists, the graph or its table with what an edit would do, the inspector.

use leptos::prelude::*;

use super::chips::{icon_button, nothing_yet, short_button};
use super::{draft, filter, graph, inspector, search, side, table, text_pane};
use crate::page::text::count;
use crate::page::update::App;

/// List, canvas and inspector.
pub(crate) fn automaton(app: App) -> impl IntoView {
    let there = Memo::new(move |_| app.derived.specification.with(Option::is_some));
    move || {
        if !there.get() {
            return nothing_yet(app, "There is no automaton yet. Open demonstrations, or load a sample.")
                .into_any();
        }
        view! {
            <div class="columns">
                {side::side(app)}
                <section class="canvas" aria-label="Graph">
                    {tools(app)}
                    {filter::hidden(app)}
                    {search::search(app)}
                    {move || if app.model.as_table.get() { table::table(app).into_any() } else { graph::graph(app).into_any() }}
                    {draft::draft(app)}
                    {text_pane::text_pane(app)}
                </section>
                {inspector::inspector(app)}
            </div>
        }
        .into_any()
    }
}

fn tools(app: App) -> impl IntoView {
    let size = move || {
        app.derived.specification.with(|specification| {
            specification.as_ref().map(|specification| {
                let transitions = specification.pdfa.transitions().count();
                format!(
                    "{}, {}",
                    count(specification.pdfa.states.len(), "state"),
                    count(transitions, "transition")
                )
            })
        })
    };
    view! {
        <div class="tools" role="toolbar" aria-label="Drawing">
            <div class="row">
                {icon_button(app, "undo", "↶")} {icon_button(app, "redo", "↷")}
                {short_button(app, "fit", "Fit")} {short_button(app, "zoom-out", "−")} {short_button(app, "zoom-in", "+")}
                {short_button(app, "tidy", "Tidy")} {short_button(app, "search", "Search")}
                {short_button(app, "table", "Table")} {short_button(app, "text", "Text")}
            </div>
            <span class="hint size">{size}</span>
            <div class="row end">
                <span class="hint" aria-hidden="true">"Export"</span>
                {short_button(app, "export-json", "JSON")}
                {short_button(app, "export-dot", "DOT")}
                {short_button(app, "export-svg", "SVG")}
            </div>
        </div>
    }
}
