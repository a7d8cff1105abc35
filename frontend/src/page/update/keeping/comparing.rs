//! What differs between two revisions, and where it is drawn.

use std::sync::Arc;

use goalgraph::layout::Layout;
use goalgraph::specification::Specification;
use leptos::prelude::*;
use wasm_bindgen_futures::spawn_local;

use super::{App, loaded};
use crate::page::model::{Compared, KeepDialog, Loading};
use crate::page::server::{self, Failure};
use crate::protocol::ToWorker;

impl App {
    pub(super) fn compare_revisions(self, before: u64, after: u64) {
        let Some(kept) = self.kept() else { return };
        self.show_difference();
        spawn_local(async move {
            let both = async {
                let before = self.revision_of(&kept.id, before).await?;
                Ok::<_, Failure>((before, self.revision_of(&kept.id, after).await?))
            };
            let both = both.await;
            self.compared(both);
        });
    }

    pub(super) fn show_difference(self) {
        self.keeping().compared.set(Loading::Waiting);
        self.ask(KeepDialog::Difference);
    }

    /// Takes what is to be compared, and has it placed.
    pub(super) fn compared(self, both: Result<(Compared, Compared), Failure>) {
        let keeping = self.keeping();
        keeping.pointed.set(None);
        keeping.compared.set(loaded(both));
        let number = keeping.placed.with_untracked(|(number, _)| number + 1);
        keeping.placed.set((number, None));
        if let Some(request) = self.derived.keeping.drawing.get_untracked() {
            self.post(&ToWorker::Place { request: request.request.clone(), number }, None);
        }
    }

    pub(super) fn placed(self, number: u32, layout: Option<Arc<Layout>>) {
        let asked = self.keeping().placed.with_untracked(|(asked, _)| *asked);
        if number == asked {
            self.keeping().placed.set((asked, layout));
        }
    }

    /// A revision of the server, to be compared.
    pub(super) async fn revision_of(self, id: &str, number: u64) -> Result<Compared, Failure> {
        let content = server::revision(id, number).await?.value.content;
        let specification =
            Specification::from_json(&content).map_err(|error| Failure::Strange(error.to_string()))?;
        Ok(Compared { name: format!("r{number}"), specification: Arc::new(specification) })
    }
}
