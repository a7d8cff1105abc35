//! The revisions of the work and the journal of its approvals.

use goalgraph::protocol::api::{Approval, Decision, Revision};
use leptos::prelude::*;

use super::{heading, when, when_here};
use crate::page::commands::may_approve;
use crate::page::model::{KeepDialog, Kept};
use crate::page::update::{Action, App, KeepAction};
use crate::page::view::chips::button;

/// Both lists.
pub(super) fn revisions(app: App) -> impl IntoView {
    // The two revisions to compare: what was ticked first is let go of first.
    let ticked = RwSignal::new(Vec::<u64>::new());
    let compare = move |_| {
        let mut both = ticked.get_untracked();
        both.sort_unstable();
        if let [before, after] = both[..] {
            app.act(Action::Keep(KeepAction::Compare(before, after)));
        }
    };
    let name = app.derived.task_name.get_untracked();
    view! {
        {heading(format!("Revisions of {name}"))}
        <div class="row kept-actions">
            <button type="button" class="button" disabled=move || ticked.with(Vec::len) != 2 on:click=compare>
                "Compare the two ticked"
            </button>
            {button(app, "copy-link")} {button(app, "save-copy")} {button(app, "revoke")} {button(app, "delete-server")}
        </div>
        {move || when_here(app.model.keeping.revisions.get(), |all| table(app, ticked, all).into_any())}
        <h3>"Approvals"</h3>
        {move || when_here(app.model.keeping.approvals.get(), |all| journal(all).into_any())}
    }
}

fn table(app: App, ticked: RwSignal<Vec<u64>>, revisions: Vec<Revision>) -> impl IntoView {
    let kept = move || app.derived.keeping.lineage.with(|it| it.as_ref().map(|it| it.kept.clone()));
    let row = move |revision: Revision| row(app, ticked, kept().as_ref(), revision);
    view! {
        <table class="revisions">
            <thead>
                <tr>
                    <th scope="col"><span class="visually-hidden">"Compare"</span></th>
                    <th scope="col">"Revision"</th>
                    <th scope="col">"Who and when"</th>
                    <th scope="col">"Message"</th>
                    <th scope="col"><span class="visually-hidden">"Actions"</span></th>
                </tr>
            </thead>
            <tbody>{revisions.into_iter().map(row).collect_view()}</tbody>
        </table>
    }
}

fn row(
    app: App,
    ticked: RwSignal<Vec<u64>>,
    kept: Option<&Kept>,
    revision: Revision,
) -> impl IntoView + use<> {
    let Revision { number, name, author, message, saved_at, .. } = revision;
    let is_approved = kept.is_some_and(|kept| kept.approved == Some(number));
    let is_here = kept.is_some_and(|kept| kept.revision == number);
    let tick = move |event| {
        let on = event_target_checked(&event);
        ticked.update(|ticked| {
            ticked.retain(|it| *it != number);
            if on {
                ticked.push(number);
                if ticked.len() > 2 {
                    ticked.remove(0);
                }
            }
        });
    };
    let open = move |_| {
        if let Some(kept) = app.kept() {
            app.act(Action::Keep(KeepAction::Open(kept.id, Some(number))));
        }
    };
    let approve = move |_| app.act(Action::Keep(KeepAction::Prepare(number, KeepDialog::Approve)));
    let link = move |_| app.act(Action::Keep(KeepAction::CopyLink(number)));
    view! {
        <tr data-revision=number.to_string()>
            <td>
                <input
                    type="checkbox"
                    aria-label=format!("Compare revision {number}")
                    prop:checked=move || ticked.with(|it| it.contains(&number))
                    on:change=tick
                />
            </td>
            <th scope="row">
                <strong>{format!("r{number}")}</strong>
                {is_approved.then(|| view! { <span class="tag approved-tag">"✓ approved"</span> })}
                {is_here.then(|| view! { <span class="tag">"here"</span> })}
            </th>
            <td><span dir="auto">{author}</span> <span class="hint">{when(&saved_at)}</span></td>
            <td dir="auto" class="message">{if message.is_empty() { name } else { message }}</td>
            <td>
                <div class="row row-actions">
                    <button type="button" class="button small" aria-label=format!("Open revision {number}") on:click=open>"Open"</button>
                    <button type="button" class="button small" aria-label=format!("Copy link to revision {number}") on:click=link>"Link"</button>
                    {(may_approve(app) && !is_approved).then(|| view! {
                        <button type="button" class="button small" aria-label=format!("Approve revision {number}") on:click=approve>"Approve"</button>
                    })}
                </div>
            </td>
        </tr>
    }
}

/// Who approved what, newest first.
fn journal(approvals: Vec<Approval>) -> impl IntoView {
    if approvals.is_empty() {
        return view! { <p class="hint">"Nothing of this specification was approved yet."</p> }.into_any();
    }
    let row = |it: Approval| {
        let what = match it.decision {
            Decision::Approved => "approved",
            Decision::Revoked => "revoked",
        };
        let comment =
            (!it.comment.is_empty()).then(|| view! { <p class="comment" dir="auto">{it.comment}</p> });
        view! {
            <li>
                <p>
                    <strong>{format!("r{} {what}", it.revision)}</strong> " by " <span dir="auto">{it.who}</span> ": "
                    <span dir="auto">{it.meaning}</span> <span class="hint">{when(&it.at)}</span>
                </p>
                {comment}
            </li>
        }
    };
    view! { <ol class="journal" aria-label="Approvals">{approvals.into_iter().map(row).collect_view()}</ol> }
        .into_any()
}
