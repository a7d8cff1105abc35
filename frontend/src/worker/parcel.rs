//! A message between workers: what it says, and beside it numbers or a file. Numbers are not encoded.

use js_sys::{Array, Float64Array, Uint8Array};
use serde::Serialize;
use wasm_bindgen::prelude::*;
use web_sys::File;

use crate::protocol::encode;

/// A message between workers.
pub(super) struct Parcel {
    /// What it says, encoded.
    pub(super) head: Vec<u8>,
    /// The numbers beside it.
    pub(super) values: Vec<f64>,
    /// The file beside it.
    pub(super) file: Option<File>,
}

impl Parcel {
    /// A message with numbers beside it.
    pub(super) fn new(head: &impl Serialize, values: Vec<f64>) -> Self {
        Self { head: encode(head), values, file: None }
    }

    /// A message with a file beside it.
    pub(super) fn with_file(head: &impl Serialize, file: File) -> Self {
        Self { head: encode(head), values: Vec::new(), file: Some(file) }
    }

    /// What to post, and what of it changes hands.
    pub(super) fn message(&self) -> (JsValue, Array) {
        let head = Uint8Array::from(self.head.as_slice());
        let values = Float64Array::from(self.values.as_slice());
        let owned = Array::of2(&head.buffer(), &values.buffer());
        let parts = Array::of2(&head, &values);
        if let Some(file) = &self.file {
            parts.push(file);
        }
        (parts.into(), owned)
    }

    /// The message that was posted as `data`.
    pub(super) fn of_message(data: &JsValue) -> Self {
        let parts = Array::from(data);
        Self {
            head: Uint8Array::new(&parts.get(0)).to_vec(),
            values: Float64Array::new(&parts.get(1)).to_vec(),
            file: parts.get(2).dyn_into().ok(),
        }
    }
}
