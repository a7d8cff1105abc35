//! The worker: reads files, infers specifications and places automata while the page stays free.
//!
//! ```text
//! page <-> coordinator <-> pool of workers
//! ```
//!
//! The page knows the coordinator only. That keeps the demonstrations, and shares out what is large over a pool of
//! workers of its own, which end with it. Each has a memory of its own: what one needs of another is sent.

mod answers;
mod coordinator;
mod file;
mod hand;
mod looking;
mod opening;
mod parcel;
mod piece;
mod pool;
mod reading;
mod recordings;
mod shared_study;
mod task;
mod thin;
mod warm_up;

use wasm_bindgen::prelude::*;
use web_sys::DedicatedWorkerGlobalScope;

/// Starts to listen to whoever started this worker, and says so.
pub fn start() {
    console_error_panic_hook::set_once();
    if scope().name() == pool::HAND { hand::start() } else { coordinator::start() }
}

fn scope() -> DedicatedWorkerGlobalScope {
    js_sys::global().unchecked_into()
}
