//! Logging in with a token, and out.

use std::net::SocketAddr;
use std::sync::Arc;

use axum::Json;
use axum::extract::{ConnectInfo, DefaultBodyLimit, State};
use axum::http::StatusCode;
use axum_extra::extract::CookieJar;
use axum_extra::extract::cookie::{Cookie, SameSite};
use goalgraph::protocol::api::{Login, Role, Session};

use super::Api;
use super::extract::Body;
use super::problem::{ApiError, ApiResult};
use crate::access::{Access, Caller, SESSION_COOKIE, SESSION_HOURS};
use crate::clock;
use crate::digest::sha256_hex;
use crate::token::random_secret;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The addresses of this module.
pub(super) fn routes() -> OpenApiRouter<Api> {
    // Whoever has no token yet may send no more than one.
    let longest = DefaultBodyLimit::max(TOKEN_BYTES);
    OpenApiRouter::new().routes(routes!(read_session, open_session, close_session)).layer(longest)
}

/// Longest body of a login, in bytes.
const TOKEN_BYTES: usize = 4 << 10;
const HOUR_MS: i64 = 3_600_000;

/// Who asks, and what they may do.
#[utoipa::path(get, path = "/session", tag = "access", responses((status = 200, body = Session)))]
async fn read_session(State(api): State<Api>, caller: Caller) -> ApiResult<Json<Session>> {
    let role = caller.role.ok_or_else(|| ApiError::token_needed("log in with a token"))?;
    Ok(Json(Session { name: caller.name, role, tokens_needed: api.access.settings.tokens_needed }))
}

/// Opens a session with a token: the answer sets a cookie that lasts twelve hours and that scripts cannot read.
#[utoipa::path(post, path = "/session", tag = "access", request_body = Login, responses((status = 204)))]
async fn open_session(
    State(api): State<Api>,
    ConnectInfo(peer): ConnectInfo<SocketAddr>,
    cookies: CookieJar,
    Body(login): Body<Login>,
) -> ApiResult<(StatusCode, CookieJar)> {
    let caller = api.access.prove(login.token.trim(), peer.ip()).await?;
    let (Some(token), Some(role)) = (caller.token, caller.role) else {
        return Err(ApiError::token_needed("this token is not known here, or was revoked"));
    };
    if role == Role::Executor {
        return Err(ApiError::not_allowed(
            "a token of the role executor connects executors; it opens no session",
        ));
    }
    let secret = random_secret().map_err(|error| ApiError::broken(&error))?;
    let now = clock::now_ms();
    api.store.delete_expired_sessions(now).await?;
    let expires_at_ms = now + SESSION_HOURS * HOUR_MS;
    api.store.create_session(&sha256_hex(secret.as_bytes()), &token, expires_at_ms).await?;
    Ok((StatusCode::NO_CONTENT, cookies.add(cookie(&api.access, secret))))
}

/// Ends the session.
#[utoipa::path(delete, path = "/session", tag = "access", responses((status = 204)))]
async fn close_session(State(api): State<Api>, cookies: CookieJar) -> ApiResult<(StatusCode, CookieJar)> {
    if let Some(cookie) = cookies.get(SESSION_COOKIE) {
        api.store.delete_session(&sha256_hex(cookie.value().as_bytes())).await?;
    }
    let gone = cookie(&api.access, String::new());
    Ok((StatusCode::NO_CONTENT, cookies.remove(gone)))
}

fn cookie(access: &Arc<Access>, secret: String) -> Cookie<'static> {
    Cookie::build((SESSION_COOKIE, secret))
        .path("/")
        .http_only(true)
        .same_site(SameSite::Strict)
        .secure(access.settings.https)
        .build()
}
