//! Demonstration files: kept once, by their SHA-256, and linked to the specifications that use them.

use std::io;

use futures_util::Stream;
use sqlx::FromRow;
use tokio::fs::File;

use super::revision::refuse_nul;
use super::{Store, StoreError};

/// What is known of a file before its bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewDemonstration {
    /// The file's name.
    pub name: String,
    /// Its media type, such as `text/csv`.
    pub media_type: String,
    /// The largest size that is stored.
    pub limit_bytes: u64,
    /// The SHA-256 that the file must have, if that is known before.
    pub expected_sha256: Option<String>,
    /// When, in milliseconds since 1970.
    pub at_ms: i64,
}

/// A stored file.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct DemonstrationRow {
    /// SHA-256 of the file, 64 lower-case hexadecimal digits.
    pub sha256: String,
    /// Its size.
    #[sqlx(try_from = "i64")]
    pub bytes: u64,
    /// The name it first came with.
    pub name: String,
    /// The media type it first came with.
    pub media_type: String,
    /// When it first came, in milliseconds since 1970.
    pub added_at_ms: i64,
}

/// A file that a specification uses.
#[derive(Debug, Clone, PartialEq, Eq, FromRow)]
pub struct LinkedDemonstration {
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its size.
    #[sqlx(try_from = "i64")]
    pub bytes: u64,
    /// What the specification calls it.
    pub name: String,
    /// Its media type.
    pub media_type: String,
}

impl Store {
    /// Stores a file as it comes in. One whose content is there already is kept once, with the name it first had.
    ///
    /// # Errors
    ///
    /// [`StoreError::TooLarge`]; [`StoreError::Invalid`] when its name cannot be stored or it has another SHA-256 than
    /// expected; when the stream, the file or the database fails. Nothing is left of the file then.
    pub async fn put_demonstration<B, E>(
        &self,
        new: NewDemonstration,
        chunks: impl Stream<Item = Result<B, E>>,
    ) -> Result<DemonstrationRow, StoreError>
    where
        B: AsRef<[u8]>,
        E: Into<io::Error>,
    {
        refuse_nul(&[("the file's name", &new.name), ("the media type", &new.media_type)])?;
        let stored = self.files.put(new.limit_bytes, new.expected_sha256.as_deref(), chunks).await?;
        let mut writing = self.write().await?;
        sqlx::query(
            "INSERT INTO demonstrations (sha256, bytes, name, media_type, added_at_ms) \
             VALUES ($1, $2, $3, $4, $5) ON CONFLICT (sha256) DO NOTHING",
        )
        .bind(&stored.sha256)
        .bind(i64::try_from(stored.bytes).unwrap_or(i64::MAX))
        .bind(&new.name)
        .bind(&new.media_type)
        .bind(new.at_ms)
        .execute(writing.connection())
        .await?;
        writing.commit().await?;
        self.demonstration(&stored.sha256).await
    }

    /// Removes what is left of files that were coming in when the program was ended, and returns how many they were. Only
    /// for a server that takes none in yet, and has the data folder for itself.
    ///
    /// # Errors
    ///
    /// When the folder fails.
    pub async fn remove_abandoned_uploads(&self) -> Result<u64, StoreError> {
        self.files.remove_abandoned().await
    }

    /// What is known of a file.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; when the database fails.
    pub async fn demonstration(&self, sha256: &str) -> Result<DemonstrationRow, StoreError> {
        let query =
            "SELECT sha256, bytes, name, media_type, added_at_ms FROM demonstrations WHERE sha256 = $1";
        let row = sqlx::query_as(query).bind(sha256).fetch_optional(&self.pool).await?;
        row.ok_or_else(|| StoreError::not_found("demonstration", sha256))
    }

    /// A file, open at its beginning.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`]; [`StoreError::Corrupt`] when the file is gone or has another size; when the file or the
    /// database fails.
    pub async fn open_demonstration(&self, sha256: &str) -> Result<(DemonstrationRow, File), StoreError> {
        let row = self.demonstration(sha256).await?;
        let path = self.files.path(&row.sha256);
        let file = match File::open(&path).await {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(StoreError::Corrupt(format!("demonstration {sha256}: the file is gone")));
            }
            result => result.map_err(|error| StoreError::io(&path, error))?,
        };
        let found = file.metadata().await.map_err(|error| StoreError::io(&path, error))?.len();
        if found == row.bytes {
            return Ok((row, file));
        }
        let stored = row.bytes;
        Err(StoreError::Corrupt(format!("demonstration {sha256}: {found} bytes, stored were {stored}")))
    }

    /// Notes that a specification uses a file, under a name of its own; a later name replaces an earlier one.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`] when there is no such specification or file; [`StoreError::Invalid`] when the name cannot
    /// be stored; when the database fails.
    pub async fn link_demonstration(
        &self,
        specification: &str,
        sha256: &str,
        name: &str,
    ) -> Result<(), StoreError> {
        refuse_nul(&[("the file's name", name)])?;
        self.specification(specification).await?;
        self.demonstration(sha256).await?;
        let mut writing = self.write().await?;
        let sequence = writing.next_sequence().await?;
        sqlx::query(
            "INSERT INTO specification_demonstrations (specification, sha256, name, sequence) \
             VALUES ($1, $2, $3, $4) ON CONFLICT (specification, sha256) DO UPDATE SET name = excluded.name",
        )
        .bind(specification)
        .bind(sha256)
        .bind(name)
        .bind(sequence)
        .execute(writing.connection())
        .await?;
        writing.commit().await
    }

    /// The files that a specification uses, in the order in which they were linked.
    ///
    /// # Errors
    ///
    /// [`StoreError::NotFound`] when there is no such specification; when the database fails.
    pub async fn demonstrations_of(
        &self,
        specification: &str,
    ) -> Result<Vec<LinkedDemonstration>, StoreError> {
        self.specification(specification).await?;
        let rows = sqlx::query_as(
            "SELECT d.sha256, d.bytes, l.name, d.media_type \
             FROM specification_demonstrations l JOIN demonstrations d ON d.sha256 = l.sha256 \
             WHERE l.specification = $1 ORDER BY l.sequence",
        );
        Ok(rows.bind(specification).fetch_all(&self.pool).await?)
    }
}
