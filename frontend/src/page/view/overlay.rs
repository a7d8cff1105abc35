//! What lies over the page: the command palette and the help page.

use leptos::html::Dialog;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, KeyboardEvent};

use super::benchmark::benchmark;
use super::keeping;
use crate::page::commands::{Command, GROUPS, commands};
use crate::page::keys::shown;
use crate::page::model::Overlay;
use crate::page::update::{Action, App};

/// The dialog that is open, if one is.
pub(crate) fn overlay(app: App) -> impl IntoView {
    move || match app.model.overlay.get() {
        None => None,
        Some(Overlay::Palette) => Some(dialog(app, "Commands", "dialog", palette(app).into_any()).into_any()),
        Some(Overlay::Benchmark) => {
            Some(dialog(app, "Benchmark", "dialog", benchmark().into_any()).into_any())
        }
        Some(Overlay::Keep(asked)) => {
            let (name, class, content) = keeping::content(app, asked);
            Some(dialog(app, name, class, content).into_any())
        }
        Some(Overlay::Help) => Some(dialog(app, "Help", "dialog", help().into_any()).into_any()),
    }
}

fn dialog(app: App, name: &'static str, class: &'static str, content: AnyView) -> impl IntoView {
    let node = NodeRef::<Dialog>::new();
    Effect::new(move |_| {
        if let Some(dialog) = node.get() {
            // It fails only when the dialog is open already.
            let _ = dialog.show_modal();
        }
    });
    let close = move || app.act(Action::Overlay(None));
    view! {
        <dialog
            node_ref=node
            class=class
            aria-label=name
            on:close=move |_| close()
            on:click=move |event| if event.target() == event.current_target() { close() }
        >
            <div class="dialog-body">{content}</div>
        </dialog>
    }
}

/// What the palette can do: commands, and one entry per sample.
#[derive(Clone)]
enum Entry {
    Command(&'static Command),
    Sample(crate::page::model::Sample),
}

impl Entry {
    fn label(&self) -> String {
        match self {
            Self::Command(command) => command.label.to_owned(),
            Self::Sample(sample) => format!("Load sample: {}", sample.title),
        }
    }

    fn key(&self) -> Option<String> {
        match self {
            Self::Command(command) => command.keys.first().map(|key| shown(key)),
            Self::Sample(_) => None,
        }
    }

    fn run(self, app: App) {
        app.act(Action::Overlay(None));
        match self {
            // Once the dialog is gone: until then nothing else takes the focus.
            Self::Command(command) => request_animation_frame(move || (command.run)(app)),
            Self::Sample(sample) => app.act(Action::LoadSample(sample)),
        }
    }
}

fn entries(app: App, search: &str) -> Vec<Entry> {
    let possible = commands().filter(|command| (command.enabled)(app) && command.id != "palette");
    let samples = app.model.samples.get().unwrap_or_default().into_iter().map(Entry::Sample);
    let words: Vec<String> = search.to_lowercase().split_whitespace().map(str::to_owned).collect();
    let fits = |entry: &Entry| words.iter().all(|word| entry.label().to_lowercase().contains(word));
    possible.map(Entry::Command).chain(samples).filter(fits).collect()
}

fn palette(app: App) -> impl IntoView {
    let search = RwSignal::new(String::new());
    let at = RwSignal::new(0_usize);
    let found = move || search.with(|search| entries(app, search));
    let press = move |event: KeyboardEvent| {
        let found = untrack(found);
        match event.key().as_str() {
            "ArrowDown" => at.update(|at| *at = (*at + 1).min(found.len().saturating_sub(1))),
            "ArrowUp" => at.update(|at| *at = at.saturating_sub(1)),
            "Enter" => found.get(at.get_untracked()).cloned().into_iter().for_each(|entry| entry.run(app)),
            _ => return,
        }
        event.prevent_default();
    };
    let option = move |(index, entry): (usize, Entry)| {
        let (label, key) = (entry.label(), entry.key());
        view! {
            <li
                role="option"
                id=format!("command-{index}")
                class="palette-entry"
                aria-selected=move || (at.get() == index).to_string()
                on:click=move |_| entry.clone().run(app)
            >
                <span>{label}</span> {key.map(|key| view! { <kbd>{key}</kbd> })}
            </li>
        }
    };
    view! {
        <input
            class="palette-search"
            type="text"
            placeholder="Search commands"
            aria-label="Search commands"
            role="combobox"
            aria-expanded="true"
            aria-controls="palette-list"
            aria-activedescendant=move || format!("command-{}", at.get())
            autofocus
            on:input=move |event| { search.set(event_target_value(&event)); at.set(0); }
            on:keydown=press
        />
        <ul id="palette-list" role="listbox" aria-label="Commands" class="palette-list">
            {move || found().into_iter().enumerate().map(option).collect_view()}
        </ul>
    }
}

fn help() -> impl IntoView {
    let key = |key: &&'static str| view! { <kbd>{shown(key)}</kbd> " " };
    let row = move |command: &'static Command| {
        view! {
            <tr>
                <th scope="row">{command.label}</th>
                <td>{command.help}</td>
                <td>{command.keys.iter().map(key).collect_view()}</td>
            </tr>
        }
    };
    let group = move |(name, commands): &(&'static str, &'static [Command])| {
        view! {
            <tbody>
                <tr><th scope="rowgroup" colspan="3" class="group">{*name}</th></tr>
                {commands.iter().map(row).collect_view()}
            </tbody>
        }
    };
    view! {
        <header class="section-head">
            <h2>"Commands and keys"</h2>
            <button type="button" class="button" autofocus on:click=move |event| close_dialog(&event)>"Close"</button>
        </header>
        <table class="help">
            <thead><tr><th scope="col">"Command"</th><th scope="col">"What it does"</th><th scope="col">"Key"</th></tr></thead>
            {GROUPS.iter().map(group).collect_view()}
        </table>
        <p class="hint">"In the graph: drag the background to pan, with Shift to select; turn the wheel to zoom. Drag a state to pin it, onto another state to merge them. Drag the handle of a selected state to add a transition, that of a transition to move its end. Tab goes through states and transitions, Enter selects, with Shift more than one."</p>
    }
}

/// Closes the dialog around the button that was pressed.
pub(super) fn close_dialog(event: &web_sys::MouseEvent) {
    let button = event.target().and_then(|target| target.dyn_into::<HtmlElement>().ok());
    let dialog = button.and_then(|button| button.closest("dialog").ok().flatten());
    if let Some(dialog) = dialog {
        dialog.unchecked_into::<web_sys::HtmlDialogElement>().close();
    }
}
