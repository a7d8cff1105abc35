//! Files that come and go.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use leptos::prelude::*;
use web_sys::File;

use super::App;
use crate::page::autosave;
use crate::page::model::{
    Basis, LoadedFile, Model, Notice, Reading, Search, Settings, Simulation, Tab, Tidied, UNTITLED,
};
use crate::protocol::{DemonstrationId, FileId, FileToRead, ToWorker};

/// An inference that takes longer is waited for with a recording on display; a shorter one is shown at once instead.
const MEANWHILE: Duration = Duration::from_millis(200);

impl App {
    /// Takes files, in byte order of their names; one with the name of an earlier one takes its place.
    pub(super) fn open(self, mut files: Vec<(String, File)>) {
        if self.model.inferring.with_untracked(Option::is_some) {
            // What is being inferred is outdated from now on; do not let the new files wait for it.
            self.restart_worker();
        }
        files.sort_by(|a, b| a.0.cmp(&b.0));
        let outside = self.outside.get_value();
        let mut ids = Vec::new();
        for (name, file) in files {
            let earlier =
                self.model.files.with_untracked(|known| known.iter().find(|f| f.name == name).map(|f| f.id));
            if let Some(id) = earlier {
                self.forget(id);
            }
            let id = FileId(outside.next_file.replace(outside.next_file.get() + 1));
            let loaded = LoadedFile { id, name, bytes: file.size(), reading: Reading::Waiting };
            outside.files.borrow_mut().insert(id, file);
            self.model.files.update(|files| files.push(loaded));
            ids.push(id);
        }
        self.read(&ids);
    }

    /// Has files read, for the first time or again.
    pub(super) fn read(self, ids: &[FileId]) {
        self.set_readings(ids.iter().map(|&id| (id, Reading::Waiting)).collect());
        self.post_files(ids);
    }

    /// Gives files to the worker.
    pub(super) fn post_files(self, ids: &[FileId]) {
        let outside = self.outside.get_value();
        let known = outside.files.borrow();
        let handles = ids.iter().filter_map(|id| known.get_key_value(id));
        let (requests, files): (Vec<FileToRead>, Vec<&File>) =
            handles.map(|(&file, handle)| (FileToRead { file, name: handle.name() }, handle)).unzip();
        if !files.is_empty() {
            self.post(&ToWorker::Read(requests), files);
        }
    }

    /// Takes what became of files. They are all shown at once.
    pub(super) fn set_readings(self, mut readings: BTreeMap<FileId, Reading>) {
        self.model.files.update(|files| {
            for file in files {
                if let Some(reading) = readings.remove(&file.id) {
                    file.reading = reading;
                }
            }
        });
    }

    pub(super) fn forget(self, id: FileId) {
        self.outside.get_value().files.borrow_mut().remove(&id);
        self.post(&ToWorker::Forget { file: id }, None);
        self.model.files.update(|files| files.retain(|file| file.id != id));
        if self.model.demonstration.get_untracked().is_some_and(|shown| shown.file == id) {
            self.model.demonstration.set(None);
        }
    }

    pub(super) fn remove(self, id: FileId) {
        self.forget(id);
        self.settle();
    }

    pub(super) fn clear(self) {
        if self.model.inferring.get_untracked().is_some() || self.derived.reading.get_untracked() {
            self.restart_worker();
        }
        self.forget_attempt();
        if let Some(work) = autosave::let_go(self) {
            self.outside.get_value().let_go.replace(Some(work));
            self.model.can_bring_back.set(true);
        }
        let ids: Vec<FileId> =
            self.model.files.with_untracked(|files| files.iter().map(|file| file.id).collect());
        for id in ids {
            self.forget(id);
        }
        self.model.task_name.set(UNTITLED.to_owned());
        self.model.settings.set(Settings::default());
        self.drop_learned();
        self.model.tab.set(Tab::Demonstrations);
        self.say(Notice::calm("Everything is cleared. \"Bring back\" in the commands undoes it."));
    }

    /// Brings back what was cleared last; what is there now can be brought back after that.
    pub(super) fn bring_back(self) {
        let Some(work) = self.outside.get_value().let_go.take() else { return };
        self.model.can_bring_back.set(false);
        self.clear();
        autosave::bring_back(self, work);
    }

    fn drop_learned(self) {
        let model = self.model;
        model.learned.set(None);
        model.history.set(None);
        self.forget_lineages();
        model.draft.set(None);
        model.vetoed.update(BTreeSet::clear);
        model.locked.update(BTreeSet::clear);
        model.tidied.update(|tidied| {
            // An answer that is still to come is of something that is gone.
            let asked = tidied.asked + 1;
            *tidied = Tidied { asked, answered: asked, ..Tidied::default() };
        });
        model.held.set(BTreeMap::new());
        model.viewport.set(None);
        model.selection.set(Vec::new());
        model.lit.update(BTreeSet::clear);
        model.hidden_below.set(0.0);
        model.search.set(Search::default());
        model.simulation.set(Simulation::default());
        model.unavailable.update(BTreeSet::clear);
    }

    /// Whether nobody has changed what was learned, so that nothing is lost when it goes with its files.
    fn is_unedited(self) -> bool {
        self.model.learned.with_untracked(Option::is_some)
            && self
                .model
                .history
                .with_untracked(|history| history.as_ref().is_some_and(|history| history.labels().is_empty()))
    }

    /// Once no file is being read any more: shows something, and infers when there is something new to infer from.
    pub(super) fn settle(self) {
        if self.derived.reading.get_untracked() {
            return;
        }
        let outside = self.outside.get_value();
        match self.derived.basis.get_untracked() {
            Some(basis) if outside.brought.take() => self.model.canceled.set(Some(basis)),
            None if self.is_unedited() => self.drop_learned(),
            None => {}
            Some(basis) if self.is_known(&basis) => {}
            Some(_) => self.infer(),
        }
        if self.model.inferring.with_untracked(Option::is_some) {
            set_timeout(move || self.show_some_recording(), MEANWHILE);
        } else {
            self.show_some_recording();
        }
    }

    /// Shows the first recording where none is shown.
    fn show_some_recording(self) {
        if self.model.demonstration.get_untracked().is_none()
            && let Some((file, _)) = self.derived.accepted.get_untracked().first()
        {
            self.show(DemonstrationId { file: *file, index: 0 });
        }
    }

    /// Whether there is no need to infer from `basis`: that was done, is being done, or somebody canceled it.
    fn is_known(self, basis: &Basis) -> bool {
        let Model { learned, inferring, canceled, .. } = self.model;
        learned.with_untracked(|learned| learned.as_ref().is_some_and(|learned| learned.basis == *basis))
            || inferring.with_untracked(|inferring| inferring.as_ref().is_some_and(|it| it.basis == *basis))
            || canceled.with_untracked(|canceled| canceled.as_ref() == Some(basis))
    }

    pub(super) fn show(self, demonstration: DemonstrationId) {
        self.model.demonstration.set(Some(demonstration));
        self.model.moment.set(None);
        self.post(&ToWorker::Track { demonstration }, None);
    }

    /// The recording of the demonstration at a position of the specification, where it is loaded: what was learned has
    /// them in the order of the accepted files.
    pub(crate) fn recording(self, index: usize) -> Option<DemonstrationId> {
        let specification = self.derived.specification.get()?;
        let accepted = self.derived.accepted.get();
        let mut all = accepted.iter().flat_map(|(file, content)| {
            let entries = content.demonstrations.iter().enumerate();
            entries.map(|(index, entry)| (DemonstrationId { file: *file, index }, &entry.name))
        });
        let (id, name) = all.nth(index)?;
        (*name == specification.demonstrations.get(index)?.name).then_some(id)
    }

    /// Shows the demonstration at a position of the specification.
    pub(super) fn show_named(self, index: usize, frame: Option<usize>) {
        match untrack(|| self.recording(index)) {
            Some(demonstration) => {
                self.show(demonstration);
                self.model.moment.set(frame);
                self.model.tab.set(Tab::Demonstrations);
            }
            None => self.say(Notice::alarm("The recording of this demonstration is not loaded.")),
        }
    }
}
