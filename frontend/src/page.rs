//! The page: what a person sees and does.

mod author;
mod autosave;
mod benchmark;
mod clock;
mod colors;
mod commands;
mod derived;
mod download;
mod dropped;
mod geometry;
mod keys;
mod labels;
mod links;
mod model;
mod monitor;
mod run_text;
mod samples;
mod server;
mod text;
mod theme;
mod update;
mod verdict;
mod view;
mod worker_link;

use leptos::prelude::*;

use update::App;

/// Shows the app and starts its worker.
pub fn start() {
    console_error_panic_hook::set_once();
    mount_to_body(|| {
        let app = App::new();
        app.start();
        view::shell::shell(app)
    });
}
