//! Which tokens and sessions are known.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use sha2::{Digest, Sha256};
use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;

use super::Caller;
use crate::clock;
use crate::digest::sha256_hex;
use crate::store::{Store, StoreError, TokenRow};
use crate::token::Token;

/// Name of the cookie that holds a session.
pub(crate) const SESSION_COOKIE: &str = "goalgraph_session";
/// How long a session lasts.
pub(crate) const SESSION_HOURS: i64 = 12;
/// So many tokens are proven at the same time: each takes 19 MiB of memory.
const PROVEN_AT_ONCE: usize = 2;
/// So many proofs are remembered.
const REMEMBERED: usize = 1_000;

/// The tokens of a store, with those that were proven lately.
pub(super) struct Tokens {
    store: Store,
    turns: Arc<Semaphore>,
    /// SHA-256 of what was shown and the hash that it was proven against: proving takes long, on purpose.
    proven: Mutex<BTreeMap<[u8; 32], String>>,
}

impl Tokens {
    /// The tokens of `store`.
    pub(super) fn of(store: Store) -> Self {
        Self { store, turns: Arc::new(Semaphore::new(PROVEN_AT_ONCE)), proven: Mutex::default() }
    }

    /// Whom the token `shown` stands for; none when it is no token of this server, or was revoked.
    pub(super) async fn of_token(&self, shown: &str) -> Result<Option<Caller>, StoreError> {
        let Some(token) = Token::parse(shown) else {
            return Ok(None);
        };
        let row = match self.store.token(token.id()).await {
            Ok(row) => row,
            Err(StoreError::NotFound { .. }) => return Ok(None),
            Err(error) => return Err(error),
        };
        if row.revoked_at_ms.is_some() || !self.is_proven(token, &row.hash).await {
            return Ok(None);
        }
        caller(row).map(Some)
    }

    /// Whom the session with this secret stands for; none when there is none, it has expired, or its token was revoked.
    pub(super) async fn of_session(&self, secret: &str) -> Result<Option<Caller>, StoreError> {
        let session = self.store.session(&sha256_hex(secret.as_bytes())).await?;
        let Some(session) = session.filter(|session| session.expires_at_ms > clock::now_ms()) else {
            return Ok(None);
        };
        let row = self.store.token(&session.token).await?;
        if row.revoked_at_ms.is_some() { Ok(None) } else { caller(row).map(Some) }
    }

    async fn is_proven(&self, token: Token, hash: &str) -> bool {
        let shown: [u8; 32] = Sha256::digest(token.reveal()).into();
        if self
            .proven
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .get(&shown)
            .is_some_and(|known| known == hash)
        {
            return true;
        }
        let Ok(turn) = Arc::clone(&self.turns).acquire_owned().await else {
            return false;
        };
        let expected = hash.to_owned();
        // The turn goes on for as long as the work does, also when nobody waits for it any more.
        let prove = move || {
            let _turn = turn;
            token.verify(&expected)
        };
        let is_right = spawn_blocking(prove).await.unwrap_or(false);
        if is_right {
            let mut proven = self.proven.lock().unwrap_or_else(PoisonError::into_inner);
            if proven.len() >= REMEMBERED {
                proven.clear();
            }
            proven.insert(shown, hash.to_owned());
        }
        is_right
    }
}

fn caller(row: TokenRow) -> Result<Caller, StoreError> {
    let role = row.role.parse().map_err(|error| StoreError::Corrupt(format!("token {}: {error}", row.id)))?;
    Ok(Caller { token: Some(row.id), name: Some(row.name), role: Some(role) })
}
