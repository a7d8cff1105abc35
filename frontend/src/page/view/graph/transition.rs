//! A transition: its arrow, its label, and what may become of it.

use std::sync::Arc;

use goalgraph::layout::drawing::{LABEL_LINE_HEIGHT, TransitionLabel, probability_text, transition_label};
use goalgraph::layout::{EdgePath, Point};
use goalgraph::pdfa::{Probabilities, StateId, Symbol};
use goalgraph::specification::Specification;
use leptos::prelude::*;

use super::state::press;
use super::{is_selected, live, paths, pick};
use crate::page::derived::Way;
use crate::page::model::Selection;
use crate::page::text;
use crate::page::update::App;
use crate::page::view::viewport::reveal;

/// The transition by `symbol` out of `source`, for as long as it is there.
pub(super) fn transition(app: App, source: StateId, symbol: Symbol) -> impl IntoView {
    let name = (source, symbol);
    let item = Selection::Transition(source, symbol);
    let edge = Memo::new(move |_| app.derived.picture.with(|it| it.as_ref()?.edge(source, symbol).cloned()));
    let place = move || edge.with_untracked(|edge| edge.as_ref().map(|edge| edge.label));
    let chance = Memo::new(move |_| {
        app.derived.probabilities.with(|it| it.as_ref().map_or(0.0, |it| it.transition(source, symbol)))
    });
    let target = Memo::new(move |_| edge.with(|edge| edge.as_ref().map(|edge| edge.target)));
    let data = move || target.get().map(|target| format!("{source} {symbol} {target}"));
    let label = move || {
        let specification = app.derived.specification.get()?;
        Some(text::transition_label(&specification, source, symbol, chance.get()))
    };
    let preferred = move || {
        app.derived.followed.with(|plan| {
            plan.as_ref().is_some_and(|plan| {
                plan.states.iter().zip(&plan.word).any(|(&state, &step)| (state, step) == name)
            })
        })
    };
    let goes = move || app.derived.marks.with(|marks| marks.going_transitions.contains(&name));
    let changes = move || app.derived.marks.with(|marks| marks.chances.contains_key(&name));
    let dim =
        move || app.model.lit.with(|lit| !lit.is_empty()) && !app.derived.lit.with(|lit| lit.contains(&name));
    let mark = Memo::new(move |_| {
        let marks = app.derived.watched.marks.get();
        marks.map(|marks| marks.transition(source, symbol)).unwrap_or_default()
    });
    let label = move || Some(live::transition_label(mark.get(), &label()?));
    let left_out = move || {
        mark.get().unavailable
            || (!app.derived.watched.monitoring.get()
                && app.model.unavailable.with(|unavailable| unavailable.contains(&symbol)))
    };
    let enabled = move || app.derived.present.get() == Some(source);
    view! {
        <g
            class="transition"
            class:preferred=preferred
            class:left-out=left_out
            class:out=move || mark.get().unavailable
            class:passed=move || matches!(mark.get().way, Way::Taken(_))
            class:ahead=move || mark.get().way == Way::Ahead
            class:active=move || mark.get().way == Way::Active
            class:abandoned=move || mark.get().way == Way::Abandoned
            class:selected=move || is_selected(app, item)
            class:going=goes
            class:changing=changes
            class:dim=dim
            class:lit=move || app.derived.lit.with(|lit| lit.contains(&name))
            class:never=move || chance.get() == 0.0
            class:expert=move || reweighted(app, source, symbol)
            class:found=move || app.derived.hits.with(|hits| hits.contains(&item))
            class:enabled=enabled
            role="button"
            tabindex="0"
            aria-label=label
            aria-pressed=move || is_selected(app, item).to_string()
            data-transition=data
            data-age=move || live::age_of(mark.get())
            on:focus=move |_| if let Some(place) = place() { reveal(app, place) }
            on:click=move |event| pick(app, item, event.shift_key() || event.ctrl_key() || event.meta_key())
            on:keydown=move |event| press(app, &event, item)
        >
            {move || edge.get().map(|edge| arrow(&edge, chance))}
            {move || edge.get().and_then(|edge| words(app, &edge))}
        </g>
    }
}

/// Whether an expert has set the weight.
fn reweighted(app: App, source: StateId, symbol: Symbol) -> bool {
    app.derived.specification.with(|specification| {
        let way = specification.as_ref().and_then(|it| it.pdfa.transition(source, symbol));
        way.is_some_and(|way| text::is_expert(way.weight, way.count))
    })
}

fn arrow(edge: &EdgePath, chance: Memo<f64>) -> impl IntoView + use<> {
    let (shaft, head) = (paths::shaft(&edge.path), paths::head(&edge.arrow));
    view! {
        <path class="hit" d=shaft.clone() />
        <path class="shaft" d=shaft stroke-width=move || format!("{:.2}", 1.2 + 2.8 * chance.get()) />
        <path class="head" d=head />
    }
}

/// Name and evidence, over a patch that keeps lines away from them.
fn words(app: App, edge: &EdgePath) -> Option<impl IntoView + use<>> {
    let (specification, probabilities): (Arc<Specification>, Arc<Probabilities>) =
        (app.derived.specification.get()?, app.derived.probabilities.get()?);
    let label = transition_label(&specification, &probabilities, edge.source, edge.symbol);
    let TransitionLabel { name, evidence, width, height } = label;
    let Point { x, y } = edge.label;
    let (place, now) = ((edge.source, edge.symbol), probabilities.transition(edge.source, edge.symbol));
    let evidence = move || match app.derived.marks.with(|marks| marks.chances.get(&place).copied()) {
        Some(next) => format!("{} → {}", probability_text(now), probability_text(next)),
        None => evidence.clone(),
    };
    Some(view! {
        <rect
            class="label-back"
            x=format!("{:.1}", x - width / 2.0)
            y=format!("{:.1}", y - height / 2.0)
            width=format!("{width:.1}")
            height=format!("{height:.1}")
            rx="4"
        />
        <text class="label name" x=x.to_string() y=(y - LABEL_LINE_HEIGHT / 2.0).to_string()>{name}</text>
        <text class="label evidence" x=x.to_string() y=(y + LABEL_LINE_HEIGHT / 2.0).to_string()>{evidence}</text>
    })
}
