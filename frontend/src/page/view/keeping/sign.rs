//! The form of a signature: who, what it means, a comment.

use goalgraph::protocol::api::{Decision, Signature};
use leptos::prelude::*;
use web_sys::SubmitEvent;

use super::{author_field, refusal};
use crate::page::model::{Server, Signing};
use crate::page::update::{Action, App, KeepAction};

/// What signatures usually mean.
const MEANINGS: [&str; 3] = ["Approved for production", "Approved for trials", "Reviewed and approved"];

/// The form for `signing`; `reason` is why it cannot be signed.
pub(super) fn form(app: App, signing: Signing, decision: Decision, reason: Option<String>) -> impl IntoView {
    let usual = match decision {
        Decision::Approved => MEANINGS[0],
        Decision::Revoked => "Withdrawn from use",
    };
    let (meaning, comment) = (RwSignal::new(usual.to_owned()), RwSignal::new(String::new()));
    let number = signing.revision.number;
    let nameless = move || {
        let token = app
            .model
            .keeping
            .server
            .with(|it| matches!(it, Server::Present(session) if session.name.is_some()));
        !token && app.model.keeping.author.with(|author| author.trim().is_empty())
    };
    let submit = move |event: SubmitEvent| {
        event.prevent_default();
        let signature = Signature {
            who: Some(app.model.keeping.author.get_untracked()).filter(|who| !who.trim().is_empty()),
            meaning: meaning.get_untracked(),
            comment: comment.get_untracked(),
            sha256: signing.revision.sha256.clone(),
            instead_of: signing.approved,
        };
        app.act(Action::Keep(KeepAction::Sign { revision: number, decision, signature }));
    };
    let blocked = reason.is_some();
    let label = match decision {
        Decision::Approved => format!("Approve r{number}"),
        Decision::Revoked => format!("Revoke r{number}"),
    };
    let options = MEANINGS.map(|meaning| view! { <option value=meaning></option> });
    view! {
        <form class="ask sign" on:submit=submit>
            <div class="sign-fields">
                {author_field(app)}
                <label class="field">
                    "Meaning of the signature"
                    <input
                        type="text"
                        name="meaning"
                        list="meanings"
                        maxlength="200"
                        required
                        prop:value=move || meaning.get()
                        on:input=move |event| meaning.set(event_target_value(&event))
                    />
                    <datalist id="meanings">{options.collect_view()}</datalist>
                </label>
                <label class="field">
                    "Comment"
                    <input type="text" name="comment" maxlength="1000" on:input=move |event| comment.set(event_target_value(&event)) />
                </label>
            </div>
            {refusal(app)}
            <div class="row end-row">
                {reason.map(|reason| view! { <p class="refusal" id="no-signature">{reason}</p> })}
                {move || (nameless() && !blocked).then(|| view! { <p class="hint">"Sign with your name."</p> })}
                <button
                    type="submit"
                    class="button primary"
                    disabled=move || blocked || nameless()
                    aria-describedby=blocked.then_some("no-signature")
                >
                    {label}
                </button>
            </div>
        </form>
    }
}
