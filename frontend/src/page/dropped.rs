//! Files out of drops and file buttons, folders included.

use js_sys::{Array, Function, Promise};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{DataTransfer, File, FileList, FileSystemDirectoryEntry, FileSystemEntry, FileSystemFileEntry};

use super::update::{Action, App};

/// Opens the files that a file button gave.
pub(crate) fn open_list(app: App, list: &FileList) {
    let files = (0..list.length()).filter_map(|index| list.item(index));
    app.act(Action::Open(files.map(|file| (file.name(), file)).collect()));
}

/// Opens the files and folders that were dropped.
pub(crate) fn open_drop(app: App, transfer: &DataTransfer) {
    // The items are gone once the event is over: take their entries now, read them later.
    let items = transfer.items();
    let entries: Vec<FileSystemEntry> = (0..items.length())
        .filter_map(|index| items.get(index))
        .filter_map(|item| item.webkit_get_as_entry().ok().flatten())
        .collect();
    if entries.iter().any(FileSystemEntry::is_directory) {
        spawn_local(async move { app.act(Action::Open(files_in(entries).await)) });
    } else if let Some(list) = transfer.files() {
        open_list(app, &list);
    }
}

/// All files in `entries`, through all folders. What cannot be read is left out.
async fn files_in(entries: Vec<FileSystemEntry>) -> Vec<(String, File)> {
    let mut open = entries;
    let mut files = Vec::new();
    while let Some(entry) = open.pop() {
        if entry.is_directory() {
            open.extend(children(entry.unchecked_ref()).await);
        } else if let Some(file) = file_of(entry.unchecked_ref()).await {
            files.push((file.name(), file));
        }
    }
    files
}

/// The entries in a folder, which the browser gives in portions until one is empty.
async fn children(folder: &FileSystemDirectoryEntry) -> Vec<FileSystemEntry> {
    let reader = folder.create_reader();
    let mut children = Vec::new();
    loop {
        let portion = called_back(|resolve, reject| {
            reader.read_entries_with_callback_and_callback(resolve, reject).is_ok()
        });
        let portion: Vec<FileSystemEntry> = match portion.await {
            Some(entries) => Array::from(&entries).iter().map(JsCast::unchecked_into).collect(),
            None => return children,
        };
        if portion.is_empty() {
            return children;
        }
        children.extend(portion);
    }
}

async fn file_of(entry: &FileSystemFileEntry) -> Option<File> {
    let file = called_back(|resolve, reject| {
        entry.file_with_callback_and_callback(resolve, reject);
        true
    });
    file.await.map(JsCast::unchecked_into)
}

/// What `start` gives to its first callback; none when it calls the second.
async fn called_back(start: impl Fn(&Function, &Function) -> bool) -> Option<JsValue> {
    let promise = Promise::new(&mut |resolve, reject| {
        if !start(&resolve, &reject) {
            let _ = reject.call0(&JsValue::NULL);
        }
    });
    JsFuture::from(promise).await.ok()
}
