//! What every request passes before it is answered.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::sync::Arc;

use axum::extract::{ConnectInfo, Request, State};
use axum::http::header::{AUTHORIZATION, UPGRADE};
use axum::http::{HeaderMap, Method};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use axum_extra::extract::CookieJar;
use goalgraph::protocol::api::Role;

use super::caller::Caller;
use super::rates::Rates;
use super::tokens::{SESSION_COOKIE, Tokens};
use super::{origin, rules};
use crate::api::{ApiError, ApiResult};
use crate::store::Store;

/// Who is let in.
#[derive(Clone, Debug, Default)]
pub struct AccessSettings {
    /// Whether everybody needs a token; otherwise whoever reaches the server from this computer may do everything.
    pub tokens_needed: bool,
    /// Pages of other servers that may ask, such as `https://lab.example`.
    pub origins: Vec<String>,
    /// Whether browsers reach the server by https only, so that cookies never travel in the clear.
    pub https: bool,
}

/// Lets requests in, or not.
pub struct Access {
    pub(crate) settings: AccessSettings,
    tokens: Tokens,
    rates: Rates,
}

impl Access {
    /// Lets in who has a token of `store`.
    pub fn new(settings: AccessSettings, store: Store) -> Self {
        Self { settings, tokens: Tokens::of(store), rates: Rates::new() }
    }

    /// Whom a token stands for; counts wrong ones.
    pub(crate) async fn prove(&self, token: &str, address: IpAddr) -> ApiResult<Caller> {
        if self.rates.must_wait(address) {
            return Err(ApiError::too_many("too many wrong tokens from this address; wait a little"));
        }
        let caller = self.tokens.of_token(token).await?;
        caller.ok_or_else(|| {
            self.rates.count_wrong_token(address);
            ApiError::token_needed("this token is not known here, or was revoked")
        })
    }

    async fn check(&self, request: &mut Request) -> ApiResult<()> {
        let host = origin::host(request.uri(), request.headers()).map(ToOwned::to_owned);
        if !self.settings.tokens_needed && !origin::is_loopback(host.as_deref()) {
            return Err(ApiError::misdirected(
                "without tokens this server answers only to localhost; ask for http://localhost or 127.0.0.1",
            ));
        }
        let path = request.uri().path().to_owned();
        if !path.starts_with("/api/") && path != "/metrics" {
            return Ok(());
        }
        let address = peer(request);
        if !self.rates.take_request(address) {
            return Err(ApiError::too_many(
                "more requests from this address than the server answers; wait a second",
            ));
        }
        if changes_or_stays(request)
            && !origin::is_own(host.as_deref(), request.headers(), &self.settings.origins)
        {
            return Err(ApiError::not_allowed("this page is not of this server, so it may not ask for this"));
        }
        // A request cannot be held on to while waiting: its body is not to be shared.
        let headers = request.headers().clone();
        let caller = self.caller(&headers, address).await?;
        if let Some(needed) = rules::needed(request.method(), &path) {
            self.allow(&caller, needed)?;
        }
        request.extensions_mut().insert(caller);
        Ok(())
    }

    async fn caller(&self, headers: &HeaderMap, address: IpAddr) -> ApiResult<Caller> {
        let header = headers.get(AUTHORIZATION).and_then(|value| value.to_str().ok());
        if let Some(token) = header.and_then(|value| value.strip_prefix("Bearer ")) {
            return self.prove(token.trim(), address).await;
        }
        let cookies = CookieJar::from_headers(headers);
        if let Some(cookie) = cookies.get(SESSION_COOKIE)
            && let Some(caller) = self.tokens.of_session(cookie.value()).await?
        {
            return Ok(caller);
        }
        Ok(if self.settings.tokens_needed { Caller::unknown() } else { Caller::local() })
    }

    fn allow(&self, caller: &Caller, needed: Role) -> ApiResult<()> {
        match caller.role {
            _ if caller.token.is_none() && !self.settings.tokens_needed => Ok(()),
            None => Err(ApiError::token_needed(
                "send a token as `Authorization: Bearer ..`, or log in with one; `goalgraph token create` makes one",
            )),
            Some(has) if has.allows(needed) => Ok(()),
            Some(has) => Err(ApiError::role_needed(has, needed)),
        }
    }
}

/// Lets a request through to its handler, or answers why not.
pub(crate) async fn guard(State(access): State<Arc<Access>>, mut request: Request, next: Next) -> Response {
    match access.check(&mut request).await {
        Ok(()) => next.run(request).await,
        Err(error) => error.into_response(),
    }
}

/// Who is at the other end of the connection.
pub(crate) fn peer(request: &Request) -> IpAddr {
    let address = request.extensions().get::<ConnectInfo<SocketAddr>>();
    address.map_or(IpAddr::V4(Ipv4Addr::UNSPECIFIED), |ConnectInfo(address)| address.ip())
}

/// Whether the request changes something, or opens a socket that stays.
fn changes_or_stays(request: &Request) -> bool {
    !matches!(*request.method(), Method::GET | Method::HEAD | Method::OPTIONS)
        || request.headers().contains_key(UPGRADE)
}
