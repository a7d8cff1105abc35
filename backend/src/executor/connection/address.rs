//! Where the server is, and what its refusals mean.

use std::fmt;
use std::io;
use std::path::Path;
use std::sync::Arc;

use goalgraph::protocol::executor::SUBPROTOCOL;
use rustls::ClientConfig;
use serde_json::Value;
use thiserror::Error;
use tokio_tungstenite::Connector;
use tokio_tungstenite::tungstenite::{self, ClientRequestBuilder, http::Uri};

use super::{Lost, trust};

/// Path of the WebSocket, where the URL has none.
const PATH: &str = "/api/v1/executor";

/// Why a robot is not, or no longer, taken by a server.
#[derive(Debug, Error)]
pub enum ConnectionError {
    /// The URL is none of a WebSocket.
    #[error("{url}: expected the URL of a WebSocket, such as ws://127.0.0.1:7700")]
    BadAddress {
        /// The URL.
        url: String,
    },
    /// The file of authorities is none.
    #[error("{file}: {why}; expected certificates in PEM")]
    Certificate {
        /// The file.
        file: String,
        /// What is wrong.
        why: String,
    },
    /// The server's certificate is not trusted.
    #[error(
        "{address}: the server's certificate is not trusted ({why}); name the file of its authority with --ca"
    )]
    Untrusted {
        /// Where.
        address: String,
        /// What is wrong with the certificate.
        why: String,
    },
    /// The server wants a token, or another one.
    #[error(
        "{address}: the server refuses the token ({status}); make one with `goalgraph token create` for the role executor"
    )]
    TokenRefused {
        /// Where.
        address: String,
        /// The HTTP status.
        status: u16,
    },
    /// There is no such place.
    #[error("{address}: {detail} ({status})")]
    Refused {
        /// Where.
        address: String,
        /// The HTTP status.
        status: u16,
        /// Why, if the server says so.
        detail: String,
    },
    /// What answers speaks another protocol.
    #[error("{address}: this is no server that speaks {SUBPROTOCOL} ({why})")]
    OtherProtocol {
        /// Where.
        address: String,
        /// What is wrong.
        why: String,
    },
    /// Another executor took over the name.
    #[error("another executor with the same name has connected; give each its own with --name")]
    Replaced,
    /// The token was revoked.
    #[error("the token was revoked")]
    Revoked,
}

/// Where the server is, and what it is told about who comes.
#[derive(Clone, Debug)]
pub struct Address {
    uri: Uri,
    token: Option<String>,
    trust: Option<Arc<ClientConfig>>,
}

impl Address {
    /// The WebSocket at `url`, for the approved revision of this specification, or of the one approved last.
    ///
    /// # Errors
    ///
    /// When it is no URL of a WebSocket.
    pub fn new(
        url: &str,
        token: Option<String>,
        specification: Option<&str>,
    ) -> Result<Self, ConnectionError> {
        let bad = || ConnectionError::BadAddress { url: url.to_owned() };
        let uri: Uri = url.parse().map_err(|_| bad())?;
        let scheme = uri.scheme_str().filter(|scheme| matches!(*scheme, "ws" | "wss")).ok_or_else(bad)?;
        let authority = uri.authority().ok_or_else(bad)?;
        let path = if uri.path() == "/" { PATH } else { uri.path() };
        let wanted = specification.map(|id| format!("specification={}", encoded(id)));
        let queries: Vec<String> = uri.query().map(str::to_owned).into_iter().chain(wanted).collect();
        let query = if queries.is_empty() { String::new() } else { format!("?{}", queries.join("&")) };
        let uri = format!("{scheme}://{authority}{path}{query}").parse().map_err(|_| bad())?;
        Ok(Self { uri, token, trust: None })
    }

    /// The same, where the server's certificate is of an authority in this PEM file instead of a public one.
    ///
    /// # Errors
    ///
    /// When it is no file of certificates.
    pub fn trusting(self, authorities: &Path) -> Result<Self, ConnectionError> {
        Ok(Self { trust: Some(trust::authorities(authorities)?), ..self })
    }

    pub(super) fn connector(&self) -> Option<Connector> {
        self.trust.clone().map(Connector::Rustls)
    }

    pub(super) fn request(&self) -> ClientRequestBuilder {
        let request = ClientRequestBuilder::new(self.uri.clone()).with_sub_protocol(SUBPROTOCOL);
        match &self.token {
            Some(token) => request.with_header("Authorization", format!("Bearer {token}")),
            None => request,
        }
    }

    /// What it means that no connection could be made.
    pub(super) fn explain(&self, error: tungstenite::Error) -> Lost {
        let address = self.to_string();
        match error {
            tungstenite::Error::Http(response) => {
                let status = response.status().as_u16();
                let body = response.body().as_deref().unwrap_or_default();
                self.refusal(status, detail(body))
            }
            tungstenite::Error::Protocol(error) => {
                Lost::ForGood(ConnectionError::OtherProtocol { address, why: error.to_string() })
            }
            tungstenite::Error::Url(error) => {
                Lost::ForGood(ConnectionError::OtherProtocol { address, why: error.to_string() })
            }
            tungstenite::Error::Io(error) => match certificate_fault(&error) {
                Some(why) => Lost::ForGood(ConnectionError::Untrusted { address, why }),
                None => Lost::ForNow(format!("cannot connect to {address}: {error}")),
            },
            error => Lost::ForNow(format!("cannot connect to {address}: {error}")),
        }
    }

    fn refusal(&self, status: u16, detail: Option<String>) -> Lost {
        let address = self.to_string();
        let detail = detail.unwrap_or_else(|| "the server does not take executors there".to_owned());
        match status {
            401 | 403 => Lost::ForGood(ConnectionError::TokenRefused { address, status }),
            429 | 500.. => Lost::ForNow(format!("{address}: {detail} ({status})")),
            _ => Lost::ForGood(ConnectionError::Refused { address, status, detail }),
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.uri.fmt(formatter)
    }
}

/// What is wrong with the server's certificate, if that is what failed.
fn certificate_fault(error: &io::Error) -> Option<String> {
    match error.get_ref()?.downcast_ref::<rustls::Error>()? {
        rustls::Error::InvalidCertificate(why) => Some(why.to_string()),
        _ => None,
    }
}

/// The sentence in a problem (RFC 9457).
fn detail(body: &[u8]) -> Option<String> {
    let problem: Value = serde_json::from_slice(body).ok()?;
    Some(problem.get("detail")?.as_str()?.to_owned())
}

/// `text` as a part of a query.
fn encoded(text: &str) -> String {
    let encode = |byte: u8| match byte {
        b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => char::from(byte).to_string(),
        _ => format!("%{byte:02X}"),
    };
    text.bytes().map(encode).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(url: &str, specification: Option<&str>, expected: &str) {
        let address = Address::new(url, None, specification).map(|address| address.to_string());
        assert_eq!(address.unwrap_or_else(|error| error.to_string()), expected);
    }

    #[test]
    fn the_path_and_the_wanted_specification_are_added() {
        check("ws://127.0.0.1:7700", None, "ws://127.0.0.1:7700/api/v1/executor");
        check(
            "wss://robots.example/",
            Some("a b"),
            "wss://robots.example/api/v1/executor?specification=a%20b",
        );
        check("ws://[::1]:80/behind/proxy?x=1", Some("s"), "ws://[::1]:80/behind/proxy?x=1&specification=s");
    }

    #[test]
    fn what_is_no_address_of_a_web_socket_is_said() {
        for url in ["http://127.0.0.1:7700", "127.0.0.1:7700", "ws:", "", "ws://a b"] {
            check(url, None, &format!("{url}: expected the URL of a WebSocket, such as ws://127.0.0.1:7700"));
        }
    }
}
