//! Everything that a person can do, in one table: buttons, keys, the palette and the help page are made of it.

use goalgraph::export::ExportFormat;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::HtmlElement;

use super::model::{Notice, Overlay, Tab};
use super::update::{Action, App};
use super::view::graph;

/// The file button's id in the page.
pub(crate) const FILE_INPUT: &str = "open-demonstrations";

/// What a person can do.
pub(crate) struct Command {
    /// Its name in the program.
    pub(crate) id: &'static str,
    /// What is on its button.
    pub(crate) label: &'static str,
    /// What it does, as a sentence.
    pub(crate) help: &'static str,
    /// The key that does it, as [`super::keys::name_of`] writes keys.
    pub(crate) key: Option<&'static str>,
    /// Whether it can be done now.
    pub(crate) enabled: fn(App) -> bool,
    /// Does it.
    pub(crate) run: fn(App),
}

/// All commands, in the order of the help page.
pub(crate) const COMMANDS: &[Command] = &[
    Command {
        id: "open",
        label: "Open demonstrations",
        help: "Choose recorded demonstrations: CSV or JSON, one file or many.",
        key: Some("o"),
        enabled: always,
        run: open_files,
    },
    Command {
        id: "sample",
        label: "Load a sample",
        help: "Load the first sample that comes with the app.",
        key: Some("l"),
        enabled: has_samples,
        run: load_sample,
    },
    Command {
        id: "infer",
        label: "Infer",
        help: "Find the sub-goals and infer the automaton from what is loaded, with the present settings.",
        key: Some("i"),
        enabled: can_infer,
        run: |app| app.act(Action::Infer),
    },
    Command {
        id: "cancel",
        label: "Cancel",
        help: "Stop reading or inferring. Files and earlier results stay.",
        key: Some("c"),
        enabled: is_busy,
        run: |app| app.act(Action::Cancel),
    },
    Command {
        id: "export-json",
        label: "Export JSON",
        help: "Save the specification as a goalgraph.json file.",
        key: Some("Ctrl+s"),
        enabled: has_automaton,
        run: |app| app.act(Action::Export(ExportFormat::Json)),
    },
    Command {
        id: "export-dot",
        label: "Export DOT",
        help: "Save the automaton in Graphviz syntax.",
        key: Some("d"),
        enabled: has_automaton,
        run: |app| app.act(Action::Export(ExportFormat::Dot)),
    },
    Command {
        id: "export-svg",
        label: "Export SVG",
        help: "Save the drawing as a picture.",
        key: Some("s"),
        enabled: has_automaton,
        run: |app| app.act(Action::Export(ExportFormat::Svg)),
    },
    Command {
        id: "demonstrations",
        label: "Go to Demonstrations",
        help: "Files with their verdicts, and what was recorded.",
        key: Some("1"),
        enabled: always,
        run: |app| app.act(Action::GoTo(Tab::Demonstrations)),
    },
    Command {
        id: "sub-goals",
        label: "Go to Sub-goals",
        help: "What was found in each feature subset, and the words.",
        key: Some("2"),
        enabled: always,
        run: |app| app.act(Action::GoTo(Tab::SubGoals)),
    },
    Command {
        id: "automaton",
        label: "Go to Automaton",
        help: "The graph with the probability of every transition.",
        key: Some("3"),
        enabled: always,
        run: |app| app.act(Action::GoTo(Tab::Automaton)),
    },
    Command {
        id: "run",
        label: "Go to Run",
        help: "The plan for what is available.",
        key: Some("4"),
        enabled: always,
        run: |app| app.act(Action::GoTo(Tab::Run)),
    },
    Command {
        id: "fit",
        label: "Fit",
        help: "Show the whole automaton.",
        key: Some("Shift+1"),
        enabled: has_automaton,
        run: graph::fit,
    },
    Command {
        id: "zoom-in",
        label: "Zoom in",
        help: "Make the drawing larger.",
        key: Some("+"),
        enabled: has_automaton,
        run: |app| graph::zoom(app, graph::ZOOM_STEP),
    },
    Command {
        id: "zoom-out",
        label: "Zoom out",
        help: "Make the drawing smaller.",
        key: Some("-"),
        enabled: has_automaton,
        run: |app| graph::zoom(app, 1.0 / graph::ZOOM_STEP),
    },
    Command {
        id: "table",
        label: "Show as table",
        help: "Change between the graph and the same content as a table.",
        key: Some("t"),
        enabled: has_automaton,
        run: |app| app.act(Action::ToggleTable),
    },
    Command {
        id: "deselect",
        label: "Deselect",
        help: "Select nothing.",
        key: Some("Escape"),
        enabled: |app| app.model.selection.get().is_some(),
        run: |app| app.act(Action::Select(None)),
    },
    Command {
        id: "theme",
        label: "Light or dark",
        help: "Change between the light and the dark theme.",
        key: Some("m"),
        enabled: always,
        run: |app| app.act(Action::ToggleTheme),
    },
    Command {
        id: "clear",
        label: "Clear",
        help: "Let go of all files and results.",
        key: None,
        enabled: has_files,
        run: |app| app.act(Action::Clear),
    },
    Command {
        id: "palette",
        label: "Commands",
        help: "Search all commands.",
        key: Some("Ctrl+k"),
        enabled: always,
        run: |app| app.act(Action::Overlay(Some(Overlay::Palette))),
    },
    Command {
        id: "help",
        label: "Help",
        help: "Show all commands and their keys.",
        key: Some("?"),
        enabled: always,
        run: |app| app.act(Action::Overlay(Some(Overlay::Help))),
    },
];

/// The command called `id`.
pub(crate) fn command(id: &str) -> Option<&'static Command> {
    COMMANDS.iter().find(|command| command.id == id)
}

fn always(_: App) -> bool {
    true
}

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

fn has_automaton(app: App) -> bool {
    app.derived.specification.with(Option::is_some)
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn no_two_commands_have_one_key() {
        let keys: Vec<&str> = COMMANDS.iter().filter_map(|command| command.key).collect();
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len(), "{keys:?}");
    }

    #[test]
    fn no_two_commands_have_one_id_or_label() {
        let ids: BTreeSet<&str> = COMMANDS.iter().map(|command| command.id).collect();
        let labels: BTreeSet<&str> = COMMANDS.iter().map(|command| command.label).collect();
        assert_eq!((ids.len(), labels.len()), (COMMANDS.len(), COMMANDS.len()));
    }

    #[test]
    fn every_command_says_what_it_does_in_a_sentence() {
        assert!(COMMANDS.iter().all(|command| command.help.ends_with('.')));
    }
}
