//! What browsers may keep, and how they ask whether it is still good.

use axum::http::header::{ACCEPT_ENCODING, HeaderName, IF_NONE_MATCH};
use axum::http::{HeaderMap, HeaderValue};

/// How long the file at `path` may be kept: for ever when its name changes with its content, else it must be asked for
/// again (and is answered with 304 while it is the same).
pub(super) fn cache_control(path: &str) -> &'static str {
    if has_hashed_name(path) { "public, max-age=31536000, immutable" } else { "no-cache" }
}

/// Whether the name is one that the build made from the content, such as `app-9c0f3a1be2d45768_bg.wasm`.
fn has_hashed_name(path: &str) -> bool {
    if path.contains('/') {
        return false;
    }
    let stem = path.split_once('.').map_or(path, |(stem, _)| stem);
    let stem = stem.strip_suffix("_bg").unwrap_or(stem);
    let Some((_, hash)) = stem.rsplit_once('-') else {
        return false;
    };
    // Sixteen digits, without leading zeros.
    (12..=16).contains(&hash.len()) && hash.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'))
}

/// The entity tag of content with this SHA-256.
pub(super) fn etag(sha256: &[u8; 32]) -> HeaderValue {
    use std::fmt::Write;
    let mut tag = String::from("\"");
    for byte in &sha256[..16] {
        // Writing to a string does not fail.
        let _ = write!(tag, "{byte:02x}");
    }
    tag.push('"');
    HeaderValue::try_from(tag).unwrap_or(HeaderValue::from_static("\"\""))
}

/// Whether the browser says that it has what `etag` stands for.
pub(super) fn is_known(etag: &HeaderValue, request: &HeaderMap) -> bool {
    let known = |tag: &str| tag == "*" || tag.strip_prefix("W/").unwrap_or(tag).as_bytes() == etag.as_bytes();
    items(request, &IF_NONE_MATCH).any(known)
}

/// Whether the browser names brotli and does not rule it out.
pub(super) fn accepts_brotli(request: &HeaderMap) -> bool {
    let accepts = |item: &str| {
        let (coding, quality) = item.split_once(';').unwrap_or((item, ""));
        let quality = quality.trim().strip_prefix("q=").map_or(Ok(1.0), str::parse::<f64>);
        coding.trim() == "br" && quality.is_ok_and(|quality| quality > 0.0)
    };
    items(request, &ACCEPT_ENCODING).any(accepts)
}

/// The comma-separated items of all lines of a header.
fn items<'a>(request: &'a HeaderMap, name: &HeaderName) -> impl Iterator<Item = &'a str> + use<'a> {
    let lines = request.get_all(name).iter().filter_map(|line| line.to_str().ok());
    lines.flat_map(|line| line.split(',')).map(str::trim)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_with_a_hash_are_kept_for_ever() {
        let check = |path: &str, expected: bool| assert_eq!(has_hashed_name(path), expected, "{path}");
        check("goalgraph-web-9c0f3a1be2d45768.js", true);
        check("goalgraph-web-9c0f3a1be2d45768_bg.wasm", true);
        check("style-c0f3a1be2d45768.css", true);
        check("index.html", false);
        check("worker.js", false);
        check("worker_bg.wasm", false);
        check("worker_simd.js", false);
        check("goalgraph-web.js", false);
        check("samples/two-stacks/demo-9c0f3a1be2d45768.csv", false);
    }

    #[test]
    fn brotli_is_sent_only_to_who_asks_for_it() {
        let accepts = |value: &'static str| {
            accepts_brotli(&HeaderMap::from_iter([(ACCEPT_ENCODING, HeaderValue::from_static(value))]))
        };
        assert!(accepts("gzip, deflate, br, zstd"));
        assert!(accepts("br;q=0.5"));
        assert!(!accepts("gzip"));
        assert!(!accepts("br;q=0, gzip"));
        assert!(!accepts("brotli"));
        assert!(!accepts_brotli(&HeaderMap::new()));
    }

    #[test]
    fn a_tag_is_known_in_a_list_and_when_weak() {
        let etag = etag(&[7; 32]);
        let known = |value: String| {
            is_known(&etag, &HeaderMap::from_iter([(IF_NONE_MATCH, HeaderValue::try_from(value).unwrap())]))
        };
        let tag = etag.to_str().unwrap();
        assert!(known(tag.to_owned()));
        assert!(known(format!("\"other\", W/{tag}")));
        assert!(!known("\"other\"".to_owned()));
    }
}
