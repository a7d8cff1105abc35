//! Which part of a list is asked for.

use serde::Deserialize;
use utoipa::IntoParams;

use crate::store::{MAX_PAGE, PageRequest};

/// The query of every list.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(super) struct ListQuery {
    /// `next` of the part before; left out for the first.
    after: Option<String>,
    /// How many items at most.
    #[param(minimum = 1, maximum = 500)]
    limit: Option<u32>,
}

impl ListQuery {
    /// The same for the store.
    pub(super) fn request(&self) -> PageRequest {
        let usual = PageRequest::default();
        let limit = self.limit.unwrap_or(usual.limit).clamp(1, MAX_PAGE);
        PageRequest { after: self.after.clone(), limit }
    }
}
