//! The frame around the drawing: it hears the pointer and knows its size.

use leptos::html::Div;
use leptos::prelude::*;
use wasm_bindgen::prelude::*;
use web_sys::{Element, ResizeObserver};

use super::gesture::{self, Pressed};
use super::view_part::ViewPart;
use super::{canvas, minimap};
use crate::page::model::{Gesture, Tab};
use crate::page::update::App;
use crate::page::view::viewport::{fit, pan};

/// The frame with the drawing, what is painted below it, and the map over it.
pub(super) fn frame(app: App, part: Memo<ViewPart>, content: impl IntoView + 'static) -> impl IntoView {
    let node = NodeRef::<Div>::new();
    watch_size(app, node);
    let pressed: Pressed = StoredValue::new(None);
    let merging =
        move || app.model.gesture.with(|it| matches!(it, Some(Gesture::Drag { over: Some(_), .. })));
    view! {
        <div
            class="graph-frame"
            class:merging=merging
            class:walking=move || is_walking(app)
            node_ref=node
            on:pointerdown=move |event| gesture::down(app, pressed, &event)
            on:pointermove=move |event| gesture::shift(app, pressed, &event)
            on:pointerup=move |event| gesture::up(app, pressed, &event)
            on:pointercancel=move |_| gesture::abort(app, pressed)
            on:click:capture=move |event| gesture::click(app, pressed, &event)
            on:contextmenu=move |event| gesture::menu(app, &event)
            on:wheel=move |event| gesture::wheel(app, &event)
        >
            {canvas::canvas(app, part)}
            <svg class="graph" role="group" aria-label="Automaton" width="100%" height="100%">{content}</svg>
            {minimap::minimap(app)}
        </div>
    }
}

fn is_walking(app: App) -> bool {
    let running = app.model.tab.get() == Tab::Run && !app.derived.watched.monitoring.get();
    running && app.model.simulation.with(|walk| walk.on)
}

/// Keeps the frame's size in the model. A drawing that nobody has moved is fitted to it; another one keeps its middle.
fn watch_size(app: App, node: NodeRef<Div>) {
    let observer = StoredValue::new_local(None::<(ResizeObserver, Closure<dyn FnMut()>)>);
    Effect::new(move |_| {
        let Some(element) = node.get() else { return };
        let measured: Element = element.clone().into();
        let measure = Closure::<dyn FnMut()>::new(move || measure(app, &measured));
        if let Ok(watch) = ResizeObserver::new(measure.as_ref().unchecked_ref()) {
            watch.observe(&element);
            observer.set_value(Some((watch, measure)));
        }
    });
    on_cleanup(move || {
        observer
            .try_update_value(|observer| observer.take().iter().for_each(|(watch, _)| watch.disconnect()));
    });
}

fn measure(app: App, frame: &Element) {
    let size = (f64::from(frame.client_width()), f64::from(frame.client_height()));
    let before = app.model.frame.get_untracked();
    if before == size || size.0 <= 0.0 {
        return;
    }
    app.model.frame.set(size);
    if before.0 <= 0.0 || app.model.viewport.get_untracked().is_none() || app.model.fitted.get_untracked() {
        fit(app);
    } else {
        pan(app, (size.0 - before.0) / 2.0, (size.1 - before.1) / 2.0);
    }
}
