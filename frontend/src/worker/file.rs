//! The bytes of a file and their digest, as the browser gives them.

use js_sys::{ArrayBuffer, Promise, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::File;

use super::reading::{Content, read};
use super::scope;

/// Files of so many bytes together are held at once.
pub(super) const SMALL: f64 = 4e6;

/// For fewer bytes the way to the browser's digest and back takes longer than the engine's own.
const WORTH_A_CALL: u32 = 200_000;

/// A file that the browser has read.
pub(super) struct Loaded {
    bytes: Uint8Array,
    sha256: Option<String>,
}

/// Has the browser read a file, and digest it where it does that.
///
/// # Errors
///
/// When the browser does not give the bytes.
pub(super) async fn load(file: &File) -> Result<Loaded, String> {
    let buffer = JsFuture::from(file.array_buffer()).await;
    let buffer: ArrayBuffer = buffer
        .map_err(|_| "the browser cannot read it; was it moved or is it a folder?".to_owned())?
        .unchecked_into();
    let sha256 = match digest(&buffer) {
        Some(digest) => JsFuture::from(digest).await.ok().map(|digest| hexadecimal(&digest)),
        None => None,
    };
    Ok(Loaded { bytes: Uint8Array::new(&buffer), sha256 })
}

impl Loaded {
    /// What is in the file, which is called `name`.
    ///
    /// # Errors
    ///
    /// When nothing is that Goalgraph reads.
    pub(super) fn content(self, name: &str) -> Result<Content, String> {
        read(name, &self.bytes.to_vec(), self.sha256.as_deref())
    }
}

/// The browser's SHA-256. Only pages of this machine and encrypted ones have it.
fn digest(buffer: &ArrayBuffer) -> Option<Promise> {
    let subtle = scope().crypto().ok()?.subtle();
    let is_there = !subtle.is_undefined() && buffer.byte_length() >= WORTH_A_CALL;
    is_there.then(|| subtle.digest_with_str_and_buffer_source("SHA-256", buffer).ok())?
}

fn hexadecimal(digest: &JsValue) -> String {
    let bytes = Uint8Array::new(digest).to_vec().into_iter();
    bytes
        .flat_map(|byte| [byte >> 4, byte & 15])
        .filter_map(|digit| char::from_digit(digit.into(), 16))
        .collect()
}
