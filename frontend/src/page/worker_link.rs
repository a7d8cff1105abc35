//! The page's end of the line to the worker.

use std::cell::RefCell;
use std::rc::Rc;

use leptos::prelude::window;
use wasm_bindgen::prelude::*;
use web_sys::{ErrorEvent, File, MessageEvent, Worker, WorkerOptions, WorkerType};

use crate::protocol::{FromWorker, ToWorker, decode, encode};

/// What the line reports.
pub(crate) enum Report {
    /// The worker answered.
    Answer(FromWorker),
    /// The worker broke down, for this reason.
    Broken(String),
}

/// A worker, replaced when it is canceled or breaks down.
pub(crate) struct WorkerLink {
    report: Rc<dyn Fn(Report)>,
    line: Rc<RefCell<Line>>,
}

/// The present worker and what waits until it listens.
#[derive(Default)]
struct Line {
    worker: Option<Worker>,
    listening: bool,
    waiting: Vec<JsValue>,
    handlers: Vec<Closure<dyn FnMut(JsValue)>>,
}

impl WorkerLink {
    /// Starts a worker; `report` hears what it says.
    pub(crate) fn start(report: impl Fn(Report) + 'static) -> Self {
        let link = Self { report: Rc::new(report), line: Rc::default() };
        link.restart();
        link
    }

    /// Ends the worker in the middle of whatever it does and starts a new one, which knows no demonstrations.
    pub(crate) fn restart(&self) {
        if let Some(worker) = self.line.take().worker {
            worker.terminate();
        }
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        // `?workers=2` in the page's address says how many workers share what is large.
        let search = window().location().search().unwrap_or_default();
        match Worker::new_with_options(&format!("/worker_loader.js{search}"), &options) {
            Ok(worker) => self.listen(worker),
            Err(_) => (self.report)(Report::Broken("the browser starts no worker".to_owned())),
        }
    }

    /// Sends a request, with the files that it is about.
    pub(crate) fn post<'a>(&self, request: &ToWorker, files: impl IntoIterator<Item = &'a File>) {
        let parts = js_sys::Array::of1(&js_sys::Uint8Array::from(encode(request).as_slice()));
        for file in files {
            parts.push(file);
        }
        let mut line = self.line.borrow_mut();
        match &line.worker {
            // What is posted are bytes and files, which always can be copied.
            Some(worker) if line.listening => drop(worker.post_message(&parts)),
            _ => line.waiting.push(parts.into()),
        }
    }

    fn listen(&self, worker: Worker) {
        let (report, line) = (Rc::clone(&self.report), Rc::downgrade(&self.line));
        let on_message = Closure::<dyn FnMut(JsValue)>::new(move |event: JsValue| {
            let bytes = js_sys::Uint8Array::new(&event.unchecked_into::<MessageEvent>().data());
            match decode(&bytes.to_vec()) {
                Ok(FromWorker::Ready) => line.upgrade().iter().for_each(|line| line.borrow_mut().flush()),
                Ok(answer) => report(Report::Answer(answer)),
                Err(error) => report(Report::Broken(format!("an answer that cannot be read: {error}"))),
            }
        });
        let report = Rc::clone(&self.report);
        let on_error = Closure::<dyn FnMut(JsValue)>::new(move |event: JsValue| {
            let message = event.dyn_into::<ErrorEvent>().map(|event| event.message());
            report(Report::Broken(message.unwrap_or_else(|_| "it could not be loaded".to_owned())));
        });
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        let mut line = self.line.borrow_mut();
        line.worker = Some(worker);
        line.handlers = vec![on_message, on_error];
    }
}

impl Line {
    /// The worker listens from now on: give it what has been waiting.
    fn flush(&mut self) {
        self.listening = true;
        if let Some(worker) = &self.worker {
            self.waiting.drain(..).for_each(|request| drop(worker.post_message(&request)));
        }
    }
}
