//! Work that takes long enough to keep other connections waiting.

use tokio::task::spawn_blocking;

use super::problem::{ApiError, ApiResult};

/// Does `work` on a thread of its own.
pub(super) async fn aside<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> ApiResult<T> {
    spawn_blocking(work).await.map_err(|error| ApiError::broken(&error))
}
