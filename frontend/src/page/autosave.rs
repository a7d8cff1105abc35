//! The work survives a reload: every change is kept in the browser's database a moment later.
//!
//! What cannot be read when the page starts is kept aside under a name of its own and said, never dropped.

mod saved;
mod store;

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use goalgraph::history::History;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::File;

use super::model::{Basis, Learned, Notice, Tab};
use super::text::count;
use super::update::{Action, App, KeepAction};
use saved::{Saved, SavedLearning};
use store::{Shelf, Store};

/// The name of the work.
const WORK: &str = "current";
/// How names of work that could not be read begin.
const ASIDE: &str = "aside ";
/// How long after a change it is kept: several in a row are one.
const DELAY: Duration = Duration::from_millis(250);

/// Restores the work of the last visit, then keeps every change.
pub(crate) fn start(app: App) {
    spawn_local(async move {
        match Store::open().await {
            Ok(store) => {
                let store = Rc::new(store);
                if restore(app, &store).await {
                    watch(app, store);
                }
            }
            Err(_) => say_unkept(app),
        }
        app.act(Action::Keep(KeepAction::Restored));
    });
}

/// The app works without a database as well; the work just ends with the page.
fn say_unkept(app: App) {
    if !app.model.unkept.get_untracked() {
        app.model.unkept.set(true);
        let sentence =
            "The browser has no room to keep this work: it ends with the page. Export what you need.";
        app.act(Action::Say(Notice::alarm(sentence)));
    }
}

/// Whether nothing is in the way of keeping what comes next.
async fn restore(app: App, store: &Store) -> bool {
    let kept = store.get(Shelf::Work, WORK).await.ok().flatten().and_then(|text| text.as_string());
    let mut safe = true;
    if let Some(text) = kept {
        match Saved::from_json(&text) {
            Ok((saved, history)) => {
                let files = files(store, &saved.files).await;
                let untouched = app.model.files.with_untracked(Vec::is_empty)
                    && app.model.history.with_untracked(Option::is_none);
                if untouched {
                    put_back(app, saved, history, files);
                } else {
                    let why = "is not back: something else was opened before";
                    safe = set_aside(app, store, &text, why).await;
                }
            }
            Err(reason) => {
                safe = set_aside(app, store, &text, &format!("cannot be read ({reason})")).await;
            }
        }
    }
    let names = store.names(Shelf::Work).await.unwrap_or_default();
    app.model.aside.set(names.into_iter().filter(|name| name.starts_with(ASIDE)).collect());
    safe
}

/// Whether the work is safe under another name.
async fn set_aside(app: App, store: &Store, text: &str, reason: &str) -> bool {
    let name = format!("{ASIDE}{:.0}", js_sys::Date::now());
    if store.put(Shelf::Work, &name, &JsValue::from_str(text)).await.is_err() {
        app.model.unkept.set(true);
        let sentence = format!(
            "The work of your last visit {reason}, and there is no room to keep it aside. Nothing new is kept until you reload."
        );
        app.act(Action::Say(Notice::alarm(sentence)));
        return false;
    }
    // It is there twice when this fails, which does no harm.
    let _ = store.delete(Shelf::Work, WORK).await;
    let sentence = format!(
        "The work of your last visit {reason}. It is kept aside: \"Save what was kept aside\" in the commands."
    );
    app.act(Action::Say(Notice::alarm(sentence)));
    true
}

/// The recordings that are still there.
async fn files(store: &Store, names: &[String]) -> Vec<(String, File)> {
    let mut files = Vec::new();
    for name in names {
        let kept = store.get(Shelf::Files, name).await.ok().flatten();
        if let Some(file) = kept.and_then(|file| file.dyn_into::<File>().ok()) {
            files.push((name.clone(), file));
        }
    }
    files
}

fn put_back(app: App, saved: Saved, history: Option<History>, files: Vec<(String, File)>) {
    let steps = history.as_ref().map(|history| history.labels().len());
    app.model.task_name.set(saved.task_name);
    app.model.held.set(saved.held);
    app.model.history.set(history);
    app.act(Action::Keep(KeepAction::PutBack(saved.lineages, saved.queued)));
    app.act(Action::Open(files));
    if let Some(SavedLearning { files, request, outcome }) = saved.learned {
        let settings = super::model::Settings {
            subsets: (!request.subsets.is_empty()).then(|| request.subsets.clone()),
            method: request.method,
            radius: request.radius,
        };
        app.model.settings.set(settings);
        let id = |name: &String| {
            app.model
                .files
                .with_untracked(|files| files.iter().find(|file| file.name == *name).map(|file| file.id))
        };
        let basis = Basis { files: files.iter().filter_map(id).collect(), request };
        app.model.learned.set(Some(Learned { basis, outcome: Arc::new(outcome) }));
    }
    if let Some(steps) = steps {
        app.model.tab.set(Tab::Automaton);
        app.act(Action::Say(Notice::calm(format!(
            "Restored as you left it, with {}.",
            count(steps, "step")
        ))));
    }
}

/// Work that was let go of, as long as the page is open.
pub(crate) struct LetGo {
    work: String,
    files: Vec<(String, File)>,
}

/// The work as it is, to be brought back; none when there is none.
pub(crate) fn let_go(app: App) -> Option<LetGo> {
    let files = app.loaded_files();
    let work = app.model.history.with_untracked(Option::is_some) || !files.is_empty();
    work.then(|| LetGo { work: current(app).to_json(), files })
}

/// Brings work back that was let go of.
pub(crate) fn bring_back(app: App, LetGo { work, files }: LetGo) {
    // It was written by this program a moment ago.
    if let Ok((saved, history)) = Saved::from_json(&work) {
        put_back(app, saved, history, files);
    }
}

/// Keeps every change from now on.
fn watch(app: App, store: Rc<Store>) {
    let waiting = Rc::new(RefCell::new(None::<TimeoutHandle>));
    let leaving = {
        let (store, waiting) = (Rc::clone(&store), Rc::clone(&waiting));
        move |_| keep_now(app, &store, &waiting)
    };
    // For as long as the page is there.
    window_event_listener_untyped("pagehide", leaving);
    Effect::new(move |before: Option<()>| {
        app.model.history.track();
        app.model.held.track();
        app.model.learned.track();
        app.model.files.track();
        app.model.task_name.track();
        app.model.keeping.lineages.track();
        app.model.keeping.queued.track();
        // What is on its way to be kept is kept as it is then, so one timer is enough, and nothing puts it off.
        if before.is_none() || waiting.borrow().is_some() {
            return;
        }
        let later = {
            let (store, waiting) = (Rc::clone(&store), Rc::clone(&waiting));
            move || keep_now(app, &store, &waiting)
        };
        *waiting.borrow_mut() = set_timeout_with_handle(later, DELAY).ok();
    });
}

/// Keeps what is waiting to be kept.
fn keep_now(app: App, store: &Rc<Store>, waiting: &RefCell<Option<TimeoutHandle>>) {
    if let Some(handle) = waiting.take() {
        handle.clear();
        let store = Rc::clone(store);
        spawn_local(async move { keep(app, &store).await });
    }
}

async fn keep(app: App, store: &Store) {
    let files = app.loaded_files();
    let work = app.model.history.with_untracked(Option::is_some) || !files.is_empty();
    let kept = if work {
        store.put(Shelf::Work, WORK, &JsValue::from_str(&current(app).to_json())).await
    } else {
        store.delete(Shelf::Work, WORK).await
    };
    let kept = match kept {
        Ok(()) => keep_files(store, &files).await,
        refused => refused,
    };
    if kept.is_err() {
        say_unkept(app);
    }
}

fn current(app: App) -> Saved {
    let model = app.model;
    let name_of = |id: &crate::protocol::FileId| {
        model
            .files
            .with_untracked(|files| files.iter().find(|file| file.id == *id).map(|file| file.name.clone()))
    };
    let learning = |learned: &Learned| SavedLearning {
        files: learned.basis.files.iter().filter_map(name_of).collect(),
        request: learned.basis.request.clone(),
        outcome: (*learned.outcome).clone(),
    };
    Saved {
        history: model.history.with_untracked(|history| history.as_ref().map(History::log)),
        held: model.held.get_untracked(),
        task_name: model.task_name.get_untracked(),
        files: model.files.with_untracked(|files| files.iter().map(|file| file.name.clone()).collect()),
        learned: model.learned.with_untracked(|learned| learned.as_ref().map(learning)),
        lineages: model.keeping.lineages.get_untracked(),
        queued: model.keeping.queued.get_untracked(),
        ..Saved::empty()
    }
}

/// Keeps the recordings that are not kept yet, and forgets those that are gone.
async fn keep_files(store: &Store, files: &[(String, File)]) -> Result<(), idb::Error> {
    let known: BTreeSet<String> = store.names(Shelf::Files).await?.into_iter().collect();
    for (name, file) in files {
        let kept = store.get(Shelf::Files, name).await?;
        if !kept.is_some_and(|kept| is_same(&kept, file)) {
            store.put(Shelf::Files, name, file).await?;
        }
    }
    for name in known.iter().filter(|name| files.iter().all(|(there, _)| there != *name)) {
        store.delete(Shelf::Files, name).await?;
    }
    Ok(())
}

fn is_same(kept: &JsValue, file: &File) -> bool {
    let kept: Option<&File> = kept.dyn_ref();
    let stamp = |file: &File| (file.size().to_bits(), file.last_modified().to_bits());
    kept.is_some_and(|kept| stamp(kept) == stamp(file))
}

/// Gives work that was kept aside to the user as a file, and forgets it then.
pub(crate) fn save_aside(app: App) {
    spawn_local(async move {
        let Ok(store) = Store::open().await else { return };
        for name in app.model.aside.get_untracked() {
            let text = store.get(Shelf::Work, &name).await.ok().flatten().and_then(|text| text.as_string());
            let saved = text.is_some_and(|text| {
                super::download::save("goalgraph-kept-aside.json", "application/json", &text).is_ok()
            });
            if saved && store.delete(Shelf::Work, &name).await.is_ok() {
                app.model.aside.update(|aside| aside.retain(|it| *it != name));
            }
        }
    });
}
