//! The files of the app: where they come from, and how one is answered.

use std::borrow::Cow;

use axum::body::Body;
use axum::http::header::{ACCEPT_ENCODING, CACHE_CONTROL, CONTENT_ENCODING, CONTENT_TYPE, ETAG, VARY};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use rust_embed::RustEmbed;
use sha2::{Digest, Sha256};

use super::caching;

/// A file as it is sent.
pub struct Asset {
    bytes: Cow<'static, [u8]>,
    sha256: [u8; 32],
}

impl Asset {
    /// The file with this content.
    pub fn new(bytes: impl Into<Cow<'static, [u8]>>) -> Self {
        let bytes = bytes.into();
        let sha256 = Sha256::digest(&bytes).into();
        Self { bytes, sha256 }
    }
}

/// Finds a file by its path below `/`, without a slash before it.
pub type Assets = fn(&str) -> Option<Asset>;

/// The built app, with a compressed copy (`.br`) beside what gains from it.
#[derive(RustEmbed)]
#[folder = "../dist"]
#[allow_missing = true]
struct App;

/// The sample demonstrations.
#[derive(RustEmbed)]
#[folder = "../assets/samples"]
#[prefix = "samples/"]
#[allow_missing = true]
struct Samples;

/// The built app and the sample demonstrations as they were when this program was compiled. A debug build reads them
/// from disk instead.
pub fn embedded(path: &str) -> Option<Asset> {
    let file = App::get(path).or_else(|| Samples::get(path))?;
    Some(Asset { sha256: file.metadata.sha256_hash(), bytes: file.data })
}

/// The answer to a request for the file at `path`: compressed when there is a compressed copy and `request` accepts it,
/// empty when the browser has it already.
pub(super) fn answer(assets: Assets, path: &str, request: &HeaderMap) -> Option<Response> {
    let plain = assets(path)?;
    let mut headers = HeaderMap::new();
    headers.insert(CACHE_CONTROL, HeaderValue::from_static(caching::cache_control(path)));
    let compressed = assets(&format!("{path}.br"));
    if compressed.is_some() {
        headers.insert(VARY, HeaderValue::from_name(ACCEPT_ENCODING));
    }
    let accepted = compressed.filter(|_| caching::accepts_brotli(request));
    if accepted.is_some() {
        headers.insert(CONTENT_ENCODING, HeaderValue::from_static("br"));
    }
    let asset = accepted.unwrap_or(plain);
    let etag = caching::etag(&asset.sha256);
    if caching::is_known(&etag, request) {
        headers.remove(CONTENT_ENCODING);
        headers.insert(ETAG, etag);
        return Some((StatusCode::NOT_MODIFIED, headers).into_response());
    }
    headers.insert(ETAG, etag);
    headers.insert(CONTENT_TYPE, HeaderValue::from_static(media_type(path)));
    Some((headers, Body::from(asset.bytes)).into_response())
}

/// The media type that the ending of `path` stands for.
fn media_type(path: &str) -> &'static str {
    let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
    match ending {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "json" | "map" => "application/json",
        "webmanifest" => "application/manifest+json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        "csv" => "text/csv; charset=utf-8",
        "txt" | "tsv" | "md" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides_the_media_type() {
        assert_eq!(media_type("app-0123_bg.wasm"), "application/wasm");
        assert_eq!(media_type("worker_simd.js"), "text/javascript; charset=utf-8");
        assert_eq!(media_type("LICENSE"), "application/octet-stream");
    }

    #[test]
    fn nothing_outside_the_embedded_folders_is_found() {
        for path in
            ["../Cargo.toml", "samples/../../Cargo.toml", "..\\Cargo.toml", "/etc/hosts", "samples/", ""]
        {
            assert!(embedded(path).is_none(), "{path}");
        }
    }
}
