//! Who asks.

use std::convert::Infallible;

use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use goalgraph::protocol::api::Role;

/// Who asks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Caller {
    /// Id of the token; none where no token is needed.
    pub(crate) token: Option<String>,
    /// Name of the token.
    pub(crate) name: Option<String>,
    /// What may be done; none before a token was shown where one is needed.
    pub(crate) role: Option<Role>,
}

impl Caller {
    /// Anybody on this computer, where that is enough.
    pub(crate) fn local() -> Self {
        Self { token: None, name: None, role: Some(Role::Approver) }
    }

    /// Nobody who is known.
    pub(crate) fn unknown() -> Self {
        Self { token: None, name: None, role: None }
    }

    /// The name under what the caller saves and signs: the token's, which cannot be chosen, or else `given`.
    pub(crate) fn signs_as<'a>(&'a self, given: Option<&'a str>) -> Option<&'a str> {
        self.name.as_deref().or(given).filter(|name| !name.trim().is_empty())
    }
}

/// What the guard has found out; it runs before every handler.
impl<S: Send + Sync> FromRequestParts<S> for Caller {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        Ok(parts.extensions.get::<Self>().cloned().unwrap_or_else(Self::unknown))
    }
}
