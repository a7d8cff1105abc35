//! Specifications of the server: listed, opened, followed by links.

use std::collections::BTreeMap;

use goalgraph::layout::Point;
use goalgraph::pdfa::StateId;
use goalgraph::protocol::api::{RevisionContent, SpecificationEntry};
use goalgraph::specification::Specification;
use leptos::prelude::*;
use wasm_bindgen::JsValue;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::saving::kept;
use super::{App, loaded};
use crate::page::links::Link;
use crate::page::model::{Loading, Notice, Server, Tab};
use crate::page::server::{self, Failure, Tagged};
use crate::page::update::Action;

impl App {
    pub(super) fn list_specifications(self) {
        self.keeping().entries.set(Loading::Waiting);
        spawn_local(async move {
            let result = server::specifications().await;
            if result == Err(Failure::Locked) {
                return self.lock();
            }
            self.keeping().entries.set(loaded(result));
        });
    }

    pub(super) fn list_revisions(self) {
        let Some(kept) = self.kept() else { return };
        self.keeping().revisions.set(Loading::Waiting);
        self.keeping().approvals.set(Loading::Waiting);
        spawn_local(async move {
            let result = server::revisions(&kept.id).await;
            if result == Err(Failure::Locked) {
                return self.lock();
            }
            self.keeping().revisions.set(loaded(result));
            self.keeping().approvals.set(loaded(server::approvals(&kept.id).await));
        });
        self.refresh();
    }

    /// Hears anew what the server has of the work.
    pub(super) fn refresh(self) {
        let present = self.keeping().server.with_untracked(|server| matches!(server, Server::Present(_)));
        let Some(kept) = self.kept().filter(|_| present) else { return };
        spawn_local(async move {
            match server::specification(&kept.id).await {
                Ok(answer) => self.heard_of(answer.value),
                Err(Failure::Unreachable) => {
                    self.keeping().offline.set(true);
                    self.retry_later();
                }
                // It is said when somebody asks for something.
                Err(_) => {}
            }
        });
    }

    /// Opens a revision: as a step that can be undone where there is work that would be lost.
    pub(super) fn open_revision(self, id: String, revision: Option<u64>) {
        self.say(Notice::calm("Opening"));
        spawn_local(async move {
            let opened = async {
                let entry = server::specification(&id).await?.value;
                let number = revision.unwrap_or(entry.head.number);
                let content = server::revision(&id, number).await?;
                Ok::<_, Failure>((entry, content))
            };
            match opened.await {
                Ok((entry, content)) => self.opened_revision(entry, content),
                Err(failure) => self.failed("Not opened", &failure),
            }
        });
    }

    fn opened_revision(self, entry: SpecificationEntry, content: Tagged<RevisionContent>) {
        let Tagged { value: RevisionContent { revision, content, positions }, etag } = content;
        let specification = match Specification::from_json(&content) {
            Ok(specification) => specification,
            Err(reason) => {
                return self.say(Notice::alarm(format!("Revision {}: {reason}.", revision.number)));
            }
        };
        // Who watches a run goes on watching it.
        let watching = self.derived.watched.monitoring.get_untracked();
        let same = self.kept().filter(|kept| kept.id == entry.id);
        if same.is_none() && !self.derived.keeping.has_unsaved.get_untracked() {
            // What is there is safe elsewhere: the history begins anew.
            if self.model.history.with_untracked(Option::is_some) {
                self.act(Action::Clear);
            }
        }
        let (name, number) = (specification.name.clone(), revision.number);
        self.replace(format!("Open {name}, revision {number}"), specification);
        self.model.held.set(read_positions(positions));
        let position = self.position();
        match same {
            // An earlier revision is one more step on top of the last one.
            Some(kept) if number < kept.revision => self.keeping().lineages.update(|lineages| {
                if let Some(lineage) = lineages.iter_mut().rev().find(|it| it.from <= position) {
                    lineage.revisions.insert(position, number);
                }
            }),
            _ => self.become_kept(position, position, kept(&entry, &revision, etag)),
        }
        let id = entry.id.clone();
        self.heard_of(entry);
        self.close_dialog();
        self.model.tab.set(if watching { Tab::Run } else { Tab::Automaton });
        self.say(Notice::calm(format!("{name}, revision {number}, is open.")));
        self.bring_recordings(id);
    }

    /// Reads what the address of the page names.
    pub(super) fn read_address(self) {
        let hash = window().location().hash().unwrap_or_default();
        match Link::read(&hash) {
            Ok(link) => self.keeping().link.set(link),
            Err(refusal) => {
                forget_address();
                self.say(Notice::alarm(refusal.to_string()));
            }
        }
    }

    /// Opens it, once it is known whether there is a server and what work there is.
    pub(super) fn follow_link(self) {
        let keeping = self.keeping();
        let Some(link) = keeping.link.get_untracked() else { return };
        match keeping.server.get_untracked() {
            _ if !keeping.restored.get_untracked() => return,
            Server::Asking => return,
            Server::Locked => return self.lock(),
            Server::Absent => {
                self.say(Notice::alarm(
                    "The link needs a Goalgraph server, and this page comes without one.",
                ));
            }
            Server::Present(_) => {
                let there =
                    self.kept().filter(|kept| kept.id == link.id && Some(kept.revision) == link.revision);
                let changed = self.derived.keeping.has_unsaved.get_untracked();
                if there.is_none() || changed {
                    self.open_revision(link.id, link.revision);
                }
            }
        }
        keeping.link.set(None);
        forget_address();
    }

    pub(super) fn copy_link(self, revision: u64) {
        let Some(kept) = self.kept() else { return };
        let hash = Link { id: kept.id, revision: Some(revision) }.hash();
        let origin = window().location().origin().unwrap_or_default();
        let address = format!("{origin}/#{hash}");
        spawn_local(async move {
            // Only pages of this computer or with https may write to the clipboard.
            let clipboard = window().is_secure_context().then(|| window().navigator().clipboard());
            let copied = match clipboard {
                Some(clipboard) => JsFuture::from(clipboard.write_text(&address)).await.is_ok(),
                None => false,
            };
            self.say(Notice::calm(if copied {
                format!("Copied: {address}")
            } else {
                format!("The address of this revision: {address}")
            }));
        });
    }
}

/// The address opens nothing any more: loading the page again brings back the work as it is.
fn forget_address() {
    if let Ok(history) = window().history() {
        // Without it the link is followed once more, as a step that can be undone.
        let _ = history.replace_state_with_url(&JsValue::NULL, "", Some("/"));
    }
}

/// Where states were put; nowhere when another program says it in another way.
fn read_positions(positions: Option<serde_json::Value>) -> BTreeMap<StateId, Point> {
    positions.and_then(|positions| serde_json::from_value(positions).ok()).unwrap_or_default()
}
