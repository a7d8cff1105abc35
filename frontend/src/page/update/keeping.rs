//! What happens between the work and the server: saves, openings, approvals. Answers come later; whoever asked may be
//! elsewhere by then.

mod action;
mod approving;
mod comparing;
mod opening;
mod recordings;
mod saving;
mod session;

use goalgraph::history::History;
use goalgraph::protocol::api::SpecificationEntry;
use leptos::prelude::*;

use super::App;
use crate::page::model::{KeepDialog, Keeping, Kept, Lineage, Loading, Notice, Overlay, Queued};
use crate::page::server::Failure;

pub(crate) use action::{Choice, KeepAction};

impl App {
    /// Does what a gesture means for what is kept.
    pub(super) fn keep(self, action: KeepAction) {
        match action {
            KeepAction::Save(message) => self.save_to_server(message),
            KeepAction::Copy => self.save_copy(),
            KeepAction::Retry => self.retry(),
            KeepAction::Ask(dialog) => self.ask(dialog),
            KeepAction::Open(id, revision) => self.open_revision(id, revision),
            KeepAction::Compare(before, after) => self.compare_revisions(before, after),
            KeepAction::Prepare(revision, dialog) => self.prepare(revision, dialog),
            KeepAction::Sign { revision, decision, signature } => self.sign(revision, decision, signature),
            KeepAction::Choose(choice) => self.choose(choice),
            KeepAction::CopyLink(revision) => self.copy_link(revision),
            KeepAction::Delete => self.delete_from_server(),
            KeepAction::LogIn(token) => self.log_in(token),
            KeepAction::Author(name) => self.set_author(name),
            KeepAction::Follow => self.follow_link(),
            KeepAction::Point(part) => self.model.keeping.pointed.set(part),
            KeepAction::Placed(number, layout) => self.placed(number, layout),
            KeepAction::PutBack(lineages, queued) => self.put_back_lineages(lineages, queued),
            KeepAction::Restored => self.model.keeping.restored.set(true),
        }
    }

    fn keeping(self) -> &'static Keeping {
        &self.model.keeping
    }

    /// What of the server the work is at the moment.
    pub(crate) fn kept(self) -> Option<Kept> {
        self.derived.keeping.lineage.get_untracked().map(|lineage| lineage.kept)
    }

    fn position(self) -> usize {
        self.model.history.with_untracked(|history| history.as_ref().map_or(0, History::position))
    }

    /// Shows a dialog, with what it needs asked for anew.
    fn ask(self, dialog: KeepDialog) {
        self.keeping().refusal.set(None);
        match dialog {
            KeepDialog::Open => self.list_specifications(),
            KeepDialog::Revisions => self.list_revisions(),
            _ => {}
        }
        self.model.overlay.set(Some(Overlay::Keep(dialog)));
    }

    fn close_dialog(self) {
        if matches!(self.model.overlay.get_untracked(), Some(Overlay::Keep(_))) {
            self.model.overlay.set(None);
        }
    }

    /// What comes after the present place in the history is about to be forgotten: so is what it was on the server.
    pub(super) fn forget_undone_lineages(self) {
        let position = self.position();
        let ahead = self.keeping().lineages.with_untracked(|lineages| {
            lineages.iter().any(|it| it.from > position || it.revisions.keys().any(|at| *at > position))
        });
        if ahead {
            self.keeping().lineages.update(|lineages| {
                lineages.retain(|it| it.from <= position);
                for lineage in lineages.iter_mut() {
                    lineage.revisions.retain(|at, _| *at <= position);
                }
            });
        }
    }

    /// The work is let go of: what comes next is nothing of the server.
    pub(super) fn forget_lineages(self) {
        self.keeping().lineages.set(Vec::new());
        self.keeping().entry.set(None);
        self.keeping().queued.set(None);
    }

    fn put_back_lineages(self, lineages: Vec<Lineage>, queued: Option<Queued>) {
        self.keeping().lineages.set(lineages);
        self.keeping().queued.set(queued);
        self.retry();
    }

    /// From `position` on the work is what `kept` says; what was before stays what it was.
    fn become_kept(self, position: usize, from: usize, kept: Kept) {
        self.keeping().lineages.update(|lineages| {
            let at = lineages.iter().rposition(|it| it.from <= position);
            if let Some(at) = at.filter(|at| lineages[*at].kept.id == kept.id) {
                lineages[at].revisions.insert(position, kept.revision);
                lineages[at].kept = kept;
            } else {
                let revisions = [(position, kept.revision)].into();
                lineages.retain(|it| it.from != from);
                lineages.push(Lineage { from, kept, revisions });
                lineages.sort_by_key(|it| it.from);
            }
        });
    }

    /// What the server said last of the specification that the work is.
    fn heard_of(self, entry: SpecificationEntry) {
        self.keeping().offline.set(false);
        self.keeping().attempts.set(0);
        self.keeping().lineages.update(|lineages| {
            for lineage in lineages.iter_mut().filter(|it| it.kept.id == entry.id) {
                lineage.kept.approved = entry.approved;
            }
        });
        self.keeping().entry.set(Some(entry));
    }

    /// Says why something could not be done, and what follows from it.
    fn failed(self, what: &str, failure: &Failure) {
        match failure {
            Failure::Locked => return self.lock(),
            Failure::Unreachable => self.keeping().offline.set(true),
            Failure::Refused(_) | Failure::Strange(_) => {}
        }
        self.say(Notice::alarm(format!("{what}: {failure}.")));
    }
}

/// What the server gave, or why not, for a list on display.
fn loaded<T>(result: Result<T, Failure>) -> Loading<T> {
    match result {
        Ok(it) => Loading::Here(it),
        Err(failure) => Loading::Failed(format!("Not here: {failure}.")),
    }
}
