//! How the work stands with the server, and what differs between two revisions.

mod drawing;
mod standing;

use std::sync::Arc;

use goalgraph::specification::Specification;
use leptos::prelude::*;
use sha2::{Digest, Sha256};

use crate::page::model::{Lineage, Model};

pub(crate) use drawing::{Drawing, Sign, state_words};
use standing::Standing;

/// All memos about the server.
pub(crate) struct Keeping {
    /// What of the server the work is at the present place of its history.
    pub(crate) lineage: Memo<Option<Lineage>>,
    /// Whether there are edits that only this browser has.
    pub(crate) has_unsaved: Memo<bool>,
    /// How it stands, for the bar of the page.
    pub(crate) standing: Memo<Standing>,
    /// What differs between what is compared, as it is drawn.
    pub(crate) drawing: Memo<Option<Arc<Drawing>>>,
}

impl Keeping {
    /// The memos over `model`; `specification` is the work.
    pub(super) fn of(model: &'static Model, specification: Memo<Option<Arc<Specification>>>) -> Self {
        let keeping = &model.keeping;
        let position = Memo::new(move |_| {
            model.history.with(|history| history.as_ref().map(|it| (it.position(), it.labels().len())))
        });
        let lineage = Memo::new(move |_| {
            let (position, _) = position.get()?;
            keeping.lineages.with(|all| all.iter().rev().find(|it| it.from <= position).cloned())
        });
        // Only work that is on the server is compared with what is there.
        let digest = Memo::new(move |_| {
            let kept = lineage.with(Option::is_some);
            kept.then(|| specification.get().map(|it| sha256(&it.to_json()))).flatten()
        });
        let is_changed = Memo::new(move |_| {
            let digest = digest.get();
            lineage.with(|it| it.as_ref().map(|it| digest.as_deref() != Some(it.kept.sha256.as_str())))
        });
        let has_unsaved = Memo::new(move |_| {
            let edited = position.get().is_some_and(|(_, steps)| steps > 0);
            is_changed.get().unwrap_or(edited) || keeping.queued.with(Option::is_some)
        });
        let standing = Memo::new(move |_| {
            lineage.with(|lineage| {
                let asked = standing::Asked {
                    lineage: lineage.as_ref(),
                    position: position.get().map(|(position, _)| position),
                    changed: is_changed.get().unwrap_or(false),
                    saving: keeping.saving.get(),
                    queued: keeping.queued.with(Option::is_some),
                    offline: keeping.offline.get(),
                    head: keeping
                        .entry
                        .with(|entry| entry.as_ref().map(|it| (it.id.clone(), it.head.number))),
                };
                keeping.server.with(|server| Standing::of(server, &asked))
            })
        });
        let drawing = Memo::new(move |_| {
            let compared = keeping.compared.get();
            let (before, after) = compared.here()?;
            Some(Arc::new(Drawing::of(&before.specification, &after.specification)))
        });
        Self { lineage, has_unsaved, standing, drawing }
    }
}

/// SHA-256 of a text, in lower-case hexadecimal digits.
pub(crate) fn sha256(text: &str) -> String {
    use std::fmt::Write;
    let digest = Sha256::digest(text.as_bytes());
    digest.iter().fold(String::with_capacity(64), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}
