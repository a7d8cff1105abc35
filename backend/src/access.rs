//! Access: who asks, and what they may do.
//!
//! On this computer alone no token is needed. Otherwise every request to the API carries one, as a bearer token or as
//! the cookie of a session that was opened with one. Which role an address needs stands in [`rules`], one table.
//! Modules in reading order: [`caller`], [`rules`], [`origin`] (which pages may ask), [`tokens`] (which are known),
//! [`rates`] (how often one may ask), [`guard`] (all of it before every request), [`revocations`].

mod caller;
mod guard;
mod origin;
mod rates;
mod revocations;
mod rules;
mod tokens;

pub(crate) use caller::Caller;
pub(crate) use guard::guard;
pub use guard::{Access, AccessSettings};
pub use revocations::end_revoked;
pub(crate) use tokens::{SESSION_COOKIE, SESSION_HOURS};
