//! Tokens: who may do what. Only hashes of their secrets are stored.

use sqlx::FromRow;

use super::revision::refuse_nul;
use super::{Store, StoreError};

/// A token to keep.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewToken {
    /// Id, the part of the token that is no secret.
    pub id: String,
    /// What it is for, or for whom.
    pub name: String,
    /// Name of the role.
    pub role: String,
    /// Hash of the secret.
    pub hash: String,
    /// When, in milliseconds since 1970.
    pub created_at_ms: i64,
}

/// A token.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct TokenRow {
    /// Id.
    pub id: String,
    /// What it is for, or for whom.
    pub name: String,
    /// Name of the role.
    pub role: String,
    /// Hash of the secret.
    pub hash: String,
    /// When it was made, in milliseconds since 1970.
    pub created_at_ms: i64,
    /// When it was revoked, in milliseconds since 1970, if it was.
    pub revoked_at_ms: Option<i64>,
}

/// The query for tokens, with what follows the table.
macro_rules! select {
    ($rest:literal) => {
        concat!("SELECT id, name, role, hash, created_at_ms, revoked_at_ms FROM tokens ", $rest)
    };
}

impl Store {
    /// Keeps a token.
    ///
    /// # Errors
    ///
    /// [`StoreError::Invalid`] when its name cannot be stored; when the database fails.
    pub async fn create_token(&self, new: NewToken) -> Result<(), StoreError> {
        refuse_nul(&[("the token's name", &new.name)])?;
        let mut writing = self.write().await?;
        let sequence = writing.next_sequence().await?;
        sqlx::query(
            "INSERT INTO tokens (id, sequence, name, role, hash, created_at_ms, revoked_at_ms) \
             VALUES ($1, $2, $3, $4, $5, $6, NULL)",
        )
        .bind(&new.id)
        .bind(sequence)
        .bind(&new.name)
        .bind(&new.role)
        .bind(&new.hash)
        .bind(new.created_at_ms)
        .execute(writing.connection())
        .await?;
        writing.commit().await
    }

    /// Every token, in the order in which they were made.
    ///
    /// # Errors
    ///
    /// When the database fails.
    pub async fn tokens(&self) -> Result<Vec<TokenRow>, StoreError> {
        Ok(sqlx::query_as(select!("ORDER BY sequence")).fetch_all(&self.pool).await?)
    }

    /// One token, revoked or not.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; when the database fails.
    pub async fn token(&self, id: &str) -> Result<TokenRow, StoreError> {
        let row = sqlx::query_as(select!("WHERE id = $1")).bind(id).fetch_optional(&self.pool).await?;
        row.ok_or_else(|| StoreError::not_found("token", id))
    }

    /// Revokes a token and ends its sessions. One that is revoked stays so since it first was.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; when the database fails.
    pub async fn revoke_token(&self, id: &str, at_ms: i64) -> Result<(), StoreError> {
        let mut writing = self.write().await?;
        let revoked =
            sqlx::query("UPDATE tokens SET revoked_at_ms = COALESCE(revoked_at_ms, $1) WHERE id = $2")
                .bind(at_ms)
                .bind(id)
                .execute(writing.connection())
                .await?;
        if revoked.rows_affected() == 0 {
            return Err(StoreError::not_found("token", id));
        }
        sqlx::query("DELETE FROM sessions WHERE token = $1").bind(id).execute(writing.connection()).await?;
        writing.commit().await
    }
}
