//! Specifications that somebody opens.

use goalgraph::specification::Specification;
use leptos::prelude::*;

use super::App;
use crate::page::model::{Notice, Tab};
use crate::protocol::FileId;

impl App {
    /// The file was no recording but a specification: it is shown, and leaves the list of recordings.
    pub(super) fn opened(self, file: FileId, result: Result<String, String>) {
        let name = self
            .model
            .files
            .with_untracked(|files| files.iter().find(|it| it.id == file).map(|it| it.name.clone()));
        // It was let go of meanwhile.
        let Some(name) = name else { return };
        self.forget(file);
        let read = result.and_then(|text| Specification::from_json(&text).map_err(|error| error.to_string()));
        match read {
            Err(reason) => self.say(Notice::alarm(format!("{name}: {reason}."))),
            Ok(specification) => {
                self.replace(format!("Open {name}"), specification);
                self.model.tab.set(Tab::Automaton);
                self.say(Notice::calm(format!("{name} is open.")));
            }
        }
        self.settle();
    }
}
