//! Finding the server, and who asks it.

use leptos::ev;
use leptos::prelude::*;
use wasm_bindgen_futures::spawn_local;

use super::{App, KeepAction};
use crate::page::author;
use crate::page::model::{KeepDialog, Notice, Overlay, Server};
use crate::page::server::{self, Failure};
use crate::page::update::Action;

impl App {
    /// Looks for the server, and listens to what the browser says of it.
    pub(in crate::page::update) fn start_keeping(self) {
        self.keeping().author.set(author::stored());
        self.read_address();
        self.ask_session();
        // The page lives as long as the window.
        let again = move |_| {
            self.keeping().attempts.set(0);
            self.act(Action::Keep(KeepAction::Retry));
        };
        let _ = window_event_listener(ev::online, again);
        let _ = window_event_listener(ev::focus, move |_| self.refresh());
        let _ = window_event_listener(ev::hashchange, move |_| {
            self.read_address();
            self.act(Action::Keep(KeepAction::Follow));
        });
        Effect::new(move |_| {
            // The work of the last visit comes first, so that it is known what would be lost.
            let ready = self.keeping().restored.get();
            let known = self.keeping().server.with(|server| *server != Server::Asking);
            if ready && known {
                untrack(|| self.act(Action::Keep(KeepAction::Follow)));
            }
        });
    }

    pub(super) fn ask_session(self) {
        spawn_local(async move {
            let keeping = self.keeping();
            match server::session().await {
                Ok(Some(session)) => {
                    keeping.offline.set(false);
                    keeping.server.set(Server::Present(session));
                    self.retry();
                    self.refresh();
                }
                Ok(None) => keeping.server.set(Server::Absent),
                Err(Failure::Locked) => keeping.server.set(Server::Locked),
                Err(_) => {
                    keeping.offline.set(true);
                    self.retry_later();
                }
            }
        });
    }

    /// The server asks for a token: without one nothing goes on.
    pub(super) fn lock(self) {
        self.keeping().server.set(Server::Locked);
        self.keeping().refusal.set(None);
        self.model.overlay.set(Some(Overlay::Keep(KeepDialog::Login)));
    }

    pub(super) fn log_in(self, token: String) {
        spawn_local(async move {
            match server::log_in(token).await {
                Ok(()) => {
                    self.close_dialog();
                    self.say(Notice::calm("Logged in."));
                    self.ask_session();
                }
                Err(failure) => {
                    let detail = match failure {
                        Failure::Locked => "the server does not know this token".to_owned(),
                        other => other.to_string(),
                    };
                    self.refuse_with(detail);
                }
            }
        });
    }

    pub(super) fn set_author(self, name: String) {
        author::store(&name);
        self.keeping().author.set(name);
    }
}
