//! What a pointer does in the drawing: pan, drag states, draw a rectangle, lead an arrow.
//!
//! A pointer that moves less than [`DRAG_DISTANCE`] is a click and none of these.

use std::collections::BTreeMap;

use goalgraph::edit::Edit;
use goalgraph::layout::Point;
use goalgraph::pdfa::{StateId, Symbol};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, MouseEvent, PointerEvent, WheelEvent};

use crate::page::model::{Gesture, Menu, MenuContent, Selection, Tab};
use crate::page::update::{Action, App};
use crate::page::view::viewport::{pan, zoom_at};

/// How far a pointer moves before it is more than a click, in pixels.
const DRAG_DISTANCE: f64 = 4.0;

/// The pointer went down, and has not moved far yet.
#[derive(Clone, Debug)]
pub(super) struct Press {
    at: Point,
    gesture: Gesture,
    begun: bool,
}

pub(super) type Pressed = StoredValue<Option<Press>>;

/// The pointer goes down.
pub(super) fn down(app: App, pressed: Pressed, event: &PointerEvent) {
    let at = place_in_frame(event);
    let editing = app.model.tab.get_untracked() == Tab::Automaton;
    let gesture = match (event.button(), on(app, event)) {
        (0, _) if !editing => Gesture::Pan { last: at },
        (0, On::Handle(source, symbol)) => Gesture::Connect { source, symbol, to: at, over: None },
        (0, On::State(id)) => Gesture::Drag { from: at, origins: origins(app, id), over: None },
        (0, On::Background) if event.shift_key() => Gesture::Marquee { from: at, to: at },
        (1, _) | (0, On::Background | On::Transition(..)) => Gesture::Pan { last: at },
        _ => return,
    };
    app.act(Action::Menu(None));
    pressed.set_value(Some(Press { at, gesture, begun: false }));
}

/// The pointer moves.
pub(super) fn shift(app: App, pressed: Pressed, event: &PointerEvent) {
    let Some(mut press) = pressed.get_value().filter(|_| event.buttons() != 0) else { return };
    let at = place_in_frame(event);
    if !press.begun {
        if (at.x - press.at.x).abs() + (at.y - press.at.y).abs() < DRAG_DISTANCE {
            return;
        }
        press.begun = true;
        app.model.gesture.set(Some(press.gesture.clone()));
        if let Some(frame) = frame_of(event) {
            // Without it the gesture just ends at the frame's border.
            let _ = frame.set_pointer_capture(event.pointer_id());
        }
        pressed.set_value(Some(press));
    }
    // Escape has broken it off.
    let Some(gesture) = app.model.gesture.get_untracked() else { return };
    app.model.gesture.set(Some(moved(app, gesture, at)));
}

fn moved(app: App, gesture: Gesture, at: Point) -> Gesture {
    let Some(viewport) = app.model.viewport.get_untracked() else { return gesture };
    match gesture {
        Gesture::Pan { last } => {
            pan(app, at.x - last.x, at.y - last.y);
            Gesture::Pan { last: at }
        }
        Gesture::Marquee { from, .. } => Gesture::Marquee { from, to: at },
        Gesture::Drag { from, origins, over: before } => {
            let (dx, dy) = ((at.x - from.x) / viewport.scale, (at.y - from.y) / viewport.scale);
            let places = origins.iter().map(|(&id, place)| (id, Point::new(place.x + dx, place.y + dy)));
            app.act(Action::Move(places.collect()));
            let below = state_at(app, viewport.in_drawing(at), |id| origins.contains_key(&id));
            let over = below.filter(|_| origins.len() == 1);
            if over != before {
                app.act(Action::ConsiderNoMore);
                if let (Some(kept), Some(&merged)) = (over, origins.keys().next()) {
                    app.act(Action::Consider(vec![Edit::MergeStates { kept, merged }]));
                }
            }
            Gesture::Drag { from, origins, over }
        }
        Gesture::Connect { source, symbol, .. } => {
            let over = state_at(app, viewport.in_drawing(at), |_| false);
            Gesture::Connect { source, symbol, to: at, over }
        }
    }
}

/// The pointer goes up.
pub(super) fn up(app: App, pressed: Pressed, event: &PointerEvent) {
    let Some(press) = pressed.get_value() else { return };
    if !press.begun {
        pressed.set_value(None);
    }
    let Some(gesture) = app.model.gesture.get_untracked() else { return };
    app.model.gesture.set(None);
    match gesture {
        Gesture::Marquee { from, to } => select_between(app, from, to),
        Gesture::Drag { origins, over: Some(kept), .. } => {
            app.act(Action::Move(BTreeMap::new()));
            let merge = origins.keys().map(|&merged| Edit::MergeStates { kept, merged });
            app.act(Action::Begin(merge.collect()));
        }
        Gesture::Drag { .. } => app.act(Action::Drop),
        Gesture::Connect { source, symbol, over: Some(target), .. } => {
            connect(app, source, symbol, target, event);
        }
        Gesture::Pan { .. } | Gesture::Connect { .. } => {}
    }
}

/// The click that ends a gesture is none: it comes right after the pointer went up.
pub(super) fn click(app: App, pressed: Pressed, event: &MouseEvent) {
    if pressed.get_value().is_some_and(|press| press.begun) {
        pressed.set_value(None);
        event.stop_propagation();
    } else if let (true, item) = painted(app, event) {
        // What is painted has no element that could hear the click.
        let more = event.shift_key() || event.ctrl_key() || event.meta_key();
        app.act(item.filter(|_| more).map_or(Action::Select(item), Action::ToggleSelected));
    }
}

/// The browser took the pointer away: nothing comes of the gesture.
pub(super) fn abort(app: App, pressed: Pressed) {
    pressed.set_value(None);
    app.act(Action::Abort);
    app.act(Action::ConsiderNoMore);
}

fn connect(app: App, source: StateId, symbol: Option<Symbol>, target: StateId, event: &PointerEvent) {
    let (x, y) = (f64::from(event.client_x()), f64::from(event.client_y()));
    if let Some(symbol) = symbol {
        let edit = Edit::MoveTransition { source, symbol, new_source: source, new_target: target };
        return app.act(Action::Begin(vec![edit]));
    }
    let content = MenuContent::Symbols { source, target };
    app.act(Action::Menu(Some(Menu { x, y, content })));
}

/// Turning the wheel zooms at the pointer.
pub(super) fn wheel(app: App, event: &WheelEvent) {
    event.prevent_default();
    let pixels = if event.delta_mode() == WheelEvent::DOM_DELTA_LINE { 16.0 } else { 1.0 };
    zoom_at(app, (-event.delta_y() * pixels * 0.0015).exp(), place_in_frame(event));
}

/// The other button shows what can be done with what is below the pointer.
pub(super) fn menu(app: App, event: &MouseEvent) {
    event.prevent_default();
    if app.model.tab.get_untracked() != Tab::Automaton {
        return;
    }
    let item = match on(app, event) {
        On::State(id) => Some(Selection::State(id)),
        On::Transition(source, symbol) => Some(Selection::Transition(source, symbol)),
        On::Background | On::Handle(..) => None,
    };
    if item.is_none_or(|item| app.model.selection.with_untracked(|selection| !selection.contains(&item))) {
        app.act(Action::Select(item));
    }
    let (x, y) = (f64::from(event.client_x()), f64::from(event.client_y()));
    app.act(Action::Menu(Some(Menu { x, y, content: MenuContent::Commands })));
}

/// What a pointer is on.
enum On {
    Background,
    State(StateId),
    Transition(StateId, Symbol),
    /// A handle to draw an arrow from a state, or to move the end of one of its transitions.
    Handle(StateId, Option<Symbol>),
}

/// Whether a pointer is on no element, and the painted state that it is on then.
fn painted(app: App, event: &MouseEvent) -> (bool, Option<Selection>) {
    let element = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    let outside = element.is_none_or(|it| {
        !matches!(it.closest("[data-handle], [data-state], [data-transition], .minimap"), Ok(Some(_)))
    });
    let Some(viewport) = app.model.viewport.get_untracked().filter(|_| outside) else {
        return (outside, None);
    };
    let state = state_at(app, viewport.in_drawing(place_in_frame(event)), |_| false);
    (true, state.map(Selection::State))
}

fn on(app: App, event: &MouseEvent) -> On {
    let element = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    let named = |name: &str| {
        let closest = element.as_ref()?.closest(&format!("[{name}]")).ok().flatten()?;
        closest.get_attribute(name)
    };
    if let Some(text) = named("data-handle") {
        let mut parts = text.split(' ');
        let source = parts.next().and_then(|id| id.parse().ok());
        return source
            .map_or(On::Background, |id| On::Handle(id, parts.next().and_then(|it| it.parse().ok())));
    }
    if let Some(id) = named("data-state").and_then(|id| id.parse().ok()) {
        return On::State(id);
    }
    let transition = named("data-transition").and_then(|text| {
        let mut parts = text.split(' ');
        Some(On::Transition(parts.next()?.parse().ok()?, parts.next()?.parse().ok()?))
    });
    transition.unwrap_or_else(|| match painted(app, event) {
        (_, Some(Selection::State(id))) => On::State(id),
        _ => On::Background,
    })
}

/// What is dragged with the state `id`: all selected states when it is one of them.
fn origins(app: App, id: StateId) -> BTreeMap<StateId, Point> {
    let selected = app.selected_states();
    let dragged = if selected.contains(&id) { selected } else { vec![id] };
    let Some(picture) = app.derived.picture.get_untracked() else { return BTreeMap::new() };
    let place = |id: StateId| picture.node(id).map(|node| (id, Point::new(node.x, node.y)));
    dragged.into_iter().filter_map(place).collect()
}

/// The state at a place of the drawing, but for those that `except` names.
fn state_at(app: App, place: Point, except: impl Fn(StateId) -> bool) -> Option<StateId> {
    let hidden = app.derived.residue.get_untracked();
    app.derived.picture.get_untracked()?.states().find_map(|(id, rect)| {
        let inside =
            (rect.left..=rect.right).contains(&place.x) && (rect.top..=rect.bottom).contains(&place.y);
        (inside && !except(id) && !hidden.states.contains(&id)).then_some(id)
    })
}

/// Adds the states in a rectangle of the frame to what is selected.
fn select_between(app: App, a: Point, b: Point) {
    let (Some(viewport), Some(picture)) =
        (app.model.viewport.get_untracked(), app.derived.picture.get_untracked())
    else {
        return;
    };
    let (a, b) = (viewport.in_drawing(a), viewport.in_drawing(b));
    let within = |place: f64, from: f64, to: f64| (from.min(to)..=from.max(to)).contains(&place);
    let mut selection = app.model.selection.get_untracked();
    let hidden = app.derived.residue.get_untracked();
    for node in picture.layout.nodes.iter().filter(|node| !hidden.states.contains(&node.id)) {
        let item = Selection::State(node.id);
        if within(node.x, a.x, b.x) && within(node.y, a.y, b.y) && !selection.contains(&item) {
            selection.push(item);
        }
    }
    app.act(Action::SelectAll(selection));
}

fn frame_of(event: &MouseEvent) -> Option<Element> {
    event.current_target().map(JsCast::unchecked_into::<Element>)
}

/// Where a pointer is, from the frame's corner.
fn place_in_frame(event: &MouseEvent) -> Point {
    let rect = frame_of(event).map(|frame| frame.get_bounding_client_rect());
    let (left, top) = rect.map_or((0.0, 0.0), |rect| (rect.left(), rect.top()));
    Point::new(f64::from(event.client_x()) - left, f64::from(event.client_y()) - top)
}
