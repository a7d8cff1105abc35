//! How a drawing lies in its frame: pan by dragging, zoom at the pointer, fit.

use leptos::html::Div;
use leptos::prelude::*;
use wasm_bindgen::prelude::*;
use web_sys::{Element, PointerEvent, ResizeObserver, WheelEvent};

use crate::page::model::Viewport;
use crate::page::update::{Action, App};

/// How much one step of a key zooms.
pub(crate) const ZOOM_STEP: f64 = 1.25;
const SCALES: std::ops::RangeInclusive<f64> = 0.05..=4.0;
/// Small graphs are not blown up further than this.
const LARGEST_FIT: f64 = 1.4;
const MARGIN: f64 = 28.0;
/// A pointer that moves less is a click.
const DRAG_DISTANCE: f64 = 4.0;

/// Shows the whole drawing.
pub(crate) fn fit(app: App) {
    let (width, height) = app.model.frame.get_untracked();
    let Some(placement) = app.derived.placement.get_untracked().filter(|_| width > 0.0 && height > 0.0)
    else {
        return app.model.viewport.set(None);
    };
    let room = |length: f64| (length - 2.0 * MARGIN).max(1.0);
    let scale = (room(width) / placement.width.max(1.0)).min(room(height) / placement.height.max(1.0));
    let scale = scale.clamp(*SCALES.start(), LARGEST_FIT);
    let x = (width - placement.width * scale) / 2.0;
    let y = (height - placement.height * scale) / 2.0;
    app.model.viewport.set(Some(Viewport { scale, x, y }));
}

/// Brings a place of the drawing into the frame when it is outside, so that what has the focus is seen.
pub(crate) fn reveal(app: App, (x, y): (f64, f64)) {
    let (width, height) = app.model.frame.get_untracked();
    let Some(viewport) = app.model.viewport.get_untracked() else { return };
    let inside = |place: f64, length: f64| (MARGIN..=length - MARGIN).contains(&place);
    let (left, top) = (x * viewport.scale + viewport.x, y * viewport.scale + viewport.y);
    if !inside(left, width) || !inside(top, height) {
        let (x, y) = (viewport.x + width / 2.0 - left, viewport.y + height / 2.0 - top);
        app.model.viewport.set(Some(Viewport { x, y, ..viewport }));
    }
}

/// Zooms at the middle of the frame.
pub(crate) fn zoom(app: App, factor: f64) {
    let (width, height) = app.model.frame.get_untracked();
    zoom_at(app, factor, (width / 2.0, height / 2.0));
}

/// Zooms so that what is at a point of the frame stays there.
fn zoom_at(app: App, factor: f64, (x, y): (f64, f64)) {
    app.model.viewport.update(|viewport| {
        let Some(viewport) = viewport else { return };
        let scale = (viewport.scale * factor).clamp(*SCALES.start(), *SCALES.end());
        let factor = scale / viewport.scale;
        *viewport = Viewport { scale, x: x - (x - viewport.x) * factor, y: y - (y - viewport.y) * factor };
    });
}

/// The frame around a drawing.
pub(crate) fn frame(app: App, content: impl IntoView + 'static) -> impl IntoView {
    let node = NodeRef::<Div>::new();
    watch_size(app, node);
    let drag = StoredValue::new(None::<Drag>);
    let down = move |event: PointerEvent| {
        if event.button() == 0 || event.button() == 1 {
            drag.set_value(Some(Drag { last: place_of(&event), moved: 0.0 }));
        }
    };
    let shift = move |event: PointerEvent| pan(app, drag, &event);
    let up = move |_| {
        let dragged = drag.get_value().is_some_and(|drag| drag.moved >= DRAG_DISTANCE);
        // The click that ends a drag is none: it comes right after this event.
        drag.set_value(dragged.then_some(Drag { last: (f64::NAN, f64::NAN), moved: DRAG_DISTANCE }));
    };
    let click = move |event: web_sys::MouseEvent| {
        if drag.get_value().is_some() {
            drag.set_value(None);
            event.stop_propagation();
        } else if is_background(&event) {
            app.act(Action::Select(None));
        }
    };
    view! {
        <div
            class="graph-frame"
            node_ref=node
            on:pointerdown=down
            on:pointermove=shift
            on:pointerup=up
            on:pointerleave=move |_| drag.set_value(None)
            on:click:capture=click
            on:wheel=move |event| wheel(app, &event)
        >
            <svg class="graph" role="group" aria-label="Automaton" width="100%" height="100%">{content}</svg>
        </div>
    }
}

/// A pointer that is held down.
#[derive(Clone, Copy)]
struct Drag {
    last: (f64, f64),
    moved: f64,
}

fn place_of(event: &PointerEvent) -> (f64, f64) {
    (f64::from(event.client_x()), f64::from(event.client_y()))
}

fn pan(app: App, drag: StoredValue<Option<Drag>>, event: &PointerEvent) {
    let Some(Drag { last, moved }) = drag.get_value().filter(|_| event.buttons() != 0) else { return };
    let place = place_of(event);
    let (dx, dy) = (place.0 - last.0, place.1 - last.1);
    let moved = moved + dx.abs() + dy.abs();
    drag.set_value(Some(Drag { last: place, moved }));
    app.model.viewport.update(|viewport| {
        if let Some(viewport) = viewport {
            viewport.x += dx;
            viewport.y += dy;
        }
    });
}

fn wheel(app: App, event: &WheelEvent) {
    event.prevent_default();
    let Some(frame) = event.current_target().map(JsCast::unchecked_into::<Element>) else { return };
    let rect = frame.get_bounding_client_rect();
    let place = (f64::from(event.client_x()) - rect.left(), f64::from(event.client_y()) - rect.top());
    let pixels = if event.delta_mode() == WheelEvent::DOM_DELTA_LINE { 16.0 } else { 1.0 };
    zoom_at(app, (-event.delta_y() * pixels * 0.0015).exp(), place);
}

/// Keeps the frame's size in the model; a drawing that was never fitted is fitted once there is a size.
fn watch_size(app: App, node: NodeRef<Div>) {
    let observer = StoredValue::new_local(None::<(ResizeObserver, Closure<dyn FnMut()>)>);
    Effect::new(move |_| {
        let Some(element) = node.get() else { return };
        let measured = element.clone();
        let measure = Closure::<dyn FnMut()>::new(move || {
            let (width, height) = (f64::from(measured.client_width()), f64::from(measured.client_height()));
            if app.model.frame.get_untracked() != (width, height) && width > 0.0 {
                app.model.frame.set((width, height));
                fit(app);
            }
        });
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

/// Whether the pointer is on the background.
fn is_background(event: &web_sys::MouseEvent) -> bool {
    let element = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    element.is_some_and(|element| element.get_attribute("class").as_deref() == Some("graph"))
}
