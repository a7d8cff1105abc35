//! The coordinator's end of the pool: workers that are started when there is much to do, and kept.

use std::cell::RefCell;
use std::rc::Rc;

use futures_util::future::join_all;
use js_sys::{Function, Promise};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{ErrorEvent, MessageEvent, UrlSearchParams, Worker, WorkerOptions, WorkerType};

use super::parcel::Parcel;
use super::scope;

/// The name by which a worker knows that it belongs to a pool.
pub(super) const HAND: &str = "hand";
/// More workers than this wait for memory rather than for a core.
const MOST: usize = 8;
/// Files of fewer bytes together are read sooner than workers are started.
pub(super) const WORTH_READING: f64 = 2e6;
/// Fewer bytes of values are inferred from sooner than they are sent.
pub(super) const WORTH_INFERRING: f64 = 3e7;

/// Workers to share work with.
pub(super) struct Pool {
    size: usize,
    /// Whether nothing is too little.
    shares_all: bool,
    idle: RefCell<Vec<Hand>>,
}

impl Pool {
    /// As many workers as there are cores, up to [`MOST`]; `?workers=3` in the address of this worker says how many, and
    /// that nothing is too little for them.
    pub(super) fn of_scope() -> Self {
        let search = UrlSearchParams::new_with_str(&scope().location().search());
        let chosen = search.ok().and_then(|it| it.get("workers")).and_then(|it| it.parse().ok());
        let cores = scope().navigator().hardware_concurrency() as usize;
        Self {
            size: chosen.unwrap_or(cores).clamp(1, MOST),
            shares_all: chosen.is_some(),
            idle: RefCell::default(),
        }
    }

    /// Whether work over so many bytes is shared out, which it is worth from `least` on.
    pub(super) fn takes(&self, bytes: f64, least: f64) -> bool {
        self.size > 1 && (self.shares_all || bytes >= least)
    }

    /// Has all `tasks` done, each made when a worker is free for it; `done` is told the position of a task and its answer
    /// as they come. A worker that breaks down fails its task and is replaced.
    pub(super) async fn run(
        &self,
        tasks: impl ExactSizeIterator<Item = Parcel>,
        done: &dyn Fn(usize, Result<Parcel, String>),
    ) {
        let lanes = self.size.min(tasks.len());
        let queue = RefCell::new(tasks.enumerate());
        join_all((0..lanes).map(|_| self.work_off(&queue, done))).await;
    }

    async fn work_off(
        &self,
        queue: &RefCell<impl Iterator<Item = (usize, Parcel)>>,
        done: &dyn Fn(usize, Result<Parcel, String>),
    ) {
        let mut hand = self.idle.borrow_mut().pop();
        loop {
            let next = queue.borrow_mut().next();
            let Some((index, task)) = next else { break };
            let ready = match hand.take() {
                Some(hand) => Ok(hand),
                None => Hand::start().await,
            };
            let answer = match ready {
                Ok(ready) => {
                    let answer = ready.ask(&task).await;
                    hand = answer.is_ok().then_some(ready);
                    answer
                }
                Err(reason) => Err(reason),
            };
            done(index, answer);
        }
        self.idle.borrow_mut().extend(hand);
    }
}

/// A worker of the pool.
struct Hand {
    worker: Worker,
    /// Whoever waits for it, to be told that it broke down.
    waiting: Rc<RefCell<Option<Function>>>,
    _on_error: Closure<dyn FnMut(ErrorEvent)>,
}

impl Hand {
    /// Starts a worker and waits until it listens.
    async fn start() -> Result<Self, String> {
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        options.set_name(HAND);
        let worker = Worker::new_with_options("/worker_loader.js", &options)
            .map_err(|_| "the browser starts no worker".to_owned())?;
        let waiting = Rc::new(RefCell::new(None::<Function>));
        let told = Rc::clone(&waiting);
        let on_error = Closure::new(move |event: ErrorEvent| {
            // Else the page hears of it and ends the coordinator.
            event.prevent_default();
            if let Some(told) = told.take() {
                let _ = told.call1(&JsValue::NULL, &JsValue::from_str(&event.message()));
            }
        });
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        let hand = Self { worker, waiting, _on_error: on_error };
        JsFuture::from(hand.next_message()).await.map_err(|reason| broken(&reason))?;
        Ok(hand)
    }

    /// Has it do a task.
    async fn ask(&self, task: &Parcel) -> Result<Parcel, String> {
        let answer = self.next_message();
        let (message, owned) = task.message();
        self.worker.post_message_with_transfer(&message, &owned).map_err(|reason| broken(&reason))?;
        let event: MessageEvent =
            JsFuture::from(answer).await.map_err(|reason| broken(&reason))?.unchecked_into();
        Ok(Parcel::of_message(&event.data()))
    }

    /// The next message from it; fails when it breaks down before.
    fn next_message(&self) -> Promise {
        Promise::new(&mut |resolve, reject| {
            self.worker.set_onmessage(Some(&resolve));
            self.waiting.replace(Some(reject));
        })
    }
}

impl Drop for Hand {
    fn drop(&mut self) {
        self.worker.terminate();
    }
}

fn broken(reason: &JsValue) -> String {
    let reason = reason.as_string().unwrap_or_else(|| "it could not be loaded".to_owned());
    format!("a worker broke down ({reason}); the recordings may be too large for this browser")
}
