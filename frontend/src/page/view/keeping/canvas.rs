//! Two automata in one drawing.

use std::sync::Arc;

use goalgraph::layout::drawing::{
    BOX_RADIUS, CHIP_HEIGHT, Chip, LABEL_LINE_HEIGHT, SECOND_BORDER, state_drawing,
};
use goalgraph::layout::{EdgePath, Layout, NodeBox};
use goalgraph::pdfa::Probabilities;
use leptos::prelude::*;

use crate::page::derived::{Drawing, Sign};
use crate::page::update::App;
use crate::page::view::graph::paths;

/// How much a step zooms, and how far.
const STEP: f64 = 1.25;
const SCALES: (f64, f64) = (0.1, 2.5);
/// Small drawings are not blown up further than this.
const LARGEST_FIT: f64 = 1.4;

/// The drawing, once it is placed.
pub(super) fn canvas(app: App, drawing: &Arc<Drawing>) -> impl IntoView + use<> {
    let drawing = Arc::clone(drawing);
    // None: as large as the frame allows.
    let scale = RwSignal::new(None::<f64>);
    let zoom = move |factor: f64| {
        let next = scale.get_untracked().unwrap_or(1.0) * factor;
        scale.set(Some(next.clamp(SCALES.0, SCALES.1)));
    };
    let picture = move || {
        let layout = app.model.keeping.placed.with(|(_, layout)| layout.clone());
        match layout {
            None => view! { <p class="hint" role="status">"Drawing"</p> }.into_any(),
            Some(layout) => svg(app, &drawing, &layout, scale).into_any(),
        }
    };
    view! {
        <div class="difference-frame">
            <div class="difference-scroll" tabindex="0" role="group" aria-label="Drawing of what differs">{picture}</div>
            <div class="zoom-buttons">
                <button type="button" class="button small" aria-label="Zoom in" on:click=move |_| zoom(STEP)>"+"</button>
                <button type="button" class="button small" aria-label="Zoom out" on:click=move |_| zoom(1.0 / STEP)>"\u{2212}"</button>
                <button type="button" class="button small" on:click=move |_| scale.set(None)>"Fit"</button>
            </div>
        </div>
    }
}

fn svg(app: App, drawing: &Drawing, layout: &Layout, scale: RwSignal<Option<f64>>) -> impl IntoView + use<> {
    let union = &drawing.difference.union;
    let chances = union.pdfa.probabilities(union.semantics);
    let (width, height) = (layout.width, layout.height);
    let edges = layout.edges.iter().map(|edge| transition(app, drawing, edge)).collect_view();
    let nodes = layout.nodes.iter().map(|node| state(app, drawing, &chances, node)).collect_view();
    let start = layout.start.as_ref().map(|start| {
        let (shaft, head) = (paths::start(start), paths::head(&start.arrow));
        view! { <g><path class="shaft" stroke-width="1.5" d=shaft /><path class="head" d=head /></g> }
    });
    let view_box = format!("{:.1} {:.1} {width:.1} {height:.1}", layout.left, layout.top);
    let length = move |length: f64| scale.get().map(|scale| format!("{:.0}", length * scale));
    view! {
        <svg
            class="graph difference-graph"
            class:fitted=move || scale.get().is_none()
            viewBox=view_box
            style:max-width=move || scale.get().is_none().then(|| format!("{:.0}px", width * LARGEST_FIT))
            width=move || length(width)
            height=move || length(height)
            role="group"
            aria-label="Both automata"
        >
            {start} {edges} {nodes}
        </svg>
    }
}

/// The class of a part, by how it differs.
fn class_of(kind: &str, sign: Option<Sign>) -> String {
    format!("{kind} {}", sign.map_or("same", Sign::class))
}

/// How it is said: `Added: red 1 from q0 to q1, + 0.33`.
fn spoken(sign: Option<Sign>, text: &str) -> String {
    match sign {
        Some(sign) => format!("{}: {text}", sign.word()),
        None => text.to_owned(),
    }
}

fn transition(app: App, drawing: &Drawing, edge: &EdgePath) -> impl IntoView + use<> {
    let (source, symbol, target) = (edge.source, edge.symbol, edge.target);
    let sign = drawing.transition_sign(source, symbol);
    let (name, chance) = drawing.label(source, symbol);
    let part = format!("{source} {symbol}");
    let label = spoken(sign, &format!("{name} from {source} to {target}, {chance}"));
    let (shaft, head) = (paths::shaft(&edge.path), paths::head(&edge.arrow));
    let (x, y) = (edge.label.x, edge.label.y);
    let first = format!("{:.1}", y - LABEL_LINE_HEIGHT / 2.0);
    let second = format!("{:.1}", y + LABEL_LINE_HEIGHT / 2.0);
    view! {
        <g
            class=class_of("transition", sign)
            class:pointed=is_pointed(app, part.clone())
            data-part=part
            data-difference=sign.map_or("same", Sign::class)
            role="img"
            aria-label=label
        >
            <path class="shaft" stroke-width="1.8" d=shaft />
            <path class="head" d=head />
            <text class="label name" x=format!("{x:.1}") y=first>{name}</text>
            <text class="label evidence" x=format!("{x:.1}") y=second>{chance}</text>
        </g>
    }
}

fn state(app: App, drawing: &Drawing, chances: &Probabilities, node: &NodeBox) -> impl IntoView + use<> {
    let union = &drawing.difference.union;
    let (id, sign) = (node.id, drawing.state_sign(node.id));
    let state = union.pdfa.states.get(&id).cloned().unwrap_or_default();
    let drawn = state_drawing(union, chances, id, &state);
    let title = format!("{}{}", sign.map_or(String::new(), |sign| format!("{} ", sign.sign())), drawn.title);
    let label = spoken(sign, &format!("State {}", drawn.title));
    let chips = drawn.chips.iter().map(|chip| chip_view(drawing, chip)).collect_view();
    let note = drawn.note.map(|note| {
        let (x, y) = (drawn.note_at.x.to_string(), drawn.note_at.y.to_string());
        view! { <text class="note" x=x y=y>{note}</text> }
    });
    let border = |inset: f64| {
        let (width, height) = (node.width - 2.0 * inset, node.height - 2.0 * inset);
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
    };
    view! {
        <g
            class=class_of("state", sign)
            class:pointed=is_pointed(app, id.to_string())
            data-part=id.to_string()
            data-difference=sign.map_or("same", Sign::class)
            role="img"
            aria-label=label
            transform=format!("translate({:.1} {:.1})", node.x, node.y)
        >
            {border(0.0)}
            {drawn.accepting.then(|| border(SECOND_BORDER))}
            <text class="id" x=drawn.title_at.x.to_string() y=drawn.title_at.y.to_string()>{title}</text>
            {note}
            {chips}
        </g>
    }
}

fn is_pointed(app: App, part: String) -> impl Fn() -> bool + Clone {
    move || app.model.keeping.pointed.with(|it| it.as_ref() == Some(&part))
}

fn chip_view(drawing: &Drawing, Chip { symbol, text, rect }: &Chip) -> impl IntoView + use<> {
    let color = drawing.colors.get(symbol).map(|color| color.class()).unwrap_or_default();
    let center = (f64::midpoint(rect.left, rect.right), f64::midpoint(rect.top, rect.bottom));
    view! {
        <g class=format!("chip-mark {color}")>
            <rect
                x=format!("{:.1}", rect.left)
                y=format!("{:.1}", rect.top)
                width=format!("{:.1}", rect.right - rect.left)
                height=CHIP_HEIGHT.to_string()
                rx=(CHIP_HEIGHT / 2.0).to_string()
            />
            <text x=format!("{:.1}", center.0) y=format!("{:.1}", center.1)>{text.clone()}</text>
        </g>
    }
}
