//! Which pages may ask.

use axum::http::header::{HOST, ORIGIN};
use axum::http::{HeaderMap, Uri};

/// The host that the request is for, port included.
pub(super) fn host<'a>(uri: &'a Uri, headers: &'a HeaderMap) -> Option<&'a str> {
    // HTTP/2 has it in the address.
    let named = uri.authority().map(axum::http::uri::Authority::as_str);
    named.or_else(|| headers.get(HOST).and_then(|value| value.to_str().ok()))
}

/// Whether the request comes from a page of this server, of one of `others` (such as `https://lab.example`), or from no
/// page at all: programs send no origin.
pub(super) fn is_own(host: Option<&str>, headers: &HeaderMap, others: &[String]) -> bool {
    if headers.get("sec-fetch-site").is_some_and(|site| site == "cross-site") && !headers.contains_key(ORIGIN)
    {
        return false;
    }
    let Some(origin) = headers.get(ORIGIN) else {
        return true;
    };
    let Ok(origin) = origin.to_str() else {
        return false;
    };
    let of_page = origin.split_once("://").map(|(_, authority)| authority);
    let same = of_page.is_some_and(|page| host.is_some_and(|host| page.eq_ignore_ascii_case(host)));
    same || others.iter().any(|other| other.eq_ignore_ascii_case(origin))
}

/// Whether the host is a name of this computer alone. A page elsewhere whose name was made to point here (DNS
/// rebinding) asks for another host.
pub(super) fn is_loopback(host: Option<&str>) -> bool {
    let Some(host) = host else {
        return false;
    };
    let name = match host.strip_prefix('[') {
        Some(rest) => rest.split(']').next().unwrap_or_default(),
        None => host.rsplit_once(':').map_or(host, |(name, _)| name),
    };
    let is_address = name.parse::<std::net::IpAddr>().is_ok_and(|address| address.is_loopback());
    is_address || name.eq_ignore_ascii_case("localhost") || name.to_ascii_lowercase().ends_with(".localhost")
}

#[cfg(test)]
mod tests {
    use axum::http::HeaderValue;

    use super::*;

    #[test]
    fn only_names_of_this_computer_are_loopback() {
        for host in
            ["localhost", "LOCALHOST:7700", "127.0.0.1:7700", "127.1.2.3", "[::1]:7700", "app.localhost:1"]
        {
            assert!(is_loopback(Some(host)), "{host}");
        }
        for host in [
            "",
            "example.org",
            "localhost.example.org:7700",
            "10.0.0.1",
            "[::2]:7700",
            "127.0.0.1.example.org",
        ] {
            assert!(!is_loopback(Some(host)), "{host}");
        }
        assert!(!is_loopback(None));
    }

    #[test]
    fn pages_of_other_servers_may_not_ask() {
        let own = |origin: &'static str, host: &str| {
            let headers = HeaderMap::from_iter([(ORIGIN, HeaderValue::from_static(origin))]);
            is_own(Some(host), &headers, &["https://lab.example".to_owned()])
        };
        assert!(own("http://127.0.0.1:7700", "127.0.0.1:7700"));
        assert!(own("https://lab.example", "10.0.0.1:7700"));
        assert!(!own("http://127.0.0.1:7701", "127.0.0.1:7700"));
        assert!(!own("https://evil.example", "127.0.0.1:7700"));
        assert!(!own("null", "127.0.0.1:7700"));
        assert!(is_own(Some("127.0.0.1:7700"), &HeaderMap::new(), &[]));
    }
}
