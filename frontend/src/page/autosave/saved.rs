//! The form in which the work is kept between visits, and how it is told from what cannot be read.

use std::collections::BTreeMap;

use goalgraph::history::{History, HistoryError, HistoryLog};
use goalgraph::infer::InferRequest;
use goalgraph::layout::Point;
use goalgraph::pdfa::StateId;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::page::model::{Lineage, Queued};
use crate::protocol::Outcome;

const FORMAT: &str = "goalgraph-work";
/// The version that is written. One that cannot be read is kept aside, never dropped.
const VERSION: u32 = 1;

/// The work, but for the recordings, which are kept as files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Saved {
    /// What kind of data this is.
    pub(super) format: String,
    /// Version of the form.
    pub(super) version: u32,
    /// The specification with everything that was done to it.
    pub(super) history: Option<HistoryLog>,
    /// States that were put somewhere.
    pub(super) held: BTreeMap<StateId, Point>,
    /// What the task is called while nothing was learned.
    pub(super) task_name: String,
    /// The recordings, in the order in which they came.
    pub(super) files: Vec<String>,
    /// What was learned last.
    pub(super) learned: Option<SavedLearning>,
    /// What of the server it is.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) lineages: Vec<Lineage>,
    /// What is still to be saved on the server.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) queued: Option<Queued>,
}

/// An outcome and what it was learned from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SavedLearning {
    /// The recordings, in the order of the demonstrations.
    pub(super) files: Vec<String>,
    /// How it was learned.
    pub(super) request: InferRequest,
    /// What came out.
    pub(super) outcome: Outcome,
}

/// Why saved work cannot be read.
#[derive(Debug, Error)]
pub(super) enum SavedError {
    /// It has another shape.
    #[error("{0}")]
    Shape(#[from] serde_json::Error),
    /// It is of a version that this program does not know.
    #[error("version {0}, but this program reads version {VERSION}")]
    Version(u32),
    /// Its history makes no sense.
    #[error("{0}")]
    History(#[from] HistoryError),
}

/// What a text says of itself.
#[derive(Deserialize)]
struct Kind {
    version: u32,
}

impl Saved {
    /// Nothing yet.
    pub(super) fn empty() -> Self {
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            history: None,
            held: BTreeMap::new(),
            task_name: String::new(),
            files: Vec::new(),
            learned: None,
            lineages: Vec::new(),
            queued: None,
        }
    }

    /// The text that is kept.
    pub(super) fn to_json(&self) -> String {
        // It holds nothing that JSON cannot.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Reads a text that was kept, with the history made anew from its steps.
    pub(super) fn from_json(text: &str) -> Result<(Self, Option<History>), SavedError> {
        match serde_json::from_str(text) {
            Ok(Kind { version }) if version != VERSION => return Err(SavedError::Version(version)),
            _ => {}
        }
        let mut saved: Self = serde_json::from_str(text)?;
        let history = saved.history.take().map(History::from_log).transpose()?;
        Ok((saved, history))
    }
}

#[cfg(test)]
mod tests {
    use goalgraph::edit::Edit;
    use goalgraph::history::Transaction;
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;
    use goalgraph::protocol::api::Save;

    use super::*;
    use crate::page::model::{Kept, Onto};

    fn saved() -> (Saved, History) {
        let words = [vec!["a".to_owned(), "b".to_owned()]];
        let mut history = History::new(infer_words("Tower", Semantics::default(), &words));
        let edits = vec![Edit::RenameTask { name: "Tower of two".to_owned() }];
        history.commit(Transaction { label: "Rename".to_owned(), edits }).unwrap();
        let held = BTreeMap::from([(StateId(1), Point::new(3.5, -2.0))]);
        let saved = Saved { history: Some(history.log()), held, ..Saved::empty() };
        (saved, history)
    }

    #[test]
    fn saved_work_comes_back_as_it_was() {
        let (saved, history) = saved();
        let (read, restored) = Saved::from_json(&saved.to_json()).unwrap();
        assert_eq!(read.held, saved.held);
        let restored = restored.unwrap();
        assert_eq!(restored.specification(), history.specification());
        assert_eq!(restored.labels(), ["Rename"]);
    }

    #[test]
    fn what_it_is_on_the_server_and_what_waits_come_back_as_well() {
        let kept = Kept {
            id: "a".to_owned(),
            revision: 7,
            etag: "\"r7-0\"".to_owned(),
            sha256: "0".to_owned(),
            approved: Some(6),
        };
        let save =
            Save { content: "{}".to_owned(), author: None, message: "so far".to_owned(), positions: None };
        let onto = Some(Onto { id: "a".to_owned(), etag: kept.etag.clone() });
        let lineages = vec![Lineage { from: 0, kept, revisions: BTreeMap::from([(1, 7)]) }];
        let queued = Some(Queued { onto, save, position: 1 });
        let work = Saved { lineages: lineages.clone(), queued: queued.clone(), ..saved().0 };
        let (read, _) = Saved::from_json(&work.to_json()).unwrap();
        assert_eq!((read.lineages, read.queued), (lineages, queued));
    }

    #[test]
    fn work_that_was_kept_before_there_was_a_server_is_read() {
        let text = saved().0.to_json();
        assert!(!text.contains("lineages") && !text.contains("queued"), "{text}");
        assert_eq!(Saved::from_json(&text).unwrap().0.lineages, []);
    }

    #[test]
    fn another_version_is_refused_as_such() {
        let text = saved().0.to_json().replacen("\"version\":1", "\"version\":7", 1);
        let refusal = Saved::from_json(&text).unwrap_err().to_string();
        assert_eq!(refusal, "version 7, but this program reads version 1");
    }

    #[test]
    fn what_is_no_saved_work_is_refused_with_the_place() {
        let refusal = Saved::from_json("{\"version\": 1}").unwrap_err().to_string();
        assert!(refusal.contains("line 1"), "{refusal}");
    }
}
