//! Approving a revision, and taking an approval back.

use goalgraph::protocol::api::Decision;
use goalgraph::specification::{Problem, Severity};
use leptos::prelude::*;

use super::difference::compared;
use super::sign::form;
use super::{heading, when, when_here};
use crate::page::model::Signing;
use crate::page::text::count;
use crate::page::update::App;
use crate::page::view::chips::button;

/// What is to be approved beside what is, and the signature.
pub(super) fn approve(app: App) -> impl IntoView {
    move || when_here(app.model.keeping.signing.get(), |signing| approval(app, signing).into_any())
}

fn approval(app: App, signing: Signing) -> impl IntoView {
    let (number, approved) = (signing.revision.number, signing.approved);
    let problems = signing.specification.check();
    let errors = problems.iter().filter(|it| it.severity == Severity::Error).count();
    let saved = format!("{} · {}", signing.revision.author, when(&signing.revision.saved_at));
    let reason = move || {
        let here =
            app.derived.keeping.lineage.with(|it| it.as_ref().is_some_and(|it| it.kept.revision == number));
        if errors > 0 {
            Some(format!("A robot must not be given this: {} to correct first.", count(errors, "error")))
        } else if here && is_changed(app) {
            Some("Save your edits first: only what is saved can be approved.".to_owned())
        } else if approved == Some(number) {
            Some("This revision is approved already.".to_owned())
        } else {
            None
        }
    };
    let unsaved = move || errors == 0 && is_changed(app);
    view! {
        {heading(format!("Approve revision {number}"))}
        <p class="hint" dir="auto">{saved}</p>
        {move || compared(app)}
        {findings(&problems)}
        {move || unsaved().then(|| save_first(app))}
        {move || form(app, signing.clone(), Decision::Approved, reason())}
    }
}

fn is_changed(app: App) -> bool {
    app.derived.keeping.has_unsaved.get()
}

/// Edits that are not saved are not what would be approved: this saves them and comes back.
fn save_first(app: App) -> impl IntoView {
    view! {
        <div class="row">
            <p>"There are edits that are not saved."</p>
            {button(app, "save")}
        </div>
    }
}

/// What is wrong with it, the errors first.
fn findings(problems: &[Problem]) -> impl IntoView + use<> {
    if problems.is_empty() {
        return view! { <p class="fits">"The check finds nothing wrong."</p> }.into_any();
    }
    let row = |problem: &Problem| {
        let error = problem.severity == Severity::Error;
        view! {
            <li class="finding" class:error=error>
                <strong>{if error { "Error" } else { "Warning" }}</strong> " "
                {format!("{}: {}", problem.place(), problem.message)}
            </li>
        }
    };
    let rows = problems.iter().take(20).map(row).collect_view();
    view! { <section class="findings" aria-label="Findings of the check"><h3>"Findings of the check"</h3> <ul>{rows}</ul></section> }.into_any()
}

/// Taking an approval back.
pub(super) fn revoke(app: App) -> impl IntoView {
    move || {
        when_here(app.model.keeping.signing.get(), |signing| {
            let number = signing.revision.number;
            view! {
                {heading(format!("Revoke the approval of revision {number}"))}
                <p>"From then on robots are given nothing of this specification."</p>
                {form(app, signing, Decision::Revoked, None)}
            }
            .into_any()
        })
    }
}
