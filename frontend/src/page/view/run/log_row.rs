//! One event in the list.

use goalgraph::run::RunEvent;
use leptos::prelude::*;

use crate::page::clock;
use crate::page::run_text::happened;
use crate::page::update::{Action, App, WatchAction};

/// How high a row is, in pixels.
pub(super) const ROW: f64 = 52.0;

/// The event at `index` of the log, at `place` in the list.
pub(super) fn row(app: App, place: usize, index: usize) -> impl IntoView {
    let event = app.model.watching.log.with_untracked(|log| log.events.get(index).cloned());
    let top = format!("{}px", place as f64 * ROW);
    event.map(|event| {
        let (number, time) = (event.number, clock::of(&event.stored_at));
        let class = format!("event {}", class(&event.happened));
        let size = move || app.derived.watched.listed.with(Vec::len).to_string();
        let shown = move || app.derived.watched.shown.with(|run| run.as_ref().map_or(0, |it| it.events));
        let sentence = Memo::new(move |_| {
            let followed = app.derived.watched.followed.get();
            happened(followed.as_ref().map(|it| &*it.specification), &event.happened)
        });
        view! {
            <div class="log-row" role="listitem" aria-setsize=size aria-posinset=(place + 1).to_string() style:top=top>
                <button
                    type="button"
                    class=class
                    class:later=move || shown() < number
                    data-event=number.to_string()
                    aria-current=move || (shown() == number).then_some("true")
                    title=move || sentence.get()
                    on:click=move |_| app.act(Action::Watch(WatchAction::Replay(Some(number))))
                >
                    <span class="event-head"><span class="number">{number}</span> <time>{time}</time></span>
                    <span class="event-text" dir="auto">{move || sentence.get()}</span>
                </button>
            </div>
        }
    })
}

/// What stands out.
fn class(event: &RunEvent) -> &'static str {
    match event {
        RunEvent::Replanned { .. } => "replan",
        RunEvent::Unavailable { .. } | RunEvent::Waiting { .. } => "outage",
        RunEvent::Failed { .. } => "failure",
        RunEvent::Finished => "finish",
        _ => "",
    }
}
