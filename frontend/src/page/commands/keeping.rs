//! Commands for what the server keeps: saves, revisions, approvals.

use goalgraph::protocol::api::Role;
use leptos::prelude::*;

use super::{Command, has_automaton};
use crate::page::model::{KeepDialog, Server};
use crate::page::update::{Action, App, KeepAction};

pub(super) const COMMANDS: &[Command] = &[
    Command {
        id: "save",
        label: "Save",
        help: "Save the work as a new revision on the server; without a server, as a file.",
        keys: &["Ctrl+s"],
        in_menu: false,
        enabled: |app| has_automaton(app) && may_save(app),
        run: |app| keep(app, KeepAction::Save(String::new())),
    },
    Command {
        id: "save-message",
        label: "Save with a message",
        help: "Save the work as a new revision, and say what there is to say about it.",
        keys: &["Ctrl+Shift+s"],
        in_menu: false,
        enabled: |app| has_automaton(app) && may_save(app) && has_server(app),
        run: |app| ask(app, KeepDialog::Message),
    },
    Command {
        id: "open-server",
        label: "Open from the server",
        help: "Choose a specification that the server keeps.",
        keys: &["Ctrl+o"],
        in_menu: false,
        enabled: has_server,
        run: |app| ask(app, KeepDialog::Open),
    },
    Command {
        id: "revisions",
        label: "Revisions",
        help: "List the revisions of the specification with its approvals; open or compare them.",
        keys: &["b"],
        in_menu: false,
        enabled: |app| has_server(app) && is_kept(app),
        run: |app| ask(app, KeepDialog::Revisions),
    },
    Command {
        id: "approve",
        label: "Approve",
        help: "Sign the present revision, so that robots are given it. Shows what differs from the approved one.",
        keys: &["q"],
        in_menu: false,
        enabled: |app| may_approve(app) && is_kept(app),
        run: |app| prepare(app, KeepDialog::Approve),
    },
    Command {
        id: "revoke",
        label: "Revoke the approval",
        help: "Take the approval back, so that robots are given nothing of this specification.",
        keys: &[],
        in_menu: false,
        enabled: |app| may_approve(app) && approved(app).is_some(),
        run: |app| {
            if let Some(number) = untrack(|| approved(app)) {
                keep(app, KeepAction::Prepare(number, KeepDialog::Revoke));
            }
        },
    },
    Command {
        id: "copy-link",
        label: "Copy link to this revision",
        help: "Copy an address that opens this revision.",
        keys: &[],
        in_menu: false,
        enabled: is_kept,
        run: |app| {
            if let Some(kept) = app.kept() {
                keep(app, KeepAction::CopyLink(kept.revision));
            }
        },
    },
    Command {
        id: "save-copy",
        label: "New copy on the server",
        help: "Keep the work as a specification of its own.",
        keys: &[],
        in_menu: false,
        enabled: |app| has_automaton(app) && may_save(app) && has_server(app),
        run: |app| keep(app, KeepAction::Copy),
    },
    Command {
        id: "delete-server",
        label: "Delete on the server",
        help: "Take the specification off the server; asks before.",
        keys: &[],
        in_menu: false,
        enabled: |app| may_save(app) && has_server(app) && is_kept(app),
        run: |app| ask(app, KeepDialog::Delete),
    },
    Command {
        id: "log-in",
        label: "Log in",
        help: "Show the server a token.",
        keys: &[],
        in_menu: false,
        enabled: |app| app.model.keeping.server.with(|it| *it == Server::Locked),
        run: |app| ask(app, KeepDialog::Login),
    },
];

fn keep(app: App, action: KeepAction) {
    app.act(Action::Keep(action));
}

fn ask(app: App, dialog: KeepDialog) {
    keep(app, KeepAction::Ask(dialog));
}

fn prepare(app: App, dialog: KeepDialog) {
    if let Some(kept) = app.kept() {
        keep(app, KeepAction::Prepare(kept.revision, dialog));
    }
}

fn has_server(app: App) -> bool {
    app.model.keeping.server.with(|server| matches!(server, Server::Present(_)))
}

/// Whether the work is a specification of the server.
pub(crate) fn is_kept(app: App) -> bool {
    app.derived.keeping.lineage.with(Option::is_some)
}

/// Whether who asks may save: without a server, in any case.
pub(crate) fn may_save(app: App) -> bool {
    role(app).is_none_or(|role| matches!(role, Role::Editor | Role::Approver))
}

/// Whether who asks may approve.
pub(crate) fn may_approve(app: App) -> bool {
    role(app) == Some(Role::Approver)
}

fn role(app: App) -> Option<Role> {
    app.model.keeping.server.with(|server| match server {
        Server::Present(session) => Some(session.role),
        Server::Asking | Server::Absent | Server::Locked => None,
    })
}

/// Number of the approved revision of the work.
fn approved(app: App) -> Option<u64> {
    app.derived.keeping.lineage.with(|lineage| lineage.as_ref()?.kept.approved)
}
