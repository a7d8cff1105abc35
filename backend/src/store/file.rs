//! The data folder, and in it files that are named by the SHA-256 of their content.

use std::fs::{self, DirBuilder, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use futures_util::{Stream, StreamExt};
use sha2::{Digest, Sha256};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use uuid::Uuid;

use super::StoreError;
use crate::digest::hex;

/// How much of a file is read at a time.
const CHUNK_BYTES: usize = 1 << 16;

/// A data folder.
#[derive(Debug, Clone)]
pub(super) struct Files {
    folder: PathBuf,
}

/// A file that was stored, or was there already.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct StoredFile {
    pub(super) sha256: String,
    pub(super) bytes: u64,
}

impl Files {
    /// The data folder at `path`; when it is not there and is to be made, only its owner can read it.
    pub(super) async fn open(path: &Path, create: bool) -> Result<Self, StoreError> {
        if create {
            make_folder(path).map_err(|error| StoreError::io(path, error))?;
        } else if !path.is_dir() {
            return Err(StoreError::NoDatabase(path.to_path_buf()));
        }
        let folder = tokio::fs::canonicalize(path).await.map_err(|error| StoreError::io(path, error))?;
        Ok(Self { folder })
    }

    /// The SQLite database.
    pub(super) fn database(&self) -> PathBuf {
        self.folder.join("goalgraph.sqlite")
    }

    /// Waits until no other program migrates a database of this folder; dropping the file lets the next one do it.
    pub(super) fn migration_lock(&self) -> impl FnOnce() -> Result<File, StoreError> + Send + use<> {
        let path = self.folder.join("goalgraph.lock");
        move || {
            let open = OpenOptions::new().create(true).append(true).open(&path);
            let locked = open.and_then(|file| file.lock().map(|()| file));
            locked.map_err(|error| StoreError::io(&path, error))
        }
    }

    /// Where the file of a SHA-256 lies.
    pub(super) fn path(&self, sha256: &str) -> PathBuf {
        let (first, _) = sha256.split_at_checked(2).unwrap_or_default();
        self.folder.join("demonstrations").join(first).join(sha256)
    }

    /// Where files are until all of them is there.
    fn incoming(&self) -> PathBuf {
        self.folder.join("demonstrations").join("incoming")
    }

    /// Removes what is left of files that never came to their end, and returns how many they were.
    pub(super) async fn remove_abandoned(&self) -> Result<u64, StoreError> {
        let incoming = self.incoming();
        let failed = |error: io::Error| StoreError::io(&incoming, error);
        let mut entries = match tokio::fs::read_dir(&incoming).await {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(0),
            result => result.map_err(failed)?,
        };
        let mut removed = 0;
        while let Some(entry) = entries.next_entry().await.map_err(failed)? {
            tokio::fs::remove_file(entry.path()).await.map_err(failed)?;
            removed += 1;
        }
        Ok(removed)
    }

    /// Stores the bytes of a stream, at most `limit_bytes`; durable when it returns.
    pub(super) async fn put<B, E>(
        &self,
        limit_bytes: u64,
        expected_sha256: Option<&str>,
        chunks: impl Stream<Item = Result<B, E>>,
    ) -> Result<StoredFile, StoreError>
    where
        B: AsRef<[u8]>,
        E: Into<io::Error>,
    {
        let incoming = self.incoming();
        tokio::fs::create_dir_all(&incoming).await.map_err(|error| StoreError::io(&incoming, error))?;
        let temporary = Temporary(incoming.join(Uuid::new_v4().simple().to_string()));
        let stored = write(&temporary.0, limit_bytes, chunks).await?;
        if let Some(expected) = expected_sha256.filter(|&expected| expected != stored.sha256) {
            let found = &stored.sha256;
            return Err(StoreError::Invalid(format!(
                "the file has the SHA-256 {found}, expected {expected}"
            )));
        }
        self.keep(&temporary.0, &stored.sha256).await?;
        Ok(stored)
    }

    /// Gives a whole file its name.
    async fn keep(&self, temporary: &Path, sha256: &str) -> Result<(), StoreError> {
        let path = self.path(sha256);
        let folder = path.parent().unwrap_or(&self.folder).to_path_buf();
        let (from, to) = (temporary.to_path_buf(), path.clone());
        let rename = move || {
            fs::create_dir_all(&folder)?;
            // Also over a file that is there: these bytes are right, and those may be damaged.
            fs::rename(&from, &to)?;
            // The names themselves are on the disk only then, that of a new folder included.
            sync_folder(&folder)?;
            folder.parent().map_or(Ok(()), sync_folder)
        };
        let renamed = tokio::task::spawn_blocking(rename).await.unwrap_or_else(|error| Err(error.into()));
        renamed.map_err(|error| StoreError::io(&path, error))
    }

    /// Copies a file into another data folder; durable when it returns.
    pub(super) async fn copy_to(&self, other: &Self, sha256: &str) -> Result<(), StoreError> {
        let (from, to) = (self.path(sha256), other.path(sha256));
        let path = from.clone();
        let copy = move || {
            let folder = to.parent().unwrap_or(&to);
            fs::create_dir_all(folder)?;
            fs::copy(&from, &to)?;
            File::open(&to)?.sync_all()?;
            sync_folder(folder)
        };
        match tokio::task::spawn_blocking(copy).await.unwrap_or_else(|error| Err(error.into())) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Err(StoreError::Corrupt(format!("demonstration {sha256}: the file is gone")))
            }
            result => result.map_err(|error| StoreError::io(&path, error)),
        }
    }

    /// The SHA-256 and size of the file that is stored under `sha256`.
    pub(super) async fn digest(&self, sha256: &str) -> io::Result<StoredFile> {
        let mut file = tokio::fs::File::open(self.path(sha256)).await?;
        let mut hasher = Sha256::new();
        let mut chunk = vec![0; CHUNK_BYTES];
        let mut bytes = 0;
        loop {
            let read = file.read(&mut chunk).await?;
            if read == 0 {
                return Ok(StoredFile { sha256: hex(&hasher.finalize()), bytes });
            }
            hasher.update(&chunk[..read]);
            bytes += read as u64;
        }
    }
}

/// A file that is removed again unless it was renamed.
struct Temporary(PathBuf);

impl Drop for Temporary {
    fn drop(&mut self) {
        // When it is not there any more it has its name.
        let _ = fs::remove_file(&self.0);
    }
}

async fn write<B, E>(
    path: &Path,
    limit_bytes: u64,
    chunks: impl Stream<Item = Result<B, E>>,
) -> Result<StoredFile, StoreError>
where
    B: AsRef<[u8]>,
    E: Into<io::Error>,
{
    let failed = |error: io::Error| StoreError::io(path, error);
    let mut file = tokio::fs::File::create_new(path).await.map_err(failed)?;
    let mut hasher = Sha256::new();
    let mut bytes = 0;
    let mut chunks = std::pin::pin!(chunks);
    while let Some(chunk) = chunks.next().await {
        let chunk = chunk.map_err(|error| failed(error.into()))?;
        let chunk = chunk.as_ref();
        bytes += chunk.len() as u64;
        if bytes > limit_bytes {
            return Err(StoreError::TooLarge { limit_bytes });
        }
        hasher.update(chunk);
        file.write_all(chunk).await.map_err(failed)?;
    }
    file.flush().await.map_err(failed)?;
    file.sync_all().await.map_err(failed)?;
    Ok(StoredFile { sha256: hex(&hasher.finalize()), bytes })
}

fn make_folder(path: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(path)
}

#[cfg(unix)]
pub(super) fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

/// A folder cannot be opened as a file here; its names are written with the file system's own care.
#[cfg(not(unix))]
pub(super) fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}
