//! Texts to take away.

use goalgraph::export::{ExportFormat, export};
use leptos::prelude::*;

use super::App;
use crate::page::download;
use crate::page::model::Notice;
use crate::page::text::file_stem;
use crate::protocol::ToWorker;

impl App {
    pub(super) fn export(self, format: ExportFormat) {
        let Some(specification) = self.derived.specification.get_untracked() else {
            return self.say(Notice::alarm("There is nothing to export yet. Open demonstrations first."));
        };
        match format {
            ExportFormat::Json => {
                self.save("goalgraph.json", "application/json", &specification.to_json());
                self.mark_saved();
            }
            ExportFormat::Dot => {
                let text = export(&specification, ExportFormat::Dot);
                self.save("dot", "text/vnd.graphviz", &text);
            }
            ExportFormat::Svg => {
                self.post(&ToWorker::DrawSvg { specification: specification.to_json() }, None);
            }
        }
    }

    pub(super) fn save(self, extension: &str, media_type: &str, text: &str) {
        let stem = self.derived.task_name.with_untracked(|name| file_stem(name));
        let name = format!("{stem}.{extension}");
        match download::save(&name, media_type, text) {
            Ok(()) => self.say(Notice::calm(format!("Saved {name}."))),
            Err(_) => self.say(Notice::alarm(format!("The browser does not save {name}."))),
        }
    }
}
