//! A rehearsal of what happens between a drop and a drawn automaton, while nobody waits for anything.
//!
//! Browsers compile a function when it is first called, and look for the glyphs of a text when it is first laid out. Done
//! when the files are there, that takes longer than to read them and to learn from them.

use js_sys::{Array, Function, Promise};
use leptos::mount::{UnmountHandle, mount_to};
use leptos::prelude::*;
use leptos::task::{spawn_local, tick};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{File, HtmlElement};

use super::App;
use crate::page::view::shell;
use crate::page::worker_link::Report;
use crate::protocol::FromWorker;

/// The mark on the browser's timeline when the page has rehearsed.
const REHEARSED: &str = "rehearsed";

/// Width and height of the frame of the graph.
const FRAME: (f64, f64) = (800.0, 600.0);

impl App {
    /// Has another app, which nobody sees, hear what the first worker `said`, unless this one is at work.
    pub(super) fn rehearse(self, said: Vec<FromWorker>) {
        if self.outside.get_value().has_rehearsed.replace(true) {
            return;
        }
        spawn_local(async move {
            let owner = Owner::new();
            let understudy = owner.with(Self::new);
            // Like this app it may be called by a timer at any time, so its state is never given back.
            std::mem::forget(owner);
            understudy.model.frame.set(FRAME);
            understudy.open(empty_files(&said));
            for message in said {
                idle().await;
                if !self.is_unused() {
                    return;
                }
                understudy.perform(message).await;
            }
            // Where there is no timeline, nobody looks for marks.
            let _ = window().performance().map(|timeline| timeline.mark(REHEARSED));
        });
    }

    /// Hears one thing on a stage that is gone when the browser draws next.
    async fn perform(self, message: FromWorker) {
        let Some(stage) = set_stage(self) else { return };
        self.hear(Report::Answer(message));
        // What follows from it happens before anything else does.
        tick().await;
        stage.lay_out();
    }

    fn is_unused(self) -> bool {
        self.model.files.with_untracked(Vec::is_empty)
            && self.derived.specification.with_untracked(Option::is_none)
    }
}

/// A file for each that the worker `said` it has read; the worker's numbers are those of a fresh app.
fn empty_files(said: &[FromWorker]) -> Vec<(String, File)> {
    let read = said.iter().filter(|message| matches!(message, FromWorker::Read(_))).count();
    let name = |number: usize| format!("rehearsal-{number}.csv");
    let file = |name: String| Some((name.clone(), File::new_with_str_sequence(&Array::new(), &name).ok()?));
    (0..read).map(name).filter_map(file).collect()
}

/// The page of an app that nobody sees, until it is dropped.
struct Stage<View: Mountable> {
    element: HtmlElement,
    /// Takes the page off the stage, before the stage goes.
    page: Option<UnmountHandle<View>>,
}

fn set_stage(app: App) -> Option<Stage<impl Mountable>> {
    let element: HtmlElement = document().create_element("div").ok()?.dyn_into().ok()?;
    element.set_class_name("rehearsal");
    document().body()?.append_child(&element).ok()?;
    let page = mount_to(element.clone(), move || shell::page(app));
    Some(Stage { element, page: Some(page) })
}

impl<View: Mountable> Stage<View> {
    /// Has the browser lay out what is there; it does so when it is asked for a size.
    fn lay_out(&self) {
        let _ = self.element.offset_height();
    }
}

impl<View: Mountable> Drop for Stage<View> {
    fn drop(&mut self) {
        self.page.take();
        self.element.remove();
    }
}

/// Waits until the browser has nothing else to do; for ever where it cannot tell.
async fn idle() {
    let mut rests = |resolve: Function, _: Function| {
        request_idle_callback(move || drop(resolve.call0(&JsValue::NULL)));
    };
    // Nobody refuses it.
    let _ = JsFuture::from(Promise::new(&mut rests)).await;
}
