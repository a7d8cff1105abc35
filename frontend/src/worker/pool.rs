//! The coordinator's end of the pool: workers that are started when there is much to do, and kept.

use std::cell::RefCell;
use std::rc::Rc;

use futures_util::future::join_all;
use js_sys::{Function, Promise};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{ErrorEvent, Event, MessageEvent, UrlSearchParams, Worker};

use super::hand;
use super::parcel::Parcel;
use super::scope;
use crate::program::Program;

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
    /// As many workers as there are cores, up to [`MOST`]; `?workers=3` in the name of this worker says how many, and that
    /// nothing is too little for them.
    pub(super) fn of_scope() -> Self {
        let search = UrlSearchParams::new_with_str(&scope().name());
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
    /// as they come. A worker that breaks down is replaced, and a task fails that breaks two. Where no worker can be
    /// started, this one does the work.
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
        let mut lane = Lane::Free(self.idle.borrow_mut().pop());
        loop {
            let next = queue.borrow_mut().next();
            let Some((index, task)) = next else { break };
            let first = lane.ask(&task).await;
            done(index, if first.is_ok() { first } else { lane.ask(&task).await });
        }
        if let Lane::Free(hand) = lane {
            self.idle.borrow_mut().extend(hand);
        }
    }
}

/// Where one task is done after the other.
enum Lane {
    /// By a worker of the pool, which is started when there is none.
    Free(Option<Hand>),
    /// By this worker: no other can be started.
    Alone,
}

impl Lane {
    /// Has a task done; whoever breaks down over it is gone.
    async fn ask(&mut self, task: &Parcel) -> Result<Parcel, String> {
        if let Self::Free(hand) = self {
            let ready = match hand.take() {
                Some(hand) => Some(hand),
                None => Hand::start().await,
            };
            if let Some(ready) = ready {
                let answer = ready.ask(task).await;
                *hand = answer.is_ok().then_some(ready);
                return answer;
            }
            *self = Self::Alone;
        }
        Ok(hand::serve(task).await)
    }
}

/// A worker of the pool.
struct Hand {
    worker: Worker,
    /// Whoever waits for it, to be told that it broke down.
    waiting: Rc<RefCell<Option<Function>>>,
    _on_error: Closure<dyn FnMut(Event)>,
}

impl Hand {
    /// Starts a worker and waits until it listens; none where it does not come to that.
    async fn start() -> Option<Self> {
        let worker = Program::own(&scope().location()).start(HAND).ok()?;
        let waiting = Rc::new(RefCell::new(None::<Function>));
        let told = Rc::clone(&waiting);
        let on_error = Closure::new(move |event: Event| {
            // Else the page hears of it and ends the coordinator.
            event.prevent_default();
            // What cannot be loaded gives no reason.
            let message = event.dyn_into::<ErrorEvent>().map(|event| event.message());
            if let Some(told) = told.take() {
                let _ = told.call1(&JsValue::NULL, &message.unwrap_or_default().into());
            }
        });
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        let hand = Self { worker, waiting, _on_error: on_error };
        JsFuture::from(hand.next_message()).await.ok()?;
        Some(hand)
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
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

fn broken(reason: &JsValue) -> String {
    let reason = reason.as_string().unwrap_or_else(|| "without a reason".to_owned());
    format!("a worker broke down ({reason}); the recordings may be too large for this browser")
}
