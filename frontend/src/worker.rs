//! The worker: reads files, infers specifications and places automata while the page stays free.

mod looking;
mod opening;
mod recordings;
mod thin;

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{DedicatedWorkerGlobalScope, File, MessageEvent};

use crate::protocol::{FromWorker, ToWorker};
use recordings::Recordings;

/// Starts to listen to the page, and says so.
pub fn start() {
    console_error_panic_hook::set_once();
    let queue = Rc::new(Queue::default());
    let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        if let Some(job) = job_of(&event) {
            queue.add(job);
        }
    });
    scope().set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    on_message.forget();
    answer(&FromWorker::Ready);
}

/// A request and the file that it is about.
type Job = (ToWorker, Option<File>);

/// Jobs are done one after the other, in the order in which they came.
#[derive(Default)]
struct Queue {
    jobs: RefCell<VecDeque<Job>>,
    busy: Cell<bool>,
    recordings: RefCell<Recordings>,
}

impl Queue {
    fn add(self: &Rc<Self>, job: Job) {
        self.jobs.borrow_mut().push_back(job);
        if !self.busy.replace(true) {
            spawn_local(Rc::clone(self).work());
        }
    }

    async fn work(self: Rc<Self>) {
        loop {
            let job = self.jobs.borrow_mut().pop_front();
            let Some((request, file)) = job else { break };
            let bytes = match file {
                Some(file) => Some(bytes_of(&file).await),
                None => None,
            };
            self.recordings.borrow_mut().serve(request, bytes, &mut |message| answer(&message));
        }
        self.busy.set(false);
    }
}

/// A message is an array: the request's text, then the file where there is one.
fn job_of(event: &MessageEvent) -> Option<Job> {
    let parts: js_sys::Array = event.data().dyn_into().ok()?;
    let request = serde_json::from_str(&parts.get(0).as_string()?).ok()?;
    Some((request, parts.get(1).dyn_into().ok()))
}

/// All bytes of a file, or why the browser does not give them.
async fn bytes_of(file: &File) -> Result<Vec<u8>, String> {
    let buffer = JsFuture::from(file.array_buffer()).await;
    let buffer =
        buffer.map_err(|_| "the browser cannot read it; was it moved or is it a folder?".to_owned())?;
    Ok(js_sys::Uint8Array::new(&buffer).to_vec())
}

fn answer(message: &FromWorker) {
    let text = serde_json::to_string(message).unwrap_or_default();
    // The page takes every text; posting one cannot fail.
    let _ = scope().post_message(&JsValue::from_str(&text));
}

fn scope() -> DedicatedWorkerGlobalScope {
    js_sys::global().unchecked_into()
}
