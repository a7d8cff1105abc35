//! Somebody else saved meanwhile: what is done about it.

use goalgraph::protocol::api::Revision;
use leptos::prelude::*;

use super::{heading, when};
use crate::page::update::{Action, App, Choice, KeepAction};

/// Who saved what, and the ways out.
pub(super) fn conflict(app: App) -> impl IntoView {
    move || {
        let head = app.model.keeping.conflict.get()?;
        let base = app.kept().map(|kept| format!("You began with revision {}. ", kept.revision));
        let message = (!head.message.is_empty())
            .then(|| view! { <blockquote dir="auto">{head.message.clone()}</blockquote> });
        let sentence = format!("{} saved revision {} at {}.", head.author, head.number, when(&head.saved_at));
        Some(view! {
            {heading("Somebody else saved meanwhile")}
            <div class="ask">
                <p>{base} <strong dir="auto">{sentence}</strong></p>
                {message}
                <p class="hint">"Your work is not on the server yet. Whichever way you choose, nothing is lost."</p>
                {ways(app, &head, true)}
            </div>
        })
    }
}

/// The ways out, each with what it does.
pub(super) fn ways(app: App, head: &Revision, see: bool) -> impl IntoView + use<> {
    let choose = move |choice: Choice| app.act(Action::Keep(KeepAction::Choose(choice)));
    let (theirs, other) = (head.clone(), head.clone());
    let number = head.number;
    view! {
        <ul class="ways-out">
            {see.then(|| view! {
                <li>
                    <button type="button" class="button primary" on:click=move |_| choose(Choice::See(theirs.clone()))>
                        "See what differs"
                    </button>
                    <span class="hint">{format!("Your work and revision {number} on one canvas; then decide.")}</span>
                </li>
            })}
            <li>
                <button type="button" class="button" on:click=move |_| choose(Choice::KeepMine)>"Keep mine as a copy"</button>
                <span class="hint">"A specification of its own on the server; theirs stays as it is."</span>
            </li>
            <li>
                <button type="button" class="button" on:click=move |_| choose(Choice::TakeTheirs(other.clone()))>"Take theirs"</button>
                <span class="hint">"Theirs takes the place of yours here, as a step; Ctrl+Z brings yours back."</span>
            </li>
        </ul>
    }
}
