//! Texts to take away.

use goalgraph::export::{ExportFormat, export};
use goalgraph::history::Mark;
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
                if self.save("goalgraph.json", "application/json", &specification.to_json()) {
                    self.mark(Mark::Saved);
                }
            }
            ExportFormat::Dot => {
                let text = export(&specification, ExportFormat::Dot);
                let _ = self.save("dot", "text/vnd.graphviz", &text);
            }
            ExportFormat::Svg => {
                self.post(&ToWorker::DrawSvg { specification: specification.to_json() }, None);
            }
        }
    }

    /// Whether the browser took the file.
    pub(super) fn save(self, extension: &str, media_type: &str, text: &str) -> bool {
        let stem = self.derived.task_name.with_untracked(|name| file_stem(name));
        let name = format!("{stem}.{extension}");
        let saved = download::save(&name, media_type, text).is_ok();
        self.say(if saved {
            Notice::calm(format!("Saved {name}."))
        } else {
            Notice::alarm(format!("The browser does not save {name}."))
        });
        saved
    }
}
