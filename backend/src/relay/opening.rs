//! A relay that begins where the one before it ended.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use goalgraph::protocol::monitor::ApprovedView;
use tokio::sync::{Semaphore, mpsc};
use tokio::time::Instant;

use super::counts::Counters;
use super::hub::Hub;
use super::lines::Lines;
use super::offer::Offers;
use super::relayed_run::Automaton;
use super::{Inner, Relay, RelayError, RelayLimits, archive, upkeep, writer};
use crate::store::{MAX_PAGE, PageRequest, RunFilter, RunRow, Store};

impl Relay {
    /// A relay over `store`, which knows the runs that are not over, the last that are, and what is approved.
    ///
    /// It works until the last clone of it is dropped; [`Relay::shutdown`] ends it in peace.
    ///
    /// # Errors
    ///
    /// When the store cannot be read. A run that cannot is left out.
    pub async fn open(store: Store, limits: RelayLimits) -> Result<Self, RelayError> {
        let mut hub = Hub::default();
        take_in_approved(&mut hub, &store).await?;
        take_in_runs(&mut hub, &store, &limits).await?;
        let (jobs, waiting) = mpsc::channel(writer::QUEUE);
        let inner = Arc::new(Inner {
            store,
            since: Instant::now(),
            hub: Mutex::new(hub),
            offers: Offers::default(),
            lines: Lines::new(),
            counts: Counters::default(),
            jobs,
            rooms: Arc::new(Semaphore::new(limits.queue_bytes)),
            executor_slots: Arc::new(Semaphore::new(limits.executors)),
            monitor_slots: Arc::new(Semaphore::new(limits.monitors)),
            limits,
        });
        tokio::spawn(writer::work(Arc::downgrade(&inner), waiting));
        tokio::spawn(upkeep::keep_up(Arc::downgrade(&inner)));
        Ok(Self { inner })
    }
}

async fn take_in_approved(hub: &mut Hub, store: &Store) -> Result<(), RelayError> {
    let mut page = PageRequest { after: None, limit: MAX_PAGE };
    loop {
        let part = store.specifications(&page).await?;
        for row in part.rows.into_iter().filter(|row| row.approved().is_some()) {
            let Some(approved) = store.approved(&row.id).await? else { continue };
            let revision = Some(approved.revision);
            hub.mark_approved(ApprovedView { specification: row.id, name: approved.name, revision });
        }
        page.after = part.next;
        if page.after.is_none() {
            return Ok(());
        }
    }
}

/// The newest runs that are not over, as many as are kept without a lease, and the newest that are.
async fn take_in_runs(hub: &mut Hub, store: &Store, limits: &RelayLimits) -> Result<(), RelayError> {
    let open = RunFilter { specification: None, open_only: true };
    let mut rows = newest(store, &open, limits.idle_runs, |_| true).await?;
    rows.extend(newest(store, &RunFilter::default(), limits.finished_runs, |row| !row.is_open()).await?);
    let mut automata: BTreeMap<(String, u64), Arc<Automaton>> = BTreeMap::new();
    for row in rows {
        let id = row.id.clone();
        match read(store, row, &mut automata).await {
            Ok(run) => hub.take_in(run),
            Err(error) => tracing::warn!(run = id, %error, "a run cannot be read"),
        }
    }
    Ok(())
}

/// The newest `wanted` rows that are meant.
async fn newest(
    store: &Store,
    filter: &RunFilter,
    wanted: usize,
    is_meant: impl Fn(&RunRow) -> bool,
) -> Result<Vec<RunRow>, RelayError> {
    let mut page = PageRequest { after: None, limit: MAX_PAGE };
    let mut found = Vec::new();
    loop {
        let part = store.runs(filter, &page).await?;
        let missing = wanted - found.len();
        found.extend(part.rows.into_iter().filter(&is_meant).take(missing));
        page.after = part.next;
        if page.after.is_none() || found.len() == wanted {
            return Ok(found);
        }
    }
}

/// The run of a row. Many runs follow the same revision, which is read once.
async fn read(
    store: &Store,
    row: RunRow,
    automata: &mut BTreeMap<(String, u64), Arc<Automaton>>,
) -> Result<super::relayed_run::RelayedRun, RelayError> {
    let revision = (row.specification.clone(), row.revision);
    let automaton = if let Some(automaton) = automata.get(&revision) {
        automaton.clone()
    } else {
        let (_, automaton) = archive::revision(store, &row.specification, row.revision).await?;
        automata.insert(revision, automaton.clone());
        automaton
    };
    archive::follow(store, row, automaton).await
}
