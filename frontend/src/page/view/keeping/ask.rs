//! Dialogs that ask for one thing: a token, a message, a yes.

use leptos::prelude::*;
use web_sys::SubmitEvent;

use super::{author_field, close, heading, refusal};
use crate::page::update::{Action, App, KeepAction};

/// Asks for a token. It goes to the server and nowhere else.
pub(super) fn login(app: App) -> impl IntoView {
    let token = RwSignal::new(String::new());
    let submit = move |event: SubmitEvent| {
        event.prevent_default();
        app.act(Action::Keep(KeepAction::LogIn(token.get_untracked())));
        token.set(String::new());
    };
    view! {
        {heading("Log in")}
        <form class="ask" on:submit=submit>
            <p class="hint">
                "This server asks for a token. Whoever runs it makes one with " <code>"goalgraph token create"</code> "."
            </p>
            <label class="field">
                "Token"
                <input
                    type="password"
                    name="token"
                    autocomplete="off"
                    autofocus
                    required
                    prop:value=move || token.get()
                    on:input=move |event| token.set(event_target_value(&event))
                />
            </label>
            {refusal(app)}
            <div class="row end-row"><button type="submit" class="button primary">"Log in"</button></div>
        </form>
    }
}

/// Asks what there is to say about a save.
pub(super) fn message(app: App) -> impl IntoView {
    let message = RwSignal::new(String::new());
    let submit = move |event: SubmitEvent| {
        event.prevent_default();
        app.act(Action::Keep(KeepAction::Save(message.get_untracked())));
    };
    view! {
        {heading("Save with a message")}
        <form class="ask" on:submit=submit>
            <label class="field">
                "Message"
                <input
                    type="text"
                    name="message"
                    maxlength="1000"
                    autofocus
                    placeholder="What is different, and why"
                    on:input=move |event| message.set(event_target_value(&event))
                />
            </label>
            {author_field(app)}
            <div class="row end-row"><button type="submit" class="button primary">"Save"</button></div>
        </form>
    }
}

/// Asks whether a specification is to go from the server.
pub(super) fn delete(app: App) -> impl IntoView {
    let name = app.derived.task_name.get_untracked();
    view! {
        {heading("Delete on the server")}
        <div class="ask">
            <p>
                {format!("{name} goes from the server, with all its revisions, for everybody. ")}
                "What is on this page stays here."
            </p>
            {refusal(app)}
            <div class="row end-row">
                <button type="button" class="button" autofocus on:click=move |_| close(app)>"Keep it"</button>
                <button type="button" class="button danger" on:click=move |_| app.act(Action::Keep(KeepAction::Delete))>
                    "Delete"
                </button>
            </div>
        </div>
    }
}
