//! A map of a large automaton: where one is, and where to go.

use goalgraph::layout::Rect;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, PointerEvent};

use crate::page::update::App;
use crate::page::view::viewport::pan;

/// From so many states on there is a map.
const FROM_STATES: usize = 40;
/// Width and height of the map at most, in pixels.
const SIZE: (f64, f64) = (180.0, 120.0);

/// The map, where one is needed. Pressing a place in it goes there.
pub(super) fn minimap(app: App) -> impl IntoView {
    let needed = Memo::new(move |_| {
        app.derived.picture.with(|it| it.as_ref().is_some_and(|it| it.layout.nodes.len() >= FROM_STATES))
    });
    move || needed.get().then(|| map(app))
}

fn map(app: App) -> impl IntoView {
    let scale = move || {
        app.derived.picture.with(|picture| {
            let bounds = picture.as_ref().map(|it| it.bounds());
            bounds.map_or(1.0, |it| (SIZE.0 / width(&it).max(1.0)).min(SIZE.1 / height(&it).max(1.0)))
        })
    };
    let bounds = move || app.derived.picture.with(|it| it.as_ref().map(|it| it.bounds()));
    let view_box = move || {
        let it = bounds()?;
        Some(format!("{:.1} {:.1} {:.1} {:.1}", it.left, it.top, width(&it).max(1.0), height(&it).max(1.0)))
    };
    let size = move || bounds().map_or(SIZE, |it| (width(&it) * scale(), height(&it) * scale()));
    let states = move || {
        let picture = app.derived.picture.get()?;
        let dot = |rect: &Rect| {
            format!(
                "M{:.0} {:.0}h{:.0}v{:.0}h{:.0}z",
                rect.left,
                rect.top,
                width(rect),
                height(rect),
                -width(rect)
            )
        };
        Some(picture.states().map(|(_, rect)| dot(&rect)).collect::<String>())
    };
    let shown = move || {
        let rect = app.model.viewport.get()?.shown(app.model.frame.get());
        let d = (rect.left, rect.top, width(&rect), height(&rect));
        Some(format!("M{:.0} {:.0}h{:.0}v{:.0}h{:.0}z", d.0, d.1, d.2, d.3, -d.2))
    };
    let go = move |event: PointerEvent| {
        if event.buttons() & 1 == 0 {
            return;
        }
        event.stop_propagation();
        go(app, &event, scale());
    };
    view! {
        <svg
            class="minimap"
            aria-label="Map of the automaton"
            role="img"
            viewBox=view_box
            width=move || format!("{:.0}", size().0)
            height=move || format!("{:.0}", size().1)
            on:pointerdown=go
            on:pointermove=go
        >
            <path class="map-states" d=states />
            <path class="map-frame" d=shown />
        </svg>
    }
}

fn width(rect: &Rect) -> f64 {
    rect.right - rect.left
}

fn height(rect: &Rect) -> f64 {
    rect.bottom - rect.top
}

/// Brings the pressed place of the map into the middle of the frame.
fn go(app: App, event: &PointerEvent, scale: f64) {
    let Some(map) = event.current_target().map(JsCast::unchecked_into::<Element>) else { return };
    let (Some(viewport), Some(picture)) =
        (app.model.viewport.get_untracked(), app.derived.picture.get_untracked())
    else {
        return;
    };
    let rect = map.get_bounding_client_rect();
    let bounds = picture.bounds();
    let x = bounds.left + (f64::from(event.client_x()) - rect.left()) / scale;
    let y = bounds.top + (f64::from(event.client_y()) - rect.top()) / scale;
    let frame = app.model.frame.get_untracked();
    pan(
        app,
        frame.0 / 2.0 - (x * viewport.scale + viewport.x),
        frame.1 / 2.0 - (y * viewport.scale + viewport.y),
    );
}
