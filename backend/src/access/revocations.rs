//! Revoked tokens end the connections that were opened with them.

use std::time::Duration;

use crate::relay::Relay;
use crate::store::Store;

/// The time between two looks. Tokens are revoked by another program, on the same store.
const PAUSE: Duration = Duration::from_secs(2);

/// Looks for revoked tokens for as long as the program runs.
pub async fn end_revoked(store: Store, relay: Relay) {
    loop {
        match store.tokens().await {
            Ok(tokens) => {
                // Every time: a connection may have been on its way when the token was revoked.
                for token in tokens.iter().filter(|token| token.revoked_at_ms.is_some()) {
                    relay.disconnect_token(&token.id);
                }
            }
            Err(error) => tracing::warn!(%error, "revoked tokens cannot be looked for; trying again"),
        }
        tokio::time::sleep(PAUSE).await;
    }
}
