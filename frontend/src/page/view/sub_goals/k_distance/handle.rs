//! The handle on epsilon: dragged with a pointer or moved with keys, kept when it is let go of.

use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, HtmlElement, KeyboardEvent, PointerEvent};

use super::Tuned;
use crate::page::update::{Action, Tune};

/// How far a pointer moves before it is more than a click, in pixels.
const DRAG_DISTANCE: f64 = 3.0;
/// How many steps a larger step is.
const LARGER: f64 = 10.0;

/// A pointer is down on the handle.
#[derive(Clone, Copy)]
struct Press {
    /// Where it went down.
    at: f64,
    /// How far below the handle's line that was.
    below: f64,
    /// Whether it has moved more than a click does.
    begun: bool,
}

type Pressed = StoredValue<Option<Press>>;

/// The handle, over the whole width of its plot.
pub(super) fn handle(tuned: Tuned) -> impl IntoView {
    let pressed: Pressed = StoredValue::new(None);
    let height = move || tuned.scale.get().map_or(0.0, |scale| scale.height(tuned.epsilon.get()));
    let end =
        move |pick: fn((f64, f64)) -> f64| tuned.scale.get().map(|scale| pick(scale.ends()).to_string());
    let text = move || format!("{}{}", tuned.epsilon.get(), tuned.unit.get());
    let spoken = move || match tuned.core_text() {
        Some(core) => format!("{}, {core}", text()),
        None => text(),
    };
    // Whoever goes to another tab has not said that it is to be kept.
    on_cleanup(move || {
        if is_held(tuned) {
            act(tuned, Tune::Abort);
        }
    });
    view! {
        <div
            class="k-handle"
            class:high=move || { height() > 0.8 }
            role="slider"
            tabindex="0"
            aria-label=format!("epsilon of {}", tuned.name.get_value())
            aria-orientation="vertical"
            aria-valuenow=move || tuned.epsilon.get().to_string()
            aria-valuemin=move || end(|(low, _)| low)
            aria-valuemax=move || end(|(_, high)| high)
            aria-valuetext=spoken
            title="Drag, or use the arrow keys; with Shift the steps are larger"
            style:top=move || format!("{:.2}%", 100.0 * (1.0 - height()))
            on:pointerdown=move |event| down(pressed, &event)
            on:pointermove=move |event| shift(tuned, pressed, &event)
            on:pointerup=move |_| if pressed.try_update_value(Option::take).flatten().is_some() { act(tuned, Tune::Release) }
            on:pointercancel=move |_| abort(tuned, pressed)
            on:keydown=move |event| press(tuned, pressed, &event)
            on:blur=move |_| leave(tuned, pressed)
        >
            <span class="k-grip" aria-hidden="true"></span>
            <span class="k-value" aria-hidden="true">{text}</span>
        </div>
    }
}

fn act(tuned: Tuned, tune: Tune) {
    tuned.app.act(Action::Tune(tune));
}

/// Whether an epsilon is tried that was not let go of.
fn is_held(tuned: Tuned) -> bool {
    tuned.app.model.tuning.attempt.with_untracked(|it| it.as_ref().is_some_and(|it| !it.released))
}

fn abort(tuned: Tuned, pressed: Pressed) {
    pressed.set_value(None);
    act(tuned, Tune::Abort);
}

fn down(pressed: Pressed, event: &PointerEvent) {
    let Some(handle) = element(event).filter(|_| event.button() == 0) else { return };
    let rect = handle.get_bounding_client_rect();
    let at = f64::from(event.client_y());
    // Without it the drag just ends at the handle's border.
    let _ = handle.set_pointer_capture(event.pointer_id());
    // The keys that break a drag off go to whatever has the focus.
    let _ = handle.unchecked_ref::<HtmlElement>().focus();
    pressed.set_value(Some(Press { at, below: at - f64::midpoint(rect.top(), rect.bottom()), begun: false }));
}

fn shift(tuned: Tuned, pressed: Pressed, event: &PointerEvent) {
    let Some(press) = pressed.get_value() else { return };
    let at = f64::from(event.client_y());
    if !press.begun && (at - press.at).abs() < DRAG_DISTANCE {
        return;
    }
    pressed.set_value(Some(Press { begun: true, ..press }));
    let plot = element(event).and_then(|handle| handle.parent_element());
    let (Some(plot), Some(scale)) = (plot, tuned.scale.get_untracked()) else { return };
    let rect = plot.get_bounding_client_rect();
    let height = 1.0 - (at - press.below - rect.top()) / rect.height();
    try_epsilon(tuned, scale.value(height));
}

fn try_epsilon(tuned: Tuned, epsilon: f64) {
    if tuned.epsilon.get_untracked().total_cmp(&epsilon).is_ne() {
        act(tuned, Tune::To(epsilon));
    }
}

fn press(tuned: Tuned, pressed: Pressed, event: &KeyboardEvent) {
    if event.ctrl_key() || event.meta_key() || event.alt_key() {
        return;
    }
    let Some(scale) = tuned.scale.get_untracked() else { return };
    let epsilon = tuned.epsilon.get_untracked();
    let steps = if event.shift_key() { LARGER } else { 1.0 };
    match event.key().as_str() {
        "ArrowUp" | "ArrowRight" => try_epsilon(tuned, scale.step(epsilon, steps)),
        "ArrowDown" | "ArrowLeft" => try_epsilon(tuned, scale.step(epsilon, -steps)),
        "PageUp" => try_epsilon(tuned, scale.step(epsilon, LARGER)),
        "PageDown" => try_epsilon(tuned, scale.step(epsilon, -LARGER)),
        "Home" => try_epsilon(tuned, scale.ends().0),
        "End" => try_epsilon(tuned, scale.ends().1),
        "Enter" if is_held(tuned) => act(tuned, Tune::Release),
        "Escape" if is_held(tuned) || pressed.with_value(Option::is_some) => abort(tuned, pressed),
        _ => return,
    }
    event.prevent_default();
}

/// Whoever goes elsewhere keeps what was chosen with the keys, as in a field. Another window is not elsewhere.
fn leave(tuned: Tuned, pressed: Pressed) {
    let is_here = document().has_focus().unwrap_or(true);
    if is_here && pressed.with_value(Option::is_none) {
        act(tuned, Tune::Release);
    }
}

fn element(event: &PointerEvent) -> Option<Element> {
    event.current_target().map(JsCast::unchecked_into::<Element>)
}
