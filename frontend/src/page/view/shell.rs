//! The frame of the page: bar, tabs, panel, status line, and what lies over them.

use leptos::ev;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{DragEvent, HtmlInputElement, KeyboardEvent};

use super::chips::{button, icon_button};
use super::{automaton, chips, demonstrations, keeping, menu, overlay, run, start, sub_goals};
use crate::page::commands::FILE_INPUT;
use crate::page::model::{Overlay, Tab};
use crate::page::update::{Action, App};
use crate::page::{dropped, keys};

/// The whole page.
pub(crate) fn shell(app: App) -> impl IntoView {
    let listener = window_event_listener(ev::keydown, move |event| keys::press(app, &event));
    on_cleanup(move || listener.remove());
    listen_for_drops(app);
    page(app)
}

/// What is seen of it.
pub(crate) fn page(app: App) -> impl IntoView {
    view! {
        {bar(app)}
        <main class="panel">
            {keeping::banner(app)}
            <div
                id="panel"
                class="panel-content"
                role="tabpanel"
                aria-labelledby=move || tab_id(app.model.tab.get())
            >
                {move || panel(app)}
            </div>
        </main>
        {status(app)}
        {file_input(app)}
        <div class="drop-overlay" class:shown=move || app.model.dragging.get() aria-hidden="true">
            <p>"Drop to open"</p>
        </div>
        {menu::menu(app)}
        {overlay::overlay(app)}
        {hatch()}
    }
}

/// The pattern of what was not observed, for all drawings.
fn hatch() -> impl IntoView {
    view! {
        <svg class="visually-hidden" width="0" height="0" aria-hidden="true">
            <defs>
                <pattern id="hatch" width="6" height="6" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
                    <path class="hatch-line" d="M0 0v6" />
                </pattern>
            </defs>
        </svg>
    }
}

fn bar(app: App) -> impl IntoView {
    view! {
        <header class="bar">
            <h1 class="brand" aria-label="Goalgraph">{logo()} <span>"Goalgraph"</span></h1>
            <input
                class="task-name"
                aria-label="Task name"
                spellcheck="false"
                dir="auto"
                prop:value=move || app.derived.task_name.get()
                on:change=move |event| {
                    app.act(Action::Name(event_target_value(&event)));
                    // What was refused does not stay in the field.
                    let name = app.derived.task_name.get_untracked();
                    event_target::<HtmlInputElement>(&event).set_value(&name);
                }
            />
            {keeping::standing(app)}
            <div class="tabs" role="tablist" aria-label="Steps" on:keydown=move |event| step_tabs(app, &event)>
                {Tab::ALL.map(|tab| tab_button(app, tab)).collect_view()}
            </div>
            <div class="bar-actions">
                {palette_button(app)}
                {icon_button(app, "theme", "◐")}
                {icon_button(app, "help", "?")}
            </div>
        </header>
    }
}

fn palette_button(app: App) -> impl IntoView {
    view! {
        <button
            type="button"
            class="palette-button"
            aria-label="Commands"
            on:click=move |_| app.act(Action::Overlay(Some(Overlay::Palette)))
        >
            "Commands" <kbd>"Ctrl+K"</kbd>
        </button>
    }
}

/// Three states and their transitions, as small as can be.
fn logo() -> impl IntoView {
    view! {
        <svg class="logo" viewBox="0 0 32 32" width="28" height="28" aria-hidden="true">
            <path class="logo-line" d="M8 16 16 8M8 16l8 8M16 8l8 8M16 24l8-8" />
            <circle class="logo-state" cx="7" cy="16" r="4" />
            <circle class="c0 fill" cx="16" cy="7" r="4" />
            <circle class="c5 fill" cx="16" cy="25" r="4" />
            <circle class="c1 fill" cx="25" cy="16" r="4" />
        </svg>
    }
}

fn tab_id(tab: Tab) -> String {
    format!("tab-{}", tab.name().to_lowercase())
}

fn tab_button(app: App, tab: Tab) -> impl IntoView {
    let selected = move || app.model.tab.get() == tab;
    view! {
        <button
            type="button"
            role="tab"
            id=tab_id(tab)
            class="tab"
            aria-selected=move || selected().to_string()
            aria-controls="panel"
            tabindex=move || if selected() { "0" } else { "-1" }
            on:click=move |_| app.act(Action::GoTo(tab))
        >
            {tab.name()}
        </button>
    }
}

fn step_tabs(app: App, event: &KeyboardEvent) {
    let at = Tab::ALL.iter().position(|tab| *tab == app.model.tab.get_untracked()).unwrap_or(0);
    chips::step_tabs(event, at, Tab::ALL.len(), |next| {
        app.act(Action::GoTo(Tab::ALL[next]));
        tab_id(Tab::ALL[next])
    });
}

fn panel(app: App) -> AnyView {
    match app.model.tab.get() {
        Tab::Demonstrations => {
            let empty = Memo::new(move |_| {
                app.model.files.with(Vec::is_empty) && app.derived.specification.with(Option::is_none)
            });
            (move || {
                if empty.get() {
                    start::start(app).into_any()
                } else {
                    demonstrations::demonstrations(app).into_any()
                }
            })
            .into_any()
        }
        Tab::SubGoals => sub_goals::sub_goals(app).into_any(),
        Tab::Automaton => automaton::automaton(app).into_any(),
        Tab::Run => run::run(app).into_any(),
    }
}

fn status(app: App) -> impl IntoView {
    let notice = move || app.model.notice.get();
    view! {
        <footer class="status">
            <p role="status" class="notice" class:alarming=move || notice().alarming>{move || notice().text}</p>
            {move || app.derived.outdated.get().then(|| view! {
                <p class="outdated">"The automaton is from before your last change."</p>
                {button(app, "infer")}
            })}
            {keeping::uploading(app)}
            {move || work(app)}
        </footer>
    }
}

/// What the worker does, and the way to stop it.
fn work(app: App) -> Option<impl IntoView> {
    let inferring = app.model.inferring.get();
    let reading = app.derived.reading.get();
    let (label, value, max) = match inferring {
        Some(inferring) => (inferring.progress.stage, inferring.progress.done, inferring.progress.total),
        None if reading => app.derived.verdicts.with(|verdicts| {
            let waiting = |(_, verdict): &&(_, _)| *verdict == crate::page::verdict::Verdict::Reading;
            let waiting = verdicts.iter().filter(waiting).count();
            ("Reading files".to_owned(), verdicts.len() - waiting, verdicts.len())
        }),
        None => return None,
    };
    Some(view! {
        <label class="work">
            <span>{label}</span>
            <progress aria-label="Progress" max=max.to_string() value=value.to_string()></progress>
        </label>
        {button(app, "cancel")}
    })
}

fn file_input(app: App) -> impl IntoView {
    let open = move |event: web_sys::Event| {
        let Some(input) = event.target().and_then(|target| target.dyn_into::<HtmlInputElement>().ok()) else {
            return;
        };
        if let Some(list) = input.files() {
            dropped::open_list(app, &list);
        }
        // So that choosing the same file again is a change.
        input.set_value("");
    };
    view! {
        <input
            type="file"
            multiple
            id=FILE_INPUT
            class="visually-hidden"
            tabindex="-1"
            aria-label="Open demonstrations"
            on:change=open
        />
    }
}

/// Files may be dropped anywhere, at any time.
fn listen_for_drops(app: App) {
    let has_files = |event: &DragEvent| {
        event.data_transfer().is_some_and(|transfer| transfer.types().iter().any(|kind| kind == "Files"))
    };
    let over = move |event: DragEvent| {
        if has_files(&event) {
            event.prevent_default();
            if !app.model.dragging.get_untracked() {
                app.model.dragging.set(true);
            }
        }
    };
    let leave = move |event: DragEvent| {
        if event.related_target().is_none() {
            app.model.dragging.set(false);
        }
    };
    let drop = move |event: DragEvent| {
        app.model.dragging.set(false);
        if let Some(transfer) = event.data_transfer().filter(|_| has_files(&event)) {
            event.prevent_default();
            dropped::open_drop(app, &transfer);
        }
    };
    // The page lives as long as the window.
    let _ = window_event_listener(ev::dragenter, over);
    let _ = window_event_listener(ev::dragover, over);
    let _ = window_event_listener(ev::dragleave, leave);
    let _ = window_event_listener(ev::drop, drop);
}
