//! Answers to the page. What many files hold is said in few messages, for the page shows every one.

use std::cell::{Cell, RefCell};

use js_sys::{Array, Date, Uint8Array};

use super::scope;
use crate::protocol::{FromWorker, ReadFile, encode};

/// How many milliseconds an answer may wait for others.
const PATIENCE: f64 = 100.0;

/// Says something to the page.
pub(super) fn answer(message: &FromWorker) {
    let bytes = Uint8Array::from(encode(message).as_slice());
    // The page takes all bytes; posting them cannot fail.
    let _ = scope().post_message_with_transfer(&bytes, &Array::of1(&bytes.buffer()));
}

/// What was read and not said yet.
pub(super) struct Answers {
    read: RefCell<Vec<ReadFile>>,
    given: Cell<f64>,
}

impl Default for Answers {
    fn default() -> Self {
        Self { read: RefCell::default(), given: Cell::new(Date::now()) }
    }
}

impl Answers {
    /// Says `message`, or keeps it for a moment when it says what is in files.
    pub(super) fn add(&self, message: FromWorker) {
        match message {
            FromWorker::Read(files) => {
                self.read.borrow_mut().extend(files);
                if Date::now() - self.given.get() > PATIENCE {
                    self.give();
                }
            }
            other => answer(&other),
        }
    }

    /// Says what was kept.
    pub(super) fn give(&self) {
        let read = self.read.take();
        if !read.is_empty() {
            answer(&FromWorker::Read(read));
        }
        self.given.set(Date::now());
    }
}
