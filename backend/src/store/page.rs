//! Long lists, one page after the other.

use super::StoreError;

/// The most rows of one page, whatever is asked for.
pub const MAX_PAGE: u32 = 500;

/// Which part of a list is wanted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PageRequest {
    /// [`Page::next`] of the page before; none for the first page.
    pub after: Option<String>,
    /// The most rows wanted, from 1 to [`MAX_PAGE`]; what is beyond is taken as the nearest of the two.
    pub limit: u32,
}

impl Default for PageRequest {
    fn default() -> Self {
        Self { after: None, limit: 50 }
    }
}

/// A part of a list. Rows that are added while one reads page after page make none appear twice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Page<T> {
    /// The rows.
    pub rows: Vec<T>,
    /// Where the next page begins; none when this is the last.
    pub next: Option<String>,
}

impl PageRequest {
    /// The number that the page before ended with.
    ///
    /// # Errors
    ///
    /// When `after` was not given by the store.
    pub(super) fn position(&self) -> Result<Option<i64>, StoreError> {
        let parse = |after: &String| {
            after.parse().map_err(|_| StoreError::Invalid(format!("{after:?} is not where a page begins")))
        };
        self.after.as_ref().map(parse).transpose()
    }

    /// As [`PageRequest::position`], for lists that begin with the largest number.
    pub(super) fn position_from_newest(&self) -> Result<i64, StoreError> {
        Ok(self.position()?.unwrap_or(i64::MAX))
    }

    /// How many rows to read: one more than the page has, to know whether it is the last.
    pub(super) fn rows_to_read(&self) -> i64 {
        i64::from(self.rows()) + 1
    }

    fn rows(&self) -> u32 {
        self.limit.clamp(1, MAX_PAGE)
    }

    /// The page made of the rows that were read; `position` is what they are ordered by.
    pub(super) fn page<T>(&self, mut rows: Vec<T>, position: impl Fn(&T) -> u64) -> Page<T> {
        let limit = self.rows() as usize;
        let is_last = rows.len() <= limit;
        rows.truncate(limit);
        let next = if is_last { None } else { rows.last().map(|row| position(row).to_string()) };
        Page { rows, next }
    }
}
