//! The page's end of the line to the worker.

use std::cell::{Cell, OnceCell, RefCell};
use std::rc::Rc;

use leptos::prelude::window;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::{ErrorEvent, File, MessageEvent, Worker};

use crate::program::Program;
use crate::protocol::{FromWorker, ToWorker, decode, encode};

/// What the line reports.
pub(crate) enum Report {
    /// The worker answered.
    Answer(FromWorker),
    /// The worker broke down, for this reason.
    Broken(String),
    /// No worker came to listen, for this reason. There is none until [`WorkerLink::restart`].
    Unstarted(String),
}

/// A worker, replaced when it is canceled or breaks down.
pub(crate) struct WorkerLink {
    report: Box<dyn Fn(Report)>,
    program: OnceCell<Program>,
    /// Whether the program is on its way; a worker is started once it is there.
    fetching: Cell<bool>,
    line: RefCell<Line>,
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
    pub(crate) fn start(report: impl Fn(Report) + 'static) -> Rc<Self> {
        let link = Rc::new(Self {
            report: Box::new(report),
            program: OnceCell::new(),
            fetching: Cell::default(),
            line: RefCell::default(),
        });
        link.restart();
        link
    }

    /// Ends the worker in the middle of whatever it does and starts a new one, which knows no demonstrations.
    pub(crate) fn restart(self: &Rc<Self>) {
        self.line.take();
        match self.program.get() {
            Some(program) => self.listen(program),
            None if self.fetching.replace(true) => {}
            None => spawn_local(Rc::clone(self).fetch()),
        }
    }

    /// Whether there is no worker, and none is on its way.
    pub(crate) fn is_down(&self) -> bool {
        self.line.borrow().worker.is_none() && !self.fetching.get()
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

    async fn fetch(self: Rc<Self>) {
        let fetched = Program::fetch().await;
        self.fetching.set(false);
        match fetched {
            Ok(program) => self.listen(self.program.get_or_init(|| program)),
            Err(_) => self.broke("it could not be loaded".to_owned()),
        }
    }

    fn listen(self: &Rc<Self>, program: &Program) {
        // `?workers=2` in the page's address says how many workers share what is large.
        let name = window().location().search().unwrap_or_default();
        let Ok(worker) = program.start(&name) else {
            return self.broke("the browser starts no worker".to_owned());
        };
        let link = Rc::downgrade(self);
        let on_message = Closure::<dyn FnMut(JsValue)>::new(move |event: JsValue| {
            let Some(link) = link.upgrade() else { return };
            let bytes = js_sys::Uint8Array::new(&event.unchecked_into::<MessageEvent>().data());
            match decode(&bytes.to_vec()) {
                Ok(FromWorker::Ready) => link.line.borrow_mut().flush(),
                Ok(answer) => (link.report)(Report::Answer(answer)),
                Err(error) => link.broke(format!("an answer that cannot be read: {error}")),
            }
        });
        let link = Rc::downgrade(self);
        let on_error = Closure::<dyn FnMut(JsValue)>::new(move |event: JsValue| {
            let message = event.dyn_into::<ErrorEvent>().map(|event| event.message());
            if let Some(link) = link.upgrade() {
                link.broke(message.unwrap_or_else(|_| "it could not be loaded".to_owned()));
            }
        });
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        let mut line = self.line.borrow_mut();
        line.worker = Some(worker);
        line.handlers = vec![on_message, on_error];
    }

    /// The worker broke down. One that never listened would do so again at once.
    fn broke(&self, reason: String) {
        let listened = self.line.borrow().listening;
        if !listened {
            self.line.take();
        }
        (self.report)(if listened { Report::Broken(reason) } else { Report::Unstarted(reason) });
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

impl Drop for Line {
    fn drop(&mut self) {
        if let Some(worker) = &self.worker {
            // What it has said already may still be on its way to handlers that are gone.
            worker.set_onmessage(None);
            worker.set_onerror(None);
            worker.terminate();
        }
    }
}
