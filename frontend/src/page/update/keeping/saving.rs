//! Saves: made, refused, waiting for the server.

use std::time::Duration;

use goalgraph::edit::{Edit, MAX_NAME};
use goalgraph::export::ExportFormat;
use goalgraph::history::Mark;
use goalgraph::protocol::api::{Problem, Revision, Save, SpecificationEntry};
use leptos::prelude::*;
use wasm_bindgen_futures::spawn_local;

use super::{App, Choice};
use crate::page::derived::sha256;
use crate::page::model::{Compared, KeepDialog, Kept, Notice, Onto, Queued, Server};
use crate::page::server::{self, Failure, Tagged};
use crate::page::update::Action;

impl App {
    /// Saves the work on the server; without a server, as a file.
    pub(super) fn save_to_server(self, message: String) {
        self.close_dialog();
        match self.keeping().server.get_untracked() {
            Server::Absent => self.export(ExportFormat::Json),
            Server::Locked => self.lock(),
            Server::Asking | Server::Present(_) => {
                let onto = self.kept().map(|Kept { id, etag, .. }| Onto { id, etag });
                self.save_onto(onto, message);
            }
        }
    }

    /// Keeps the work as a specification of its own; what it was before stays what it is.
    pub(super) fn save_copy(self) {
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        let suffix = " (copy)";
        let stem: String = specification.name.chars().take(MAX_NAME - suffix.len()).collect();
        self.act(Action::Edit(None, vec![Edit::RenameTask { name: format!("{stem}{suffix}") }]));
        self.close_dialog();
        self.save_onto(None, String::new());
    }

    fn save_onto(self, onto: Option<Onto>, message: String) {
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        if self.keeping().saving.get_untracked() {
            return self.say(Notice::calm("The last save is still under way."));
        }
        let waiting = self.keeping().queued.get_untracked().filter(|queued| queued.onto == onto);
        let earlier = waiting.map(|queued| queued.save.message).unwrap_or_default();
        let author = self.keeping().author.get_untracked();
        let save = Save {
            content: specification.to_json(),
            author: Some(author).filter(|author| !author.trim().is_empty()),
            message: if message.is_empty() { earlier } else { message },
            // Numbers and names alone: it can always be written.
            positions: serde_json::to_value(self.model.held.get_untracked()).ok(),
        };
        self.send(Queued { onto, save, position: self.position() });
    }

    fn send(self, queued: Queued) {
        let keeping = self.keeping();
        keeping.saving.set(true);
        spawn_local(async move {
            let result = match &queued.onto {
                Some(Onto { id, etag }) => server::save(id, etag, &queued.save).await,
                None => server::create(&queued.save).await,
            };
            let result = own_save(result, &queued).await;
            keeping.saving.set(false);
            match result {
                Ok(answer) => self.saved(&queued, answer),
                Err(Failure::Unreachable) => self.wait_for_server(queued),
                Err(Failure::Locked) => {
                    keeping.queued.set(Some(queued));
                    self.lock();
                }
                Err(Failure::Refused(problem)) if changed_meanwhile(&problem).is_some() => {
                    keeping.queued.set(None);
                    keeping.conflict.set(problem.head);
                    self.ask(KeepDialog::Conflict);
                }
                Err(failure) => {
                    keeping.queued.set(None);
                    self.failed("Not saved", &failure);
                }
            }
        });
    }

    /// The server has it.
    fn saved(self, queued: &Queued, Tagged { value: entry, etag }: Tagged<SpecificationEntry>) {
        let keeping = self.keeping();
        keeping.queued.set(None);
        keeping.conflict.set(None);
        let (first, copied) = (queued.onto.is_none(), self.kept());
        // What was never kept before was the same specification from the beginning.
        let from = if first && copied.is_none() { 0 } else { queued.position };
        let number = entry.head.number;
        self.become_kept(queued.position, from, kept(&entry, &entry.head, etag));
        if self.position() == queued.position {
            self.mark(Mark::Saved);
        }
        let id = entry.id.clone();
        self.heard_of(entry);
        self.say(Notice::calm(format!("Saved as revision {number}.")));
        self.upload_recordings(id, copied.map(|kept| kept.id));
    }

    fn wait_for_server(self, queued: Queued) {
        self.keeping().offline.set(true);
        self.keeping().queued.set(Some(queued));
        self.say(Notice::alarm("The server does not answer. The save waits here and is sent when it does."));
        self.retry_later();
    }

    /// Asks again after a while, less and less often.
    pub(super) fn retry_later(self) {
        let keeping = self.keeping();
        if keeping.asks_again.get_untracked() {
            return;
        }
        let attempt = keeping.attempts.get_untracked();
        keeping.attempts.set(attempt.saturating_add(1));
        keeping.asks_again.set(true);
        let again = move || {
            keeping.asks_again.set(false);
            self.retry();
        };
        set_timeout(again, pause(attempt));
    }

    /// Sends what waits, once somebody is known to be there.
    pub(super) fn retry(self) {
        let keeping = self.keeping();
        if keeping.saving.get_untracked() {
            return;
        }
        match keeping.server.get_untracked() {
            Server::Asking => self.ask_session(),
            Server::Absent | Server::Locked => {}
            Server::Present(_) => match keeping.queued.get_untracked() {
                Some(queued) => self.send(queued),
                None if keeping.offline.get_untracked() => self.refresh(),
                None => {}
            },
        }
    }

    /// Somebody else saved meanwhile; this is what is done about it.
    pub(super) fn choose(self, choice: Choice) {
        match choice {
            Choice::KeepMine => self.save_copy(),
            Choice::See(head) => self.see_theirs(head.number),
            Choice::TakeTheirs(head) => {
                if let Some(kept) = self.kept() {
                    self.open_revision(kept.id, Some(head.number));
                }
            }
        }
    }

    fn see_theirs(self, number: u64) {
        let Some((kept, mine)) = self.kept().zip(self.derived.specification.get_untracked()) else { return };
        self.show_difference();
        spawn_local(async move {
            let mine = Compared { name: "your work".to_owned(), specification: mine };
            let theirs = self.revision_of(&kept.id, number).await;
            self.compared(theirs.map(|theirs| (mine, theirs)));
        });
    }

    pub(super) fn delete_from_server(self) {
        let Some(kept) = self.kept() else { return };
        spawn_local(async move {
            match server::delete(&kept.id, &kept.etag).await {
                Ok(()) => {
                    self.keeping().lineages.update(|lineages| lineages.retain(|it| it.kept.id != kept.id));
                    self.keeping().entry.set(None);
                    self.close_dialog();
                    self.say(Notice::calm("It is off the server. The work itself is still here."));
                }
                Err(Failure::Refused(problem)) => self.keeping().refusal.set(Some(*problem)),
                Err(failure) => self.refuse_with(failure.to_string()),
            }
        });
    }

    /// Shows in the open dialog why something was not done.
    pub(super) fn refuse_with(self, detail: String) {
        let problem = Problem {
            kind: String::new(),
            title: String::new(),
            status: 0,
            detail,
            head: None,
            approved: None,
            findings: Vec::new(),
        };
        self.keeping().refusal.set(Some(problem));
    }
}

/// What the page remembers of a revision.
pub(super) fn kept(entry: &SpecificationEntry, revision: &Revision, etag: String) -> Kept {
    Kept {
        id: entry.id.clone(),
        revision: revision.number,
        etag,
        sha256: revision.sha256.clone(),
        approved: entry.approved,
    }
}

fn changed_meanwhile(problem: &Problem) -> Option<&Revision> {
    problem.head.as_ref().filter(|_| problem.status == 412)
}

/// A save whose answer was lost on the way looks as if somebody else had saved: the same was saved, so nothing is lost.
async fn own_save(
    result: Result<Tagged<SpecificationEntry>, Failure>,
    queued: &Queued,
) -> Result<Tagged<SpecificationEntry>, Failure> {
    if let (Err(Failure::Refused(problem)), Some(onto)) = (&result, &queued.onto)
        && changed_meanwhile(problem).is_some_and(|head| head.sha256 == sha256(&queued.save.content))
    {
        return server::specification(&onto.id).await;
    }
    result
}

/// How long to wait after so many failures in a row.
fn pause(attempt: u32) -> Duration {
    Duration::from_secs((2_u64 << attempt.min(5)).min(60))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_grow_up_to_a_minute() {
        let pauses: Vec<u64> = [0, 1, 2, 5, 40].into_iter().map(|attempt| pause(attempt).as_secs()).collect();
        assert_eq!(pauses, [2, 4, 8, 60, 60]);
    }
}
