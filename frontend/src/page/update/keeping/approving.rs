//! Signatures: what is to be signed, and what comes of it.

use std::sync::Arc;

use goalgraph::protocol::api::{Decision, Signature};
use goalgraph::specification::Specification;
use leptos::prelude::*;
use wasm_bindgen_futures::spawn_local;

use super::{App, loaded};
use crate::page::model::{Compared, KeepDialog, Loading, Notice, Signing};
use crate::page::server::{self, Failure};

impl App {
    /// Shows a revision that is to be signed, beside the approved one.
    pub(super) fn prepare(self, revision: u64, dialog: KeepDialog) {
        self.keeping().signing.set(Loading::Waiting);
        self.keeping().compared.set(Loading::Waiting);
        self.ask(dialog);
        self.load_signing(revision, dialog);
    }

    fn load_signing(self, revision: u64, dialog: KeepDialog) {
        let Some(kept) = self.kept() else { return };
        spawn_local(async move {
            let signing = async {
                let entry = server::specification(&kept.id).await?.value;
                let content = server::revision(&kept.id, revision).await?.value;
                let read = Specification::from_json(&content.content);
                let specification = Arc::new(read.map_err(|error| Failure::Strange(error.to_string()))?);
                let approved = entry.approved;
                self.heard_of(entry);
                Ok(Signing { revision: content.revision, specification, approved })
            };
            let signing = signing.await;
            if signing == Err(Failure::Locked) {
                return self.lock();
            }
            self.keeping().signing.set(loaded(signing.clone()));
            if let (Ok(signing), KeepDialog::Approve) = (signing, dialog) {
                self.compare_with_approved(&kept.id, signing).await;
            }
        });
    }

    /// Before the first approval there is nothing to compare with: the revision is shown as it is.
    async fn compare_with_approved(self, id: &str, signing: Signing) {
        let Signing { revision, specification, approved } = signing;
        let after = Compared { name: format!("r{}", revision.number), specification };
        let before = match approved {
            Some(number) => self.revision_of(id, number).await,
            None => Ok(after.clone()),
        };
        self.compared(before.map(|before| (before, after)));
    }

    pub(super) fn sign(self, revision: u64, decision: Decision, signature: Signature) {
        let Some(kept) = self.kept() else { return };
        self.keeping().refusal.set(None);
        spawn_local(async move {
            match server::sign(&kept.id, revision, decision, &signature).await {
                Ok(approval) => {
                    self.close_dialog();
                    self.refresh();
                    let who = approval.who;
                    self.say(Notice::calm(match decision {
                        Decision::Approved => format!("Revision {revision} is approved by {who}."),
                        Decision::Revoked => {
                            format!("The approval of revision {revision} is taken back by {who}.")
                        }
                    }));
                }
                Err(Failure::Locked) => self.lock(),
                Err(Failure::Refused(problem)) => {
                    let meanwhile = problem.status == 409;
                    self.keeping().refusal.set(Some(*problem));
                    if meanwhile {
                        // What is shown must be what is signed next.
                        self.who_meanwhile(&kept.id).await;
                        let dialog = match decision {
                            Decision::Approved => KeepDialog::Approve,
                            Decision::Revoked => KeepDialog::Revoke,
                        };
                        self.load_signing(revision, dialog);
                    }
                }
                Err(failure) => self.refuse_with(failure.to_string()),
            }
        });
    }

    /// Adds to the refusal who signed what meanwhile.
    async fn who_meanwhile(self, id: &str) {
        let Ok(journal) = server::approvals(id).await else { return };
        if let Some(last) = journal.first() {
            let what = match last.decision {
                Decision::Approved => "approved",
                Decision::Revoked => "revoked",
            };
            let sentence =
                format!("{} {what} r{} at {} ({}).", last.who, last.revision, last.at, last.meaning);
            self.keeping().refusal.update(|refusal| {
                if let Some(refusal) = refusal {
                    refusal.findings = vec![sentence];
                }
            });
        }
        self.keeping().approvals.set(Loading::Here(journal));
    }
}
