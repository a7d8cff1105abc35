//! Commands for files: in, learned from, and out.

use goalgraph::export::ExportFormat;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::HtmlElement;

use super::{Command, always, has_automaton};
use crate::page::autosave;
use crate::page::model::Notice;
use crate::page::update::{Action, App};

/// The file button's id in the page.
pub(crate) const FILE_INPUT: &str = "open-demonstrations";

pub(super) const COMMANDS: &[Command] = &[
    Command {
        id: "open",
        label: "Open demonstrations",
        help: "Choose recorded demonstrations: CSV or JSON, one file or many.",
        keys: &["o"],
        in_menu: false,
        enabled: always,
        run: open_files,
    },
    Command {
        id: "sample",
        label: "Load a sample",
        help: "Load the first sample that comes with the app.",
        keys: &["l"],
        in_menu: false,
        enabled: has_samples,
        run: load_sample,
    },
    Command {
        id: "infer",
        label: "Infer",
        help: "Find the sub-goals and infer the automaton from what is loaded, with the present settings.",
        keys: &["i"],
        in_menu: false,
        enabled: can_infer,
        run: |app| app.act(Action::Infer),
    },
    Command {
        id: "cancel",
        label: "Cancel",
        help: "Stop reading or inferring. Files and earlier results stay.",
        keys: &["c"],
        in_menu: false,
        enabled: is_busy,
        run: |app| app.act(Action::Cancel),
    },
    Command {
        id: "export-json",
        label: "Export JSON",
        help: "Save the specification as a goalgraph.json file.",
        keys: &["j"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| app.act(Action::Export(ExportFormat::Json)),
    },
    Command {
        id: "export-dot",
        label: "Export DOT",
        help: "Save the automaton in Graphviz syntax.",
        keys: &["d"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| app.act(Action::Export(ExportFormat::Dot)),
    },
    Command {
        id: "export-svg",
        label: "Export SVG",
        help: "Save the drawing as a picture.",
        keys: &["s"],
        in_menu: false,
        enabled: has_automaton,
        run: |app| app.act(Action::Export(ExportFormat::Svg)),
    },
    Command {
        id: "clear",
        label: "Clear",
        help: "Let go of all files and results.",
        keys: &[],
        in_menu: false,
        enabled: |app| has_files(app) || has_automaton(app),
        run: |app| app.act(Action::Clear),
    },
    Command {
        id: "bring-back",
        label: "Bring back",
        help: "Bring back the work that was cleared last, or that a sample took the place of.",
        keys: &[],
        in_menu: false,
        enabled: |app| app.model.can_bring_back.get(),
        run: |app| app.act(Action::BringBack),
    },
    Command {
        id: "save-aside",
        label: "Save what was kept aside",
        help: "Save earlier work that could not be read as a file.",
        keys: &[],
        in_menu: false,
        enabled: |app| app.model.aside.with(|aside| !aside.is_empty()),
        run: autosave::save_aside,
    },
];

fn has_samples(app: App) -> bool {
    app.model.samples.with(|samples| samples.as_ref().is_some_and(|samples| !samples.is_empty()))
}

fn has_files(app: App) -> bool {
    app.model.files.with(|files| !files.is_empty())
}

fn can_infer(app: App) -> bool {
    app.derived.basis.with(Option::is_some) && !is_busy(app)
}

fn is_busy(app: App) -> bool {
    app.model.inferring.with(Option::is_some) || app.derived.reading.get()
}

fn open_files(app: App) {
    let input =
        document().get_element_by_id(FILE_INPUT).and_then(|input| input.dyn_into::<HtmlElement>().ok());
    match input {
        Some(input) => input.click(),
        None => app.act(Action::Say(Notice::alarm("The page has no file button."))),
    }
}

fn load_sample(app: App) {
    let sample = app.model.samples.with_untracked(|samples| samples.as_ref()?.first().cloned());
    if let Some(sample) = sample {
        app.act(Action::LoadSample(sample));
    }
}
