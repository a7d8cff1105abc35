//! Recordings go to the server with the specification that was learned from them, and come back with it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use goalgraph::specification::Specification;
use js_sys::{Array, Uint8Array};
use leptos::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::File;

use super::App;
use crate::page::model::Notice;
use crate::page::server::{self, Failure};
use crate::protocol::{FileContent, FileId};

impl App {
    /// Gives the server the recordings of the work that it does not have. `other` is a specification that has some.
    pub(super) fn upload_recordings(self, id: String, other: Option<String>) {
        let recordings = self.recordings_by_digest();
        if recordings.is_empty() {
            return;
        }
        spawn_local(async move {
            let uploaded = self.upload(&id, other, recordings).await;
            self.keeping().uploading.set(None);
            if let Err(failure) = uploaded {
                self.say(Notice::alarm(format!(
                    "Saved, but not all recordings are at the server: {failure}."
                )));
            }
        });
    }

    async fn upload(
        self,
        id: &str,
        other: Option<String>,
        recordings: BTreeMap<String, File>,
    ) -> Result<(), Failure> {
        let digests = async |id: &str| {
            let files = server::linked_demonstrations(id).await?;
            Ok::<_, Failure>(files.into_iter().map(|file| file.sha256).collect::<BTreeSet<_>>())
        };
        let linked = digests(id).await?;
        let known = match other.filter(|other| other != id) {
            Some(other) => digests(&other).await.unwrap_or_default(),
            None => BTreeSet::new(),
        };
        let missing: Vec<_> = recordings.into_iter().filter(|(sha256, _)| !linked.contains(sha256)).collect();
        let number = missing.len();
        for (done, (sha256, file)) in missing.into_iter().enumerate() {
            self.keeping().uploading.set(Some((done, number)));
            let given = if known.contains(&sha256) {
                Ok(())
            } else {
                server::put_demonstration(&sha256, &file).await
            };
            // A server that has a recording may hang up while it is sent once more: what counts is that it has it.
            let linked = server::link_demonstration(id, &sha256, &file.name()).await;
            linked.map_err(|failure| given.err().unwrap_or(failure))?;
        }
        Ok(())
    }

    /// The loaded recordings that the work was learned from, by their digests.
    fn recordings_by_digest(self) -> BTreeMap<String, File> {
        let Some(specification) = self.derived.specification.get_untracked() else { return BTreeMap::new() };
        let wanted = digests_of(&specification);
        let outside = self.outside.get_value();
        let handles = outside.files.borrow();
        let accepted = self.derived.accepted.get_untracked();
        let of = |(id, content): (FileId, Arc<FileContent>)| {
            let file = handles.get(&id).filter(|_| wanted.contains(&content.sha256))?;
            Some((content.sha256.clone(), file.clone()))
        };
        accepted.into_iter().filter_map(of).collect()
    }

    /// Fetches the recordings of the work that are not loaded; the worker reads them as it does dropped ones.
    pub(super) fn bring_recordings(self, id: String) {
        let Some(specification) = self.derived.specification.get_untracked() else { return };
        let mut wanted = digests_of(&specification);
        for (_, content) in self.derived.accepted.get_untracked() {
            wanted.remove(&content.sha256);
        }
        if wanted.is_empty() {
            return;
        }
        spawn_local(async move {
            match fetch(&id, &wanted).await {
                Ok(files) if files.is_empty() => {}
                // Somebody has opened something else meanwhile.
                Ok(_) if self.kept().is_none_or(|kept| kept.id != id) => {}
                Ok(files) => {
                    // They belong to what is there: nothing is learned from them unasked.
                    self.model.learned.set(None);
                    self.outside.get_value().brought.set(true);
                    self.open(files);
                }
                Err(failure) => {
                    self.say(Notice::alarm(format!("Open, but its recordings are not here: {failure}.")));
                }
            }
        });
    }
}

/// The digests of the files that a specification was learned from.
fn digests_of(specification: &Specification) -> BTreeSet<String> {
    let digests = specification.demonstrations.iter().map(|it| it.sha256.clone());
    digests.filter(|digest| !digest.is_empty()).collect()
}

async fn fetch(id: &str, wanted: &BTreeSet<String>) -> Result<Vec<(String, File)>, Failure> {
    let linked = server::linked_demonstrations(id).await?;
    let mut files = Vec::new();
    for entry in linked.into_iter().filter(|entry| wanted.contains(&entry.sha256)) {
        let bytes = server::demonstration(&entry.sha256).await?;
        let bytes = Uint8Array::from(bytes.as_slice());
        let file = File::new_with_buffer_source_sequence(&Array::of1(&bytes), &entry.name);
        let file = file.map_err(|_| Failure::Strange(format!("{} cannot be kept", entry.name)))?;
        files.push((entry.name, file));
    }
    Ok(files)
}
