//! What is approved, as executors are told it: each follower sees the newest, and no older one after it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use axum::extract::ws::Utf8Bytes;
use goalgraph::protocol::executor::ToExecutor;
use goalgraph::protocol::monitor::{Answer, Held};
use tokio::sync::{Mutex, watch};

use super::relayed_run::Automaton;
use super::{RelayError, archive};
use crate::store::{ApprovedRow, Store, StoreError};

/// What an executor follows.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Follow {
    /// The specification that was approved last, whichever it is.
    Latest,
    /// The one with this id.
    Specification(String),
}

/// An approved revision, ready to be sent.
#[derive(Debug)]
pub(super) struct Offer {
    /// Which revision, of what.
    pub(super) row: ApprovedRow,
    /// What its runs are followed through.
    pub(super) automaton: Arc<Automaton>,
    /// The message that carries it: written once, shared by all connections.
    pub(super) message: Utf8Bytes,
}

/// The offer, or that nothing is approved.
pub(super) type Offered = Option<Arc<Offer>>;

impl Offer {
    /// As a page sees it at an executor that has not answered yet.
    pub(super) fn held(&self) -> Held {
        Held {
            specification: self.row.specification.clone(),
            name: self.row.name.clone(),
            revision: self.row.revision,
            sha256: self.row.sha256.clone(),
            answer: Answer::Awaited,
        }
    }

    async fn load(store: &Store, row: ApprovedRow) -> Result<Arc<Self>, RelayError> {
        let (content, automaton) = archive::revision(store, &row.specification, row.revision).await?;
        let message = ToExecutor::Specification {
            specification: row.specification.clone(),
            revision: row.revision,
            approval: row.sequence,
            sha256: row.sha256.clone(),
            content,
        };
        Ok(Arc::new(Self { row, automaton, message: super::outgoing::text_of(&message) }))
    }
}

/// The offers that are followed.
#[derive(Debug, Default)]
pub(super) struct Offers {
    /// Held while the store is read, so that what is read later is also told later.
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    channels: BTreeMap<Follow, watch::Sender<Offered>>,
    /// Specifications whose approval changed while the store could not be read.
    behind: BTreeSet<String>,
}

impl Offers {
    /// Follows; the present offer can be read at once.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub(super) async fn follow(
        &self,
        store: &Store,
        follow: Follow,
    ) -> Result<watch::Receiver<Offered>, RelayError> {
        let mut state = self.state.lock().await;
        if let Some(channel) = state.channels.get(&follow) {
            return Ok(channel.subscribe());
        }
        let offered = state.read(store, &follow).await?;
        state.channels.retain(|_, channel| channel.receiver_count() > 0);
        let (channel, receiver) = watch::channel(offered);
        state.channels.insert(follow, channel);
        Ok(receiver)
    }

    /// Tells the followers of `specification`, and of the latest, what is approved now, and returns it.
    ///
    /// # Errors
    ///
    /// When the store cannot be read: [`Offers::behind`] names the specification from then on.
    pub(super) async fn refresh(
        &self,
        store: &Store,
        specification: &str,
    ) -> Result<Option<ApprovedRow>, RelayError> {
        let mut state = self.state.lock().await;
        state.behind.insert(specification.to_owned());
        for follow in [Follow::Specification(specification.to_owned()), Follow::Latest] {
            if state.channels.contains_key(&follow) {
                let offered = state.read(store, &follow).await?;
                state.publish(&follow, offered);
            }
        }
        let approved = store.approved(specification).await?;
        state.behind.remove(specification);
        Ok(approved)
    }

    /// The specifications for which a refresh failed.
    pub(super) async fn behind(&self) -> BTreeSet<String> {
        self.state.lock().await.behind.clone()
    }
}

impl State {
    async fn read(&self, store: &Store, follow: &Follow) -> Result<Offered, RelayError> {
        let row = match follow {
            Follow::Latest => store.latest_approved().await?,
            Follow::Specification(id) => store.approved(id).await?,
        };
        let Some(row) = row else { return Ok(None) };
        if let Some(offer) = self.known(&row) {
            return Ok(Some(offer));
        }
        match Offer::load(store, row).await {
            Ok(offer) => Ok(Some(offer)),
            // Nothing would change by trying again: better no specification than one that is not what was approved.
            Err(error @ (RelayError::Specification { .. } | RelayError::Store(StoreError::Corrupt(_)))) => {
                tracing::error!(%error, "an approved revision cannot be relayed");
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// The same approval, if another channel has it.
    fn known(&self, row: &ApprovedRow) -> Option<Arc<Offer>> {
        let offers = self.channels.values().filter_map(|channel| channel.borrow().clone());
        offers.into_iter().find(|offer| offer.row == *row)
    }

    fn publish(&self, follow: &Follow, offered: Offered) {
        let sequence = |offered: &Offered| offered.as_ref().map(|offer| offer.row.sequence);
        if let Some(channel) = self.channels.get(follow) {
            channel.send_if_modified(|present| {
                let changes = sequence(present) != sequence(&offered);
                *present = offered;
                changes
            });
        }
    }
}
