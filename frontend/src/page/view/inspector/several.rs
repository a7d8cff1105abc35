//! Several things at once.

use leptos::prelude::*;

use crate::page::model::Selection;
use crate::page::text::count;
use crate::page::update::{Action, App};
use crate::page::view::chips::{button, chip};

/// What is selected, and what can be done with all of it.
pub(super) fn several(app: App, items: &[Selection]) -> impl IntoView + use<> {
    let number = |of: fn(&&Selection) -> bool| items.iter().filter(of).count();
    let states = number(|item| matches!(item, Selection::State(_)));
    let transitions = items.len() - states;
    let parts = [(states, "state"), (transitions, "transition")];
    let parts: Vec<String> = parts.iter().filter(|(n, _)| *n > 0).map(|(n, noun)| count(*n, noun)).collect();
    let row = |item: &Selection| {
        let item = *item;
        let content = match item {
            Selection::State(id) => view! { <span>"State " {id.to_string()}</span> }.into_any(),
            Selection::Transition(source, symbol) => {
                view! { <span>{chip(app, symbol)} " from " {source.to_string()}</span> }.into_any()
            }
        };
        view! {
            <li>
                <button type="button" class="entry" on:click=move |_| app.act(Action::Select(Some(item)))>{content}</button>
            </li>
        }
    };
    view! {
        <h2>{parts.join(" and ")} " selected"</h2>
        <div class="row">{button(app, "merge")} {button(app, "prune")} {button(app, "heal")} {button(app, "unpin")}</div>
        <div class="row">{button(app, "upstream")} {button(app, "downstream")} {button(app, "zoom-selection")}</div>
        <ul class="ways">{items.iter().map(row).collect_view()}</ul>
    }
}
