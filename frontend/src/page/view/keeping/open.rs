//! The specifications of the server, to be opened.

use goalgraph::protocol::api::SpecificationEntry;
use leptos::prelude::*;

use super::{heading, when, when_here};
use crate::page::update::{Action, App, KeepAction};

/// The list, with a search.
pub(super) fn open(app: App) -> impl IntoView {
    let search = RwSignal::new(String::new());
    let found = move |entries: Vec<SpecificationEntry>| {
        let words: Vec<String> = search.get().to_lowercase().split_whitespace().map(str::to_owned).collect();
        let text = |it: &SpecificationEntry| format!("{} {}", it.name, it.head.author).to_lowercase();
        let fits = |it: &SpecificationEntry| words.iter().all(|word| text(it).contains(word.as_str()));
        entries.into_iter().filter(fits).collect::<Vec<_>>()
    };
    let list = move |entries: Vec<SpecificationEntry>| {
        let found = found(entries.clone());
        if entries.is_empty() {
            return view! { <p class="hint">"The server keeps no specification yet. Save one with Ctrl+S."</p> }.into_any();
        }
        if found.is_empty() {
            return view! { <p class="hint">"None is called that."</p> }.into_any();
        }
        let rows = found.into_iter().map(|entry| row(app, entry)).collect_view();
        view! { <ul class="kept-list" aria-label="Specifications">{rows}</ul> }.into_any()
    };
    view! {
        {heading("Open from the server")}
        <input
            class="palette-search"
            type="search"
            placeholder="Search names and people"
            aria-label="Search specifications"
            autofocus
            on:input=move |event| search.set(event_target_value(&event))
        />
        {move || when_here(app.model.keeping.entries.get(), list)}
    }
}

fn row(app: App, entry: SpecificationEntry) -> impl IntoView {
    let SpecificationEntry { id, name, head, approved } = entry;
    let approved = approved.map(|number| {
        view! { <span class="tag approved-tag">"✓ " {format!("approved r{number}")}</span> }
    });
    let saved = format!("r{} · {} · {}", head.number, head.author, when(&head.saved_at));
    let open = move |_| app.act(Action::Keep(KeepAction::Open(id.clone(), None)));
    view! {
        <li>
            <button type="button" class="entry kept-entry" on:click=open>
                <span class="kept-name" dir="auto">{name}</span>
                {approved}
                <span class="hint">{saved}</span>
            </button>
        </li>
    }
}
