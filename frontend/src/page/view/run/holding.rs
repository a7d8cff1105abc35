//! What an executor holds, beside what is on display.

use goalgraph::history::History;
use goalgraph::protocol::monitor::{Answer, Held};
use leptos::prelude::*;

use crate::page::update::{Action, App, KeepAction};

/// The revision that it holds, what it answered, and how that differs from what is on display.
pub(super) fn holding(app: App, held: Option<Held>) -> AnyView {
    let Some(held) = held else {
        return view! { <p class="hint">"Holds no specification"</p> }.into_any();
    };
    let (verdict, class) = match &held.answer {
        Answer::Awaited => ("not answered yet".to_owned(), "tag"),
        Answer::Accepted => ("accepted".to_owned(), "tag good"),
        Answer::Rejected { reason } => (format!("rejected: {reason}"), "tag bad"),
    };
    let (name, number) = (held.name.clone(), held.revision);
    view! {
        <div class="held row">
            <span dir="auto">{name} " " <strong>{format!("r{number}")}</strong></span>
            <span class=class>{verdict}</span>
            {beside(app, held)}
        </div>
    }
    .into_any()
}

/// What is on display in place of what an executor holds, and the ways there.
fn beside(app: App, held: Held) -> impl IntoView {
    let number = held.revision;
    let sha256 = held.sha256.clone();
    let same =
        Memo::new(move |_| app.derived.watched.viewed_sha256.with(|viewed| viewed.as_ref() == Some(&sha256)));
    let id = held.specification.clone();
    let viewed = Memo::new(move |_| viewed(app, &id));
    move || {
        if same.get() {
            return view! { <span class="tag on-display">"on display"</span> }.into_any();
        }
        let id = held.specification.clone();
        let open = move |_| app.act(Action::Keep(KeepAction::Open(id.clone(), Some(number))));
        let (text, other) = match viewed.get() {
            Viewed::Nothing => ("nothing is open".to_owned(), None),
            Viewed::Other => ("you view something else".to_owned(), None),
            Viewed::Revision(viewed) => (format!("you view r{viewed}"), Some(viewed)),
            Viewed::Edited(viewed) => (format!("you view r{viewed} with edits"), Some(viewed)),
        };
        let difference = other.filter(|viewed| *viewed != number).map(|viewed| {
            let compare = move |_| app.act(Action::Keep(KeepAction::Compare(number, viewed)));
            let name = format!("Difference between r{number} and r{viewed}");
            view! { <button type="button" class="link" aria-label=name on:click=compare>"Difference"</button> }
        });
        view! {
            <span class="tag differs">{text}</span>
            <button type="button" class="link" on:click=open>{format!("Open r{number}")}</button>
            {difference}
        }
        .into_any()
    }
}

/// What is on display, beside a specification of the server.
#[derive(Clone, Copy, PartialEq)]
enum Viewed {
    Nothing,
    Other,
    Revision(u64),
    Edited(u64),
}

fn viewed(app: App, id: &str) -> Viewed {
    let Some(position) = app.model.history.with(|history| history.as_ref().map(History::position)) else {
        return Viewed::Nothing;
    };
    app.derived.keeping.lineage.with(|lineage| match lineage {
        Some(lineage) if lineage.kept.id == id => match lineage.revisions.get(&position) {
            Some(&number) => Viewed::Revision(number),
            None => Viewed::Edited(lineage.kept.revision),
        },
        _ => Viewed::Other,
    })
}
