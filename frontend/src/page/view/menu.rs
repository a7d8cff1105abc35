//! The menu at the pointer: commands for what is selected, or the sub-goals of a new transition.

use goalgraph::edit::Edit;
use goalgraph::pdfa::StateId;
use leptos::html::Ul;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, KeyboardEvent};

use super::chips::chip;
use crate::page::commands::{self, Command};
use crate::page::keys::shown;
use crate::page::model::{Menu, MenuContent};
use crate::page::update::{Action, App};

/// The menu that is open.
pub(crate) fn menu(app: App) -> impl IntoView {
    move || app.model.menu.get().map(|menu| open(app, menu))
}

fn open(app: App, Menu { x, y, content }: Menu) -> impl IntoView {
    let node = NodeRef::<Ul>::new();
    let before = StoredValue::new_local(None::<HtmlElement>);
    Effect::new(move |_| {
        if let Some(list) = node.get() {
            let active = document().active_element();
            before.set_value(active.and_then(|active| active.dyn_into::<HtmlElement>().ok()));
            keep_inside(&list, x, y);
            focus(&list, 0);
        }
    });
    on_cleanup(move || {
        let nowhere = document().active_element().is_none_or(|active| active.tag_name() == "BODY");
        if let Some(before) = before.try_get_value().flatten().filter(|it| nowhere && it.is_connected()) {
            // An element of this page always takes the focus.
            let _ = before.focus();
        }
    });
    let items = match content {
        MenuContent::Commands => commands(app).into_any(),
        MenuContent::Symbols { source, target } => symbols(app, source, target).into_any(),
    };
    view! {
        <div class="menu-back" on:pointerdown=move |_| app.act(Action::Menu(None)) on:contextmenu=move |event| event.prevent_default()></div>
        <ul node_ref=node class="menu" role="menu" aria-label="Menu" on:keydown=move |event| press(app, &event)>{items}</ul>
    }
}

/// The menu does not leave the window.
fn keep_inside(list: &HtmlElement, x: f64, y: f64) {
    let limit = |place: f64, length: i32, of: Result<wasm_bindgen::JsValue, wasm_bindgen::JsValue>| {
        let room = of.ok().and_then(|room| room.as_f64()).unwrap_or(f64::MAX);
        place.min(room - f64::from(length) - 8.0).max(0.0)
    };
    let left = limit(x, list.offset_width(), window().inner_width());
    let top = limit(y, list.offset_height(), window().inner_height());
    let style = list.style();
    // Lengths of pixels are always taken.
    let _ = style.set_property("left", &format!("{left:.0}px"));
    let _ = style.set_property("top", &format!("{top:.0}px"));
}

/// The entries of the menu.
fn entries(list: &HtmlElement) -> Vec<HtmlElement> {
    let found = list.query_selector_all("[role=menuitem]").ok();
    let found = found.iter().flat_map(|found| (0..found.length()).filter_map(|index| found.item(index)));
    found.filter_map(|entry| entry.dyn_into::<HtmlElement>().ok()).collect()
}

fn focus(list: &HtmlElement, at: usize) {
    if let Some(entry) = entries(list).get(at) {
        // An element of this page always takes the focus.
        let _ = entry.focus();
    }
}

fn press(app: App, event: &KeyboardEvent) {
    let Some(list) = event.current_target().map(JsCast::unchecked_into::<HtmlElement>) else { return };
    let entries = entries(&list);
    let items = entries.len();
    let active = document().active_element();
    let at = entries.iter().position(|entry| active.as_ref() == Some(entry)).unwrap_or(0);
    match event.key().as_str() {
        "ArrowDown" => focus(&list, (at + 1) % items.max(1)),
        "ArrowUp" => focus(&list, (at + items.max(1) - 1) % items.max(1)),
        "Home" => focus(&list, 0),
        "End" => focus(&list, items.saturating_sub(1)),
        "Escape" | "Tab" => app.act(Action::Menu(None)),
        _ => return,
    }
    event.prevent_default();
    event.stop_propagation();
}

/// The commands for what is selected.
fn commands(app: App) -> impl IntoView {
    let fits = |command: &&Command| command.in_menu && untrack(|| (command.enabled)(app));
    let item = |command: &'static Command| {
        let run = move |_| {
            app.act(Action::Menu(None));
            (command.run)(app);
        };
        view! {
            <li role="none">
                <button type="button" role="menuitem" class="menu-item" on:click=run>
                    <span>{command.label}</span> {command.keys.first().map(|key| view! { <kbd>{shown(key)}</kbd> })}
                </button>
            </li>
        }
    };
    commands::commands().filter(fits).map(item).collect_view()
}

/// The sub-goals that a new transition can have.
fn symbols(app: App, source: StateId, target: StateId) -> impl IntoView {
    let free = app.derived.specification.get_untracked().map(|specification| {
        let free = |symbol| specification.pdfa.transition(source, symbol).is_none();
        specification.sub_goals.iter().map(|it| it.id).filter(|&symbol| free(symbol)).collect::<Vec<_>>()
    });
    let free = free.unwrap_or_default();
    let none = free.is_empty();
    let item = |symbol| {
        let add = move |_| {
            app.act(Action::Menu(None));
            app.act(Action::Begin(vec![Edit::AddTransition { source, symbol, target }]));
        };
        view! { <li role="none"><button type="button" role="menuitem" class="menu-item" on:click=add>{chip(app, symbol)}</button></li> }
    };
    view! {
        <li role="none" class="menu-title">{format!("From {source} to {target} by")}</li>
        {none.then(|| view! { <li role="none" class="menu-title">"Every sub-goal has a transition already."</li> })}
        {free.into_iter().map(item).collect_view()}
    }
}
