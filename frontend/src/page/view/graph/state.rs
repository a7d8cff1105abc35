//! A state: its box, its chips, and what may become of it.

use std::sync::Arc;

use goalgraph::layout::Point;
use goalgraph::layout::drawing::{BOX_RADIUS, CHIP_HEIGHT, Chip, SECOND_BORDER, StateDrawing, state_drawing};
use goalgraph::pdfa::StateId;
use leptos::prelude::*;
use web_sys::KeyboardEvent;

use super::{is_selected, live, pick};
use crate::page::model::{Gesture, Selection};
use crate::page::text;
use crate::page::update::App;
use crate::page::view::viewport::reveal;

/// The state `id`, for as long as it is there.
pub(super) fn state(app: App, id: StateId) -> impl IntoView {
    let item = Selection::State(id);
    let drawing = Memo::new(move |_| drawing(app, id));
    let place = Memo::new(move |_| {
        app.derived.picture.with(|picture| picture.as_ref()?.node(id).map(|node| Point::new(node.x, node.y)))
    });
    let transform = move || {
        let Point { x, y } = place.get().unwrap_or(Point::new(0.0, 0.0));
        format!("translate({x:.1}px, {y:.1}px)")
    };
    let label = move || {
        app.derived
            .specification
            .with(|it| it.as_ref().map(|it| text::state_label(it, id)).unwrap_or_default())
    };
    let folds = move || app.derived.marks.with(|marks| marks.folding.contains_key(&id));
    let takes = move || app.derived.marks.with(|marks| marks.taking.contains(&id));
    let goes = move || app.derived.marks.with(|marks| marks.going_states.contains(&id));
    let preferred =
        move || app.derived.followed.with(|plan| plan.as_ref().is_some_and(|it| it.states.contains(&id)));
    let found = move || app.derived.hits.with(|hits| hits.contains(&item));
    let mark = Memo::new(move |_| {
        let marks = app.derived.watched.marks.get();
        marks.map(|marks| marks.state(id)).unwrap_or_default()
    });
    let label = move || live::state_label(&mark.read(), label());
    let target = move || app.model.gesture.with(|gesture| over(gesture.as_ref()) == Some(id));
    view! {
        <g
            class="state"
            class:preferred=preferred
            class:selected=move || is_selected(app, item)
            class:held=move || app.model.held.with(|held| held.contains_key(&id))
            class:folding=folds
            class:taking=takes
            class:going=goes
            class:found=found
            class:target=target
            class:present=move || app.derived.present.get() == Some(id)
            class:live=move || mark.with(|mark| mark.here.is_some())
            class:departed=move || mark.with(|mark| mark.departed)
            class:passed=move || mark.with(|mark| mark.age.is_some())
            class:ahead=move || mark.with(|mark| mark.ahead)
            role="button"
            tabindex="0"
            aria-label=label
            aria-description=move || description(app, id)
            aria-pressed=move || is_selected(app, item).to_string()
            data-state=id.to_string()
            data-live-state=move || mark.with(live::hook)
            data-age=move || mark.with(|mark| mark.age.map(live::shade))
            style:transform=transform
            on:focus=move |_| if let Some(place) = place.get_untracked() { reveal(app, place) }
            on:click=move |event| pick(app, item, event.shift_key() || event.ctrl_key() || event.meta_key())
            on:keydown=move |event| press(app, &event, item)
        >
            {move || drawing.get().map(|drawing| content(app, id, &drawing))}
            {move || drawing.get().and_then(|drawing| live::ring(&mark.read(), drawing.width, drawing.height))}
        </g>
    }
}

fn drawing(app: App, id: StateId) -> Option<StateDrawing> {
    let (specification, probabilities) = (app.derived.specification.get()?, app.derived.probabilities.get()?);
    Some(state_drawing(&specification, &probabilities, id, specification.pdfa.states.get(&id)?))
}

/// The state that a pointer would drop something on.
fn over(gesture: Option<&Gesture>) -> Option<StateId> {
    match gesture? {
        Gesture::Drag { over, .. } | Gesture::Connect { over, .. } => *over,
        Gesture::Pan { .. } | Gesture::Marquee { .. } => None,
    }
}

fn description(app: App, id: StateId) -> String {
    let parts = app.derived.specification.with(|specification| {
        let specification = specification.as_ref()?;
        let accepting = specification.pdfa.states.get(&id)?.accepting;
        Some([(id == specification.pdfa.initial).then_some("initial"), accepting.then_some("accepting")])
    });
    parts.into_iter().flatten().flatten().collect::<Vec<_>>().join(", ")
}

fn content(app: App, id: StateId, drawing: &StateDrawing) -> impl IntoView + use<> {
    let StateDrawing { width, height, accepting, .. } = *drawing;
    let note = drawing.note.map(|note| {
        let Point { x, y } = drawing.note_at;
        view! { <text class="note" x=x.to_string() y=y.to_string()>{note}</text> }
    });
    let (title, Point { x, y }) = (drawing.title.clone(), drawing.title_at);
    let chips: Vec<_> = drawing.chips.iter().cloned().map(|chip| chip_view(app, chip)).collect();
    view! {
        {border(width, height, 0.0)}
        {accepting.then(|| border(width, height, SECOND_BORDER))}
        <text class="id" x=x.to_string() y=y.to_string()>{title}</text>
        {note}
        {chips}
        {move || app.model.held.with(|held| held.contains_key(&id)).then(|| pin(width, height))}
        {move || hidden_ways(app, id, height)}
    }
}

fn border(width: f64, height: f64, inset: f64) -> impl IntoView {
    let (width, height) = (width - 2.0 * inset, height - 2.0 * inset);
    view! {
        <rect
            class="box"
            class:inner={inset > 0.0}
            x=(-width / 2.0).to_string()
            y=(-height / 2.0).to_string()
            width=width.to_string()
            height=height.to_string()
            rx=(BOX_RADIUS - inset).to_string()
        />
    }
}

/// Somebody has put the state where it is.
fn pin(width: f64, height: f64) -> impl IntoView {
    let (x, y) = (width / 2.0 - 8.0, 8.0 - height / 2.0);
    view! { <circle class="pin" cx=x.to_string() cy=y.to_string() r="2.5" /> }
}

/// How much of what leads out of a state is hidden from view.
fn hidden_ways(app: App, id: StateId, height: f64) -> Option<impl IntoView> {
    let (number, probability) = app.derived.residue.with(|residue| residue.at.get(&id).copied())?;
    let text = format!("+{number} hidden, {}", goalgraph::layout::drawing::probability_text(probability));
    Some(view! { <text class="residue" y=(height / 2.0 + 10.0).to_string()>{text}</text> })
}

fn chip_view(app: App, Chip { symbol, text, rect }: Chip) -> impl IntoView {
    let class = move || {
        let colors: Arc<_> = app.derived.colors.get();
        format!("chip-mark {}", colors.get(&symbol).map(|color| color.class()).unwrap_or_default())
    };
    let center = (f64::midpoint(rect.left, rect.right), f64::midpoint(rect.top, rect.bottom));
    view! {
        <g class=class>
            <rect
                x=format!("{:.1}", rect.left)
                y=format!("{:.1}", rect.top)
                width=format!("{:.1}", rect.right - rect.left)
                height=CHIP_HEIGHT.to_string()
                rx=(CHIP_HEIGHT / 2.0).to_string()
            />
            <text x=format!("{:.1}", center.0) y=format!("{:.1}", center.1)>{text}</text>
        </g>
    }
}

/// Enter and space select, as they press a button; with Shift they select more.
pub(super) fn press(app: App, event: &KeyboardEvent, item: Selection) {
    let waiting = app.model.draft.with_untracked(|draft| draft.as_ref().is_some_and(|it| it.begun));
    let picks = match event.key().as_str() {
        "Enter" => !waiting,
        " " => true,
        _ => false,
    };
    if picks {
        event.prevent_default();
        pick(app, item, event.shift_key());
    }
}
