//! Sessions: browsers that have shown a token. Only hashes of their ids are stored.

use sqlx::FromRow;

use super::{Store, StoreError};

/// A session.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct SessionRow {
    /// Id of the token that was shown.
    pub token: String,
    /// When it ends, in milliseconds since 1970.
    pub expires_at_ms: i64,
}

impl Store {
    /// Keeps a session of a token, under the hash of its id.
    ///
    /// # Errors
    ///
    /// When there is no such token, or the database fails.
    pub async fn create_session(
        &self,
        hash: &str,
        token: &str,
        expires_at_ms: i64,
    ) -> Result<(), StoreError> {
        let mut writing = self.write().await?;
        sqlx::query("INSERT INTO sessions (hash, token, expires_at_ms) VALUES ($1, $2, $3)")
            .bind(hash)
            .bind(token)
            .bind(expires_at_ms)
            .execute(writing.connection())
            .await?;
        writing.commit().await
    }

    /// The session under a hash, ended or not; none when its token was revoked.
    ///
    /// # Errors
    ///
    /// When the database fails.
    pub async fn session(&self, hash: &str) -> Result<Option<SessionRow>, StoreError> {
        let query = sqlx::query_as("SELECT token, expires_at_ms FROM sessions WHERE hash = $1");
        Ok(query.bind(hash).fetch_optional(&self.pool).await?)
    }

    /// Ends a session, if there is one.
    ///
    /// # Errors
    ///
    /// When the database fails.
    pub async fn delete_session(&self, hash: &str) -> Result<(), StoreError> {
        let mut writing = self.write().await?;
        let query = sqlx::query("DELETE FROM sessions WHERE hash = $1");
        query.bind(hash).execute(writing.connection()).await?;
        writing.commit().await
    }

    /// Forgets the sessions that have ended at `now_ms`, and returns how many they were.
    ///
    /// # Errors
    ///
    /// When the database fails.
    pub async fn delete_expired_sessions(&self, now_ms: i64) -> Result<u64, StoreError> {
        let mut writing = self.write().await?;
        let query = sqlx::query("DELETE FROM sessions WHERE expires_at_ms <= $1");
        let deleted = query.bind(now_ms).execute(writing.connection()).await?;
        writing.commit().await?;
        Ok(deleted.rows_affected())
    }
}
