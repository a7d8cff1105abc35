//! The automaton as a graph: drawn from its placement, panned, zoomed, selected.

use std::sync::Arc;

use goalgraph::layout::drawing::{
    BOX_RADIUS, CHIP_HEIGHT, Chip, LABEL_LINE_HEIGHT, SECOND_BORDER, probability_text, state_drawing,
    transition_label,
};
use goalgraph::pdfa::{Probabilities, StateId, Symbol};
use goalgraph::plan::Plan;
use goalgraph::specification::Specification;
use leptos::prelude::*;
use web_sys::KeyboardEvent;

use super::viewport::{frame, reveal};
use crate::page::model::{Selection, Viewport};
use crate::page::text;
use crate::page::update::{Action, App};
use crate::protocol::{PlacedArrow, PlacedState, PlacedTransition, Placement};

pub(crate) use super::viewport::{ZOOM_STEP, fit, zoom};

/// What the drawing is made of.
#[derive(Clone)]
struct Drawing {
    app: App,
    specification: Arc<Specification>,
    probabilities: Arc<Probabilities>,
}

/// The graph in its frame.
pub(crate) fn graph(app: App) -> impl IntoView {
    let transform = move || {
        let Viewport { scale, x, y } =
            app.model.viewport.get().unwrap_or(Viewport { scale: 1.0, x: 0.0, y: 0.0 });
        format!("translate({x:.2} {y:.2}) scale({scale:.4})")
    };
    frame(app, view! { <g transform=transform>{move || content(app)}</g> })
}

fn content(app: App) -> Option<impl IntoView> {
    let placement = app.derived.placement.get()?;
    let specification = app.derived.specification.get_untracked()?;
    let probabilities = app.derived.probabilities.get_untracked()?;
    let drawing = Drawing { app, specification, probabilities };
    let Placement { start, states, transitions, .. } = &*placement;
    Some(view! {
        {start.as_ref().map(|start| view! { <g class="start-mark">{arrow(start, "1.5")}</g> })}
        {transitions.iter().filter_map(|transition| drawing.transition(transition)).collect_view()}
        {states.iter().filter_map(|state| drawing.state(state)).collect_view()}
    })
}

impl Drawing {
    fn transition(&self, placed: &PlacedTransition) -> Option<impl IntoView + use<>> {
        let (source, symbol) = (placed.source.parse().ok()?, placed.symbol.parse().ok()?);
        let app = self.app;
        let chance = self.probabilities.transition(source, symbol);
        let label = transition_label(&self.specification, &self.probabilities, source, symbol);
        let selection = Selection::Transition(source, symbol);
        let preferred = move || app.derived.followed.with(|plan| follows(plan.as_ref(), source, symbol));
        let left_out = move || app.model.unavailable.with(|unavailable| unavailable.contains(&symbol));
        let place = (placed.label_x, placed.label_y);
        let shaft = placed.arrow.shaft.clone();
        let (x, y) = (placed.label_x.to_string(), placed.label_y);
        Some(view! {
            <g
                class="transition"
                class:preferred=preferred
                class:left-out=left_out
                class:selected=move || app.model.selection.get() == Some(selection)
                role="button"
                tabindex="0"
                aria-label=text::transition_label(&self.specification, source, symbol, chance)
                aria-pressed=move || (app.model.selection.get() == Some(selection)).to_string()
                data-transition=format!("{} {} {}", placed.source, placed.symbol, placed.target)
                on:focus=move |_| reveal(app, place)
                on:click=move |_| app.act(Action::Select(Some(selection)))
                on:keydown=move |event| press(app, &event, selection)
            >
                <path class="hit" d=shaft />
                {arrow(&placed.arrow, &format!("{:.2}", 1.2 + 2.8 * chance))}
                {label_back(placed, label.width, label.height)}
                <text class="label name" x=x.clone() y=(y - LABEL_LINE_HEIGHT / 2.0).to_string()>{label.name}</text>
                <text class="label evidence" x=x y=(y + LABEL_LINE_HEIGHT / 2.0).to_string()>{label.evidence}</text>
            </g>
        })
    }

    fn state(&self, placed: &PlacedState) -> Option<impl IntoView + use<>> {
        let id: StateId = placed.id.parse().ok()?;
        let state = self.specification.pdfa.states.get(&id)?;
        let drawing = state_drawing(&self.specification, &self.probabilities, id, state);
        let app = self.app;
        let selection = Selection::State(id);
        let place = (placed.x, placed.y);
        let preferred = move || {
            app.derived.followed.with(|plan| plan.as_ref().is_some_and(|plan| plan.states.contains(&id)))
        };
        let description = [
            (id == self.specification.pdfa.initial).then_some("initial"),
            drawing.accepting.then_some("accepting"),
        ];
        let description = description.into_iter().flatten().collect::<Vec<_>>().join(", ");
        Some(view! {
            <g
                class="state"
                class:preferred=preferred
                class:selected=move || app.model.selection.get() == Some(selection)
                role="button"
                tabindex="0"
                aria-label=text::state_label(&self.specification, id)
                aria-description=description
                aria-pressed=move || (app.model.selection.get() == Some(selection)).to_string()
                data-state=placed.id.clone()
                transform=format!("translate({:.1} {:.1})", placed.x, placed.y)
                on:focus=move |_| reveal(app, place)
                on:click=move |_| app.act(Action::Select(Some(selection)))
                on:keydown=move |event| press(app, &event, selection)
            >
                {border(placed.width, placed.height, 0.0)}
                {drawing.accepting.then(|| border(placed.width, placed.height, SECOND_BORDER))}
                <text class="id" x=drawing.title_at.x.to_string() y=drawing.title_at.y.to_string()>{drawing.title}</text>
                {drawing.note.map(|note| view! {
                    <text class="note" x=drawing.note_at.x.to_string() y=drawing.note_at.y.to_string()>{note}</text>
                })}
                {drawing.chips.into_iter().map(|chip| chip_view(app, chip)).collect_view()}
            </g>
        })
    }
}

/// Whether a plan takes the transition by `symbol` out of `source`.
fn follows(plan: Option<&Plan>, source: StateId, symbol: Symbol) -> bool {
    plan.is_some_and(|plan| {
        plan.states.iter().zip(&plan.word).any(|(&state, &step)| state == source && step == symbol)
    })
}

fn arrow(arrow: &PlacedArrow, width: &str) -> impl IntoView + use<> {
    view! {
        <path class="shaft" d=arrow.shaft.clone() stroke-width=width.to_owned() />
        <path class="head" d=arrow.head.clone() />
    }
}

/// Room for a label on its line.
fn label_back(placed: &PlacedTransition, width: f64, height: f64) -> impl IntoView + use<> {
    view! {
        <rect
            class="label-back"
            x=format!("{:.1}", placed.label_x - width / 2.0)
            y=format!("{:.1}", placed.label_y - height / 2.0)
            width=format!("{width:.1}")
            height=format!("{height:.1}")
            rx="4"
        />
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

fn chip_view(app: App, Chip { symbol, text, rect }: Chip) -> impl IntoView {
    let class = app.derived.colors.with_untracked(|colors| colors.get(&symbol).map(|color| color.class()));
    let center = (f64::midpoint(rect.left, rect.right), f64::midpoint(rect.top, rect.bottom));
    view! {
        <g class=format!("chip-mark {}", class.unwrap_or_default())>
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

/// Enter and space select, as they press a button.
fn press(app: App, event: &KeyboardEvent, selection: Selection) {
    match event.key().as_str() {
        "Enter" | " " => {
            event.prevent_default();
            app.act(Action::Select(Some(selection)));
        }
        _ => {}
    }
}

/// `0.67  6/9` and the like for lists: how probable a transition is.
pub(crate) fn chance_of(app: App, source: StateId, symbol: Symbol) -> String {
    let chance = app
        .derived
        .probabilities
        .with(|them| them.as_ref().map_or(0.0, |them| them.transition(source, symbol)));
    probability_text(chance)
}
