//! How the API says no: problem details as in RFC 9457.

use axum::Json;
use axum::http::header::{CONTENT_TYPE, RETRY_AFTER, WWW_AUTHENTICATE};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use goalgraph::protocol::api::{Problem, Role};

use super::entries;
use crate::relay::RelayError;
use crate::store::{Conflict, StoreError};

/// What every handler returns.
pub(crate) type ApiResult<T> = Result<T, ApiError>;

/// Why a request was not done.
#[derive(Debug)]
pub(crate) struct ApiError(Box<Problem>);

/// The kinds of problems: the address that names it, its title, its status.
#[derive(Clone, Copy)]
struct Kind(&'static str, &'static str, StatusCode);

const BAD_REQUEST: Kind = Kind("bad-request", "The request cannot be read", StatusCode::BAD_REQUEST);
const TOKEN_NEEDED: Kind = Kind("token-needed", "A token is needed", StatusCode::UNAUTHORIZED);
const NOT_ALLOWED: Kind = Kind("not-allowed", "Not allowed", StatusCode::FORBIDDEN);
const NOT_FOUND: Kind = Kind("not-found", "Not found", StatusCode::NOT_FOUND);
const WRONG_METHOD: Kind = Kind("wrong-method", "Not this method", StatusCode::METHOD_NOT_ALLOWED);
const CONFLICT: Kind = Kind("conflict", "It is not so (any more)", StatusCode::CONFLICT);
const CHANGED: Kind = Kind("changed-meanwhile", "Somebody saved meanwhile", StatusCode::PRECONDITION_FAILED);
const TOO_LARGE: Kind = Kind("too-large", "Too large", StatusCode::PAYLOAD_TOO_LARGE);
const MEDIA_TYPE: Kind = Kind("media-type", "Not this media type", StatusCode::UNSUPPORTED_MEDIA_TYPE);
const MISDIRECTED: Kind = Kind("wrong-host", "Not this host", StatusCode::MISDIRECTED_REQUEST);
const INVALID: Kind = Kind("invalid", "The content is not valid", StatusCode::UNPROCESSABLE_ENTITY);
const FAULTY: Kind = Kind("faulty", "The specification has errors", StatusCode::UNPROCESSABLE_ENTITY);
const CONDITION: Kind = Kind("if-match-needed", "If-Match is needed", StatusCode::PRECONDITION_REQUIRED);
const TOO_MANY: Kind = Kind("too-many", "Too many requests", StatusCode::TOO_MANY_REQUESTS);
const BROKEN: Kind = Kind("server-error", "The server failed", StatusCode::INTERNAL_SERVER_ERROR);
const BUSY: Kind = Kind("busy", "Busy", StatusCode::SERVICE_UNAVAILABLE);
const FULL: Kind = Kind("full", "No space is left", StatusCode::INSUFFICIENT_STORAGE);

impl ApiError {
    fn new(Kind(kind, title, status): Kind, detail: impl Into<String>) -> Self {
        Self(Box::new(Problem {
            kind: format!("/problems/{kind}"),
            title: title.to_owned(),
            status: status.as_u16(),
            detail: detail.into(),
            head: None,
            approved: None,
            findings: Vec::new(),
        }))
    }

    /// The request cannot be read.
    pub(crate) fn bad_request(detail: impl Into<String>) -> Self {
        Self::new(BAD_REQUEST, detail)
    }

    /// Nobody is known to ask.
    pub(crate) fn token_needed(detail: impl Into<String>) -> Self {
        Self::new(TOKEN_NEEDED, detail)
    }

    /// Who asks may not.
    pub(crate) fn not_allowed(detail: impl Into<String>) -> Self {
        Self::new(NOT_ALLOWED, detail)
    }

    /// Who asks has not the role for it.
    pub(crate) fn role_needed(has: Role, needed: Role) -> Self {
        Self::not_allowed(format!(
            "this needs a token of the role {needed}; the one given has the role {has}"
        ))
    }

    /// There is no such thing.
    pub(crate) fn not_found(detail: impl Into<String>) -> Self {
        Self::new(NOT_FOUND, detail)
    }

    /// The address does not know the method.
    pub(crate) fn wrong_method() -> Self {
        Self::new(
            WRONG_METHOD,
            "this address does not answer to this method; GET /api/openapi.json tells which do",
        )
    }

    /// The request does not fit how things are.
    pub(crate) fn conflict(detail: impl Into<String>) -> Self {
        Self::new(CONFLICT, detail)
    }

    /// The body is larger than `limit` bytes.
    pub(crate) fn too_large(limit: u64) -> Self {
        Self::new(TOO_LARGE, format!("the body is larger than {limit} bytes"))
    }

    /// The body is of another media type than expected.
    pub(crate) fn media_type(detail: impl Into<String>) -> Self {
        Self::new(MEDIA_TYPE, detail)
    }

    /// The request was meant for another host.
    pub(crate) fn misdirected(detail: impl Into<String>) -> Self {
        Self::new(MISDIRECTED, detail)
    }

    /// The body can be read, but not be used.
    pub(crate) fn invalid(detail: impl Into<String>) -> Self {
        Self::new(INVALID, detail)
    }

    /// The specification has errors that keep it from being approved.
    pub(crate) fn faulty(findings: Vec<String>) -> Self {
        let mut error = Self::new(FAULTY, format!("a robot must not be given this: {}", findings.join("; ")));
        error.0.findings = findings;
        error
    }

    /// The request must say which revision it knows.
    pub(crate) fn condition_needed() -> Self {
        Self::new(
            CONDITION,
            "send the ETag of the revision that you know in If-Match, so that nothing newer is lost",
        )
    }

    /// Somebody saved meanwhile.
    pub(crate) fn changed(head: goalgraph::protocol::api::Revision) -> Self {
        let detail = format!("{} saved revision {} at {}", head.author, head.number, head.saved_at);
        let mut error = Self::new(CHANGED, detail);
        error.0.head = Some(head);
        error
    }

    /// Too many requests.
    pub(crate) fn too_many(detail: impl Into<String>) -> Self {
        Self::new(TOO_MANY, detail)
    }

    /// The server cannot do it at the moment.
    pub(crate) fn busy(detail: impl Into<String>) -> Self {
        Self::new(BUSY, detail)
    }

    /// The server is at fault; `reason` goes to the log, not to the client.
    pub(crate) fn broken(reason: &dyn std::fmt::Display) -> Self {
        tracing::error!(%reason, "a request failed");
        Self::new(BROKEN, "the server could not do it; its log says why")
    }

    fn of_conflict(conflict: &Conflict) -> Self {
        match conflict {
            Conflict::Saved(head) => Self::changed(entries::revision(head)),
            Conflict::Approved(last) => {
                let mut error = Self::conflict(conflict.to_string());
                let approved = last.as_ref().and_then(crate::store::ApprovalRow::approves);
                error.0.approved = approved;
                error
            }
            Conflict::OtherContent(_) | Conflict::StillApproved(_) | Conflict::Run(_) => {
                Self::conflict(conflict.to_string())
            }
        }
    }
}

impl From<StoreError> for ApiError {
    fn from(error: StoreError) -> Self {
        let detail = error.to_string();
        match error {
            StoreError::NotFound { .. } => Self::not_found(detail),
            StoreError::Conflict(conflict) => Self::of_conflict(&conflict),
            StoreError::Full => Self::new(FULL, detail),
            StoreError::Busy => Self::busy(detail),
            StoreError::TooLarge { limit_bytes } => Self::too_large(limit_bytes),
            StoreError::Invalid(_) => Self::invalid(detail),
            _ if error.is_away() => {
                Self::busy("the database cannot be reached, so nothing was stored; try again")
            }
            _ => Self::broken(&detail),
        }
    }
}

impl From<RelayError> for ApiError {
    fn from(error: RelayError) -> Self {
        match error {
            RelayError::Store(error) => error.into(),
            RelayError::Closing => Self::busy(error.to_string()),
            _ => Self::broken(&error),
        }
    }
}

impl IntoResponse for ApiError {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.0.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut headers = HeaderMap::new();
        headers.insert(CONTENT_TYPE, HeaderValue::from_static("application/problem+json"));
        match status {
            StatusCode::TOO_MANY_REQUESTS | StatusCode::SERVICE_UNAVAILABLE => {
                headers.insert(RETRY_AFTER, HeaderValue::from_static("1"));
            }
            StatusCode::UNAUTHORIZED => {
                headers.insert(WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"));
            }
            _ => {}
        }
        (status, headers, Json(self.0)).into_response()
    }
}
