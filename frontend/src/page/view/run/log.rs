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

/// The rows that are in view.
fn list(app: App) -> impl IntoView {
    let scroll = Scroll::new();
    let listed = app.derived.watched.listed;
    follow_newest(app, scroll);
    follow_replay(app, scroll);
    let rows = Memo::new(move |_| listed.with(|listed| scroll.in_view(listed)));
    let whole = move || format!("{}px", listed.with(Vec::len) as f64 * ROW);
    let newest = move |_| {
        app.act(Action::Watch(WatchAction::Replay(None)));
        scroll.follows.set(true);
        scroll.go(listed.with_untracked(Vec::len) as f64 * ROW);
    };
    view! {
        <div class="log-frame">
            <div class="log" role="list" aria-label="Events" tabindex="0" node_ref=scroll.node on:scroll=move |_| scroll.read()>
                <div class="log-space" role="presentation" style:height=whole>
                    <For
                        each=move || rows.get()
                        key=move |row| (app.model.watching.log.with_untracked(|log| log.run.clone()), *row)
                        children=move |(place, index)| row(app, place, index)
                    />
                </div>
            </div>
            {move || (!scroll.follows.get()).then(|| view! {
                <button type="button" class="button small to-newest" on:click=newest>"Newest ↓"</button>
            })}
        </div>
    }
}

/// The newest stays in view unless somebody has scrolled up.
fn follow_newest(app: App, scroll: Scroll) {
    let listed = app.derived.watched.listed;
    Effect::new(move |_| {
        let number = listed.with(Vec::len);
        scroll.node.track();
        if scroll.follows.get_untracked() && app.model.watching.replay.get_untracked().is_none() {
            scroll.go(number as f64 * ROW);
        }
    });
}

/// The event of the replay comes into view.
fn follow_replay(app: App, scroll: Scroll) {
    Effect::new(move |_| {
        let Some(replay) = app.model.watching.replay.get() else { return };
        let place = app.model.watching.log.with_untracked(|log| {
            let is_before = |index: &usize| log.events.get(*index).is_some_and(|it| it.number < replay.at);
            app.derived.watched.listed.with_untracked(|listed| listed.partition_point(is_before))
        });
        scroll.show(place as f64 * ROW);
    });
}

/// How the list is scrolled, as the browser says.
#[derive(Clone, Copy)]
struct Scroll {
    node: NodeRef<Div>,
    top: RwSignal<f64>,
    height: RwSignal<f64>,
    /// Whether the end is in view.
    follows: RwSignal<bool>,
}

impl Scroll {
    fn new() -> Self {
        let (top, height) = (RwSignal::default(), RwSignal::default());
        Self { node: NodeRef::new(), top, height, follows: RwSignal::new(true) }
    }

    fn read(self) {
        let Some(list) = self.node.get_untracked() else { return };
        let (top, height) = (f64::from(list.scroll_top()), f64::from(list.client_height()));
        self.top.set(top);
        self.height.set(height);
        self.follows.set(top + height >= f64::from(list.scroll_height()) - ROW / 2.0);
    }

    /// Scrolls once what was added is there; by then the list itself may be gone.
    fn go(self, place: f64) {
        request_animation_frame(move || {
            if let Some(list) = self.node.try_get_untracked().flatten() {
                list.set_scroll_top(place as i32);
                let _ = self.height.try_set(f64::from(list.client_height()));
            }
        });
    }

    /// Scrolls only when the row at `place` is out of view.
    fn show(self, place: f64) {
        let (top, height) = (self.top.get_untracked(), self.height.get_untracked());
        if place < top || place + ROW > top + height {
            self.go((place - height / 2.0).max(0.0));
        }
    }

    /// Positions of the rows in view and a few around them, each with what is listed there.
    fn in_view(self, listed: &[usize]) -> Vec<(usize, usize)> {
        let first = ((self.top.get() / ROW) as usize).saturating_sub(MARGIN);
        let number = (self.height.get().max(ROW) / ROW).ceil() as usize + 2 * MARGIN;
        listed.iter().copied().enumerate().skip(first).take(number).collect()
    }
}
