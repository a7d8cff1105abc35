//! The field to look for states and transitions, over the graph.

use leptos::html::Input;
use leptos::prelude::*;
use web_sys::KeyboardEvent;

use crate::page::update::{Action, App};

/// The field, while somebody looks for something.
pub(crate) fn search(app: App) -> impl IntoView {
    let open = Memo::new(move |_| app.model.search.with(|search| search.text.is_some()));
    move || open.get().then(|| field(app))
}

fn field(app: App) -> impl IntoView {
    let node = NodeRef::<Input>::new();
    Effect::new(move |_| {
        if let Some(field) = node.get() {
            // An element of this page always takes the focus.
            let _ = field.focus();
        }
    });
    let press = move |event: KeyboardEvent| {
        match event.key().as_str() {
            "Enter" => app.act(Action::NextHit(if event.shift_key() { -1 } else { 1 })),
            "Escape" => app.act(Action::Search(None)),
            _ => return,
        }
        event.prevent_default();
        event.stop_propagation();
    };
    let found = move || {
        let (hits, at) = (app.derived.hits.with(Vec::len), app.model.search.with(|search| search.at));
        let typed =
            app.model.search.with(|search| search.text.as_ref().is_some_and(|text| !text.trim().is_empty()));
        match hits {
            0 if !typed => String::new(),
            0 => "nothing found".to_owned(),
            _ => format!("{} of {hits}", at % hits + 1),
        }
    };
    view! {
        <div class="search" role="search">
            <input
                node_ref=node
                type="text"
                aria-label="Search states and transitions"
                placeholder="State, sub-goal or name"
                prop:value=move || app.model.search.with(|search| search.text.clone().unwrap_or_default())
                on:input=move |event| app.act(Action::Search(Some(event_target_value(&event))))
                on:keydown=press
            />
            <span class="hint" role="status">{found}</span>
            <button type="button" class="icon-button small" aria-label="Previous" on:click=move |_| app.act(Action::NextHit(-1))>"‹"</button>
            <button type="button" class="icon-button small" aria-label="Next" on:click=move |_| app.act(Action::NextHit(1))>"›"</button>
            <button type="button" class="icon-button small" aria-label="Close search" on:click=move |_| app.act(Action::Search(None))>"×"</button>
        </div>
    }
}
