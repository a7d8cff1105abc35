//! The events of the run: filtered, and only those in view are elements, so that thousands are no burden.

use leptos::html::Div;
use leptos::prelude::*;

use super::log_row::{ROW, row};
use crate::page::model::{EventFilter, EventKind};
use crate::page::text::count;
use crate::page::update::{Action, App, WatchAction};

/// How many rows above and below those in view are there as well.
const MARGIN: usize = 6;

/// The filter and the list.
pub(super) fn log(app: App) -> impl IntoView {
    let known = move || app.model.watching.log.with(|log| log.events.len());
    let listed = app.derived.watched.listed;
    let size = move || {
        let (shown, all) = (listed.with(Vec::len), known());
        if shown == all { count(all, "event") } else { format!("{shown} of {}", count(all, "event")) }
    };
    let failed = move || app.model.watching.log.with(|log| log.failed.clone());
    view! {
        <header class="section-head">
            <h2>"Events"</h2>
            <span class="hint">{size}</span>
        </header>
        {filter(app)}
        {move || failed().map(|reason| view! { <p class="refusal">{format!("No more events: {reason}.")}</p> })}
        {list(app)}
    }
}

fn filter(app: App) -> impl IntoView {
    let watching = &app.model.watching;
    let change = move |edit: &dyn Fn(&mut EventFilter)| {
        let mut filter = watching.filter.get_untracked();
        edit(&mut filter);
        app.act(Action::Watch(WatchAction::Filter(filter)));
    };
    let choose = move |event: web_sys::Event| {
        let name = event_target_value(&event);
        let kind = EventKind::ALL.into_iter().find(|kind| kind.name() == name);
        change(&|filter| filter.kind = kind);
    };
    let write = move |event: web_sys::Event| {
        let text = event_target_value(&event);
        change(&|filter| filter.text.clone_from(&text));
    };
    let option = move |kind: EventKind| {
        let selected = move || watching.filter.with(|filter| filter.kind == Some(kind));
        view! { <option value=kind.name() prop:selected=selected>{kind.name()}</option> }
    };
    view! {
        <div class="row log-filter">
            <select aria-label="Kind of event" on:change=choose>
                <option value="">"All kinds"</option>
                {EventKind::ALL.map(option).collect_view()}
            </select>
            <input
                type="search"
                class="grow"
                placeholder="Filter"
                aria-label="Filter events by text"
                prop:value=move || watching.filter.with(|filter| filter.text.clone())
                on:input=write
            />
        </div>
    }
}

/// The rows. It follows the newest unless somebody has scrolled up.
fn list(app: App) -> impl IntoView {
    let node = NodeRef::<Div>::new();
    let listed = app.derived.watched.listed;
    let top = RwSignal::new(0.0_f64);
    let height = RwSignal::new(0.0_f64);
    let follows = RwSignal::new(true);
    let scrolled = move |_| {
        let Some(list) = node.get_untracked() else { return };
        let (from, view) = (f64::from(list.scroll_top()), f64::from(list.client_height()));
        top.set(from);
        height.set(view);
        follows.set(from + view >= f64::from(list.scroll_height()) - ROW / 2.0);
    };
    let scroll_to = move |place: f64| {
        request_animation_frame(move || {
            if let Some(list) = node.get_untracked() {
                list.set_scroll_top(place as i32);
                height.set(f64::from(list.client_height()));
            }
        });
    };
    Effect::new(move |_| {
        let number = listed.with(Vec::len);
        node.track();
        if follows.get_untracked() && app.model.watching.replay.get_untracked().is_none() {
            scroll_to(number as f64 * ROW);
        }
    });
    Effect::new(move |_| {
        let Some(replay) = app.model.watching.replay.get() else { return };
        let place = app.model.watching.log.with_untracked(|log| {
            let is_before = |index: &usize| log.events[*index].number < replay.at;
            listed.with_untracked(|listed| listed.partition_point(is_before))
        });
        let (place, view) = (place as f64 * ROW, height.get_untracked());
        let seen = top.get_untracked()..(top.get_untracked() + view - ROW);
        if !seen.contains(&place) {
            scroll_to((place - view / 2.0).max(0.0));
        }
    });
    let rows = Memo::new(move |_| {
        let first = ((top.get() / ROW) as usize).saturating_sub(MARGIN);
        let number = (height.get().max(ROW) / ROW).ceil() as usize + 2 * MARGIN;
        let part = |listed: &Vec<usize>| {
            listed.iter().copied().enumerate().skip(first).take(number).collect::<Vec<_>>()
        };
        listed.with(part)
    });
    let whole = move || format!("{}px", listed.with(Vec::len) as f64 * ROW);
    let newest = move |_| {
        follows.set(true);
        app.act(Action::Watch(WatchAction::Replay(None)));
        scroll_to(listed.with_untracked(Vec::len) as f64 * ROW);
    };
    view! {
        <div class="log-frame">
            <div class="log" role="list" aria-label="Events" tabindex="0" node_ref=node on:scroll=scrolled>
                <div class="log-space" role="presentation" style:height=whole>
                    <For
                        each=move || rows.get()
                        key=move |row| (app.model.watching.log.with_untracked(|log| log.run.clone()), *row)
                        children=move |(place, index)| row(app, place, index)
                    />
                </div>
            </div>
            {move || (!follows.get()).then(|| view! {
                <button type="button" class="button small to-newest" on:click=newest>"Newest ↓"</button>
            })}
        </div>
    }
}
