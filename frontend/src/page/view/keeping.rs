//! What the server keeps: how the work stands, and the dialogs about it.

mod approve;
mod ask;
mod canvas;
mod changes;
mod conflict;
mod difference;
mod open;
mod revisions;
mod sign;

use goalgraph::protocol::api::{Problem, Session};
use leptos::prelude::*;

use super::chips::{button, short_button};
use super::overlay::close_dialog;
use crate::page::model::{KeepDialog, Loading, Overlay, Server};
use crate::page::update::{Action, App, KeepAction};

/// The name, class and content of a dialog.
pub(crate) fn content(app: App, dialog: KeepDialog) -> (&'static str, &'static str, AnyView) {
    match dialog {
        KeepDialog::Login => ("Log in", "dialog", ask::login(app).into_any()),
        KeepDialog::Message => ("Save with a message", "dialog", ask::message(app).into_any()),
        KeepDialog::Delete => ("Delete on the server", "dialog", ask::delete(app).into_any()),
        KeepDialog::Open => ("Open from the server", "dialog", open::open(app).into_any()),
        KeepDialog::Revisions => ("Revisions", "dialog broad", revisions::revisions(app).into_any()),
        KeepDialog::Approve => ("Approve", "dialog wide", approve::approve(app).into_any()),
        KeepDialog::Revoke => ("Revoke the approval", "dialog", approve::revoke(app).into_any()),
        KeepDialog::Conflict => {
            ("Somebody else saved meanwhile", "dialog broad", conflict::conflict(app).into_any())
        }
        KeepDialog::Difference => ("What differs", "dialog wide", difference::difference(app).into_any()),
    }
}

/// How the work stands, in the bar: the revision, and a button for what is due.
pub(crate) fn standing(app: App) -> impl IntoView {
    let standing = app.derived.keeping.standing;
    let text = move || standing.with(|it| it.short.clone());
    let shown = move || standing.with(|it| !it.short.is_empty());
    let is_kept = move || app.derived.keeping.lineage.with(Option::is_some);
    let is_absent = move || app.model.keeping.server.with(|it| *it == Server::Absent);
    let go = move |_| {
        let dialog = match app.model.keeping.server.get_untracked() {
            Server::Locked => KeepDialog::Login,
            _ => KeepDialog::Revisions,
        };
        if is_kept() || dialog == KeepDialog::Login {
            app.act(Action::Keep(KeepAction::Ask(dialog)));
        }
    };
    let mark = move || {
        let approved = standing.with(|it| it.approved);
        approved.then(|| view! { <span class="approved-mark" aria-hidden="true">"✓"</span> })
    };
    let as_button = move || is_kept() || app.model.keeping.server.with(|it| *it == Server::Locked);
    move || {
        shown().then(|| {
            let long = standing.with(|it| it.long.clone());
            let pressing = standing.with(|it| it.pressing);
            let said = if as_button() {
                let label = format!("Revision: {}", text());
                view! {
                    <button type="button" class="standing" class:pressing=pressing title=long aria-label=label on:click=go>
                        {mark} <span>{text}</span>
                    </button>
                }
                .into_any()
            } else {
                view! { <span class="standing" class:pressing=pressing title=long>{text}</span> }.into_any()
            };
            view! {
                <div class="kept">
                    {said}
                    {move || (!is_absent()).then(|| short_button(app, "save", "Save"))}
                </div>
            }
        })
    }
}

/// What waits while the server does not answer.
pub(crate) fn banner(app: App) -> impl IntoView {
    let keeping = &app.model.keeping;
    move || {
        let queued = keeping.queued.with(Option::is_some);
        let locked = keeping.server.with(|it| *it == Server::Locked);
        queued.then(|| {
            let sentence = if locked {
                "The server asks for a token. Your save waits in this browser until you log in."
            } else {
                "The server does not answer. Your save waits in this browser and is sent when it does; you can go on working."
            };
            view! {
                <div class="banner" role="status">
                    <p>{sentence}</p>
                    {if locked {
                        button(app, "log-in").into_any()
                    } else {
                        let retry = move |_| app.act(Action::Keep(KeepAction::Retry));
                        view! { <button type="button" class="button" on:click=retry>"Try now"</button> }.into_any()
                    }}
                </div>
            }
        })
    }
}

/// How many recordings are at the server by now.
pub(crate) fn uploading(app: App) -> impl IntoView {
    move || {
        let (done, number) = app.model.keeping.uploading.get()?;
        Some(view! { <p class="hint">{format!("Recordings to the server: {done} of {number}")}</p> })
    }
}

/// The heading of a dialog, with a button that closes it.
fn heading(text: impl IntoView) -> impl IntoView {
    view! {
        <header class="section-head dialog-head">
            <h2>{text}</h2>
            <button type="button" class="button" on:click=move |event| close_dialog(&event)>"Close"</button>
        </header>
    }
}

/// What is here, or a sentence about why it is not.
fn when_here<T: Clone>(loading: Loading<T>, show: impl FnOnce(T) -> AnyView) -> AnyView {
    match loading {
        Loading::Waiting => view! { <p class="hint" role="status">"Asking the server"</p> }.into_any(),
        Loading::Failed(reason) => view! { <p class="refusal" role="alert">{reason}</p> }.into_any(),
        Loading::Here(it) => show(it),
    }
}

/// Why the server did not take what the dialog sent.
fn refusal(app: App) -> impl IntoView {
    move || {
        app.model.keeping.refusal.get().map(|Problem { detail, findings, .. }| {
            let findings = findings.into_iter().map(|finding| view! { <li>{finding}</li> }).collect_view();
            view! {
                <div class="refused" role="alert">
                    <p class="refusal">{format!("Not done: {detail}.")}</p>
                    <ul>{findings}</ul>
                </div>
            }
        })
    }
}

/// Under which name somebody saves and signs: the token's, which cannot be chosen, or a remembered one.
fn author_field(app: App) -> impl IntoView {
    let token = app.model.keeping.server.with_untracked(|server| match server {
        Server::Present(Session { name, .. }) => name.clone(),
        _ => None,
    });
    let fixed = token.is_some();
    let value = token.unwrap_or_else(|| app.model.keeping.author.get_untracked());
    let typed = move |event| app.act(Action::Keep(KeepAction::Author(event_target_value(&event))));
    view! {
        <label class="field">
            "Your name"
            <input type="text" name="author" autocomplete="name" maxlength="200" prop:value=value readonly=fixed on:input=typed />
        </label>
    }
}

/// A time of the server (RFC 3339) as the clock of this computer has it.
fn when(text: &str) -> String {
    let date = js_sys::Date::new(&text.into());
    if date.get_time().is_nan() {
        return text.to_owned();
    }
    let (year, month, day) = (date.get_full_year(), date.get_month() + 1, date.get_date());
    format!("{year}-{month:02}-{day:02} {:02}:{:02}", date.get_hours(), date.get_minutes())
}

/// Whether a dialog is the one that is open.
fn close(app: App) {
    if matches!(app.model.overlay.get_untracked(), Some(Overlay::Keep(_))) {
        app.act(Action::Overlay(None));
    }
}
