//! Events of several runs, stored together: as many as wait at the same time cost one write to the disk.

use super::event::{append, lock_run, set_last_event};
use super::revision::refuse_nul;
use super::{Appended, NewEvent, Store, StoreError};

/// Events of a run, in their order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RunEvents {
    /// Id of the run.
    pub run: String,
    /// The events.
    pub events: Vec<NewEvent>,
}

impl Store {
    /// Stores events of several runs in one transaction, and tells what became of each: of the events of the first run,
    /// of the second.. An event that is [`Appended::Gap`] or [`Appended::Different`] keeps none after it from being
    /// looked at.
    ///
    /// # Errors
    ///
    /// As [`Store::append_event`]; nothing is stored then.
    pub async fn append_to_runs(&self, parts: &[RunEvents]) -> Result<Vec<Vec<Appended>>, StoreError> {
        for event in parts.iter().flat_map(|part| &part.events) {
            refuse_nul(&[("the event", &event.event)])?;
        }
        let mut writing = self.write().await?;
        let mut all = Vec::with_capacity(parts.len());
        for RunEvents { run, events } in parts {
            let before = lock_run(&mut writing, run).await?;
            let mut last = before;
            let mut outcomes = Vec::with_capacity(events.len());
            for event in events {
                let outcome = append(&mut writing, run, last, event).await?;
                if outcome == Appended::Stored {
                    last = event.number;
                }
                outcomes.push(outcome);
            }
            if last > before {
                set_last_event(&mut writing, run, last).await?;
            }
            all.push(outcomes);
        }
        writing.commit().await?;
        Ok(all)
    }
}
