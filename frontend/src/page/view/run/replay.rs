//! The slider over the events of a run.

use leptos::prelude::*;

use crate::page::clock;
use crate::page::commands::command;
use crate::page::keys::shown;
use crate::page::run_text;
use crate::page::update::{Action, App, WatchAction};
use crate::page::view::chips::{icon_button, short_button};

/// Paces, in events a second.
const PACES: [u32; 4] = [1, 2, 5, 20];

/// Play, slider, pace; for the run that is looked at.
pub(super) fn replay(app: App) -> impl IntoView {
    let watched = &app.derived.watched;
    let last = Memo::new(move |_| watched.run.with(|run| run.as_ref().map_or(0, |run| run.events)));
    let at = Memo::new(move |_| watched.shown.with(|run| run.as_ref().map_or(0, |run| run.events)));
    let slide = move |event: web_sys::Event| {
        if let Ok(number) = event_target_value(&event).parse() {
            app.act(Action::Watch(WatchAction::Replay(Some(number))));
        }
    };
    move || {
        (last.get() > 0).then(|| {
            view! {
                <div class="replay" role="group" aria-label="Replay">
                    {play(app)}
                    {icon_button(app, "replay-back", "‹")}
                    <input
                        type="range"
                        class="replay-slider"
                        min="0"
                        max=move || last.get().to_string()
                        step="1"
                        aria-label="Event"
                        aria-valuetext=move || spoken(app, at.get())
                        prop:value=move || at.get().to_string()
                        on:input=slide
                    />
                    {icon_button(app, "replay-on", "›")}
                    <span class="number replay-at">{move || format!("{} of {}", at.get(), last.get())}</span>
                    <span class="hint optional">{move || when(app, at.get())}</span>
                    {pace(app)}
                    {short_button(app, "replay-end", "Now")}
                </div>
            }
        })
    }
}

fn play(app: App) -> impl IntoView {
    let playing = move || app.model.watching.replay.get().is_some_and(|replay| replay.playing);
    command("replay").map(|command| {
        let keys = command.keys.first().map(|key| shown(key)).unwrap_or_default();
        view! {
            <button
                type="button"
                class="icon-button play"
                aria-label=move || if playing() { "Pause the replay" } else { "Play the replay" }
                title=format!("{} ({keys})", command.label)
                on:click=move |_| (command.run)(app)
            >
                <span aria-hidden="true">{move || if playing() { "❚❚" } else { "▶" }}</span>
            </button>
        }
    })
}

fn pace(app: App) -> impl IntoView {
    let choose = move |event: web_sys::Event| {
        if let Ok(pace) = event_target_value(&event).parse() {
            app.act(Action::Watch(WatchAction::Pace(pace)));
        }
    };
    let option = move |pace: u32| {
        view! {
            <option value=pace.to_string() prop:selected=move || app.model.watching.pace.get() == pace>{format!("{pace}/s")}</option>
        }
    };
    view! {
        <select class="pace" aria-label="Events a second" on:change=choose>{PACES.map(option).collect_view()}</select>
    }
}

/// What happened last, for a screen reader.
fn spoken(app: App, number: u64) -> String {
    let followed = app.derived.watched.followed.get();
    let specification = followed.as_ref().map(|it| &*it.specification);
    app.model.watching.log.with(|log| match log.up_to(number).last() {
        Some(event) => format!("{number}: {}", run_text::happened(specification, &event.happened)),
        None => format!("{number}"),
    })
}

fn when(app: App, number: u64) -> Option<String> {
    app.model.watching.log.with(|log| log.up_to(number).last().map(|event| clock::of(&event.stored_at)))
}
