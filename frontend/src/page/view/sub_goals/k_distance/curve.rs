//! The curve, drawn.

use leptos::prelude::*;

use super::handle::handle;
use super::{Scale, Tuned};
use crate::page::geometry::line;
use crate::protocol::KDistanceCurve;

/// Sides of the drawing; it is stretched over its place.
const SIDE: f64 = 1000.0;

/// The curve with its axes, what epsilon cuts off it, and the handle.
pub(super) fn curve(tuned: Tuned) -> impl IntoView {
    let path = Memo::new(move |_| {
        let (curve, scale) = (tuned.curve.get()?, tuned.scale.get()?);
        Some(path(&curve, scale))
    });
    let ticks = move || {
        let scale = tuned.scale.get()?;
        Some(scale.ticks().into_iter().map(|value| tick(scale, value)).collect_view())
    };
    let lines = move || {
        let scale = tuned.scale.get()?;
        let y = |value| percent(1.0 - scale.height(value));
        Some(
            scale
                .ticks()
                .into_iter()
                .map(|value| view! { <line class="k-grid" x1="0" x2="100%" y1=y(value) y2=y(value) /> })
                .collect_view(),
        )
    };
    let core = move || percent(tuned.core.get().unwrap_or(0.0));
    let top = move || percent(tuned.scale.get().map_or(0.0, |scale| 1.0 - scale.height(tuned.epsilon.get())));
    view! {
        <div class="k-scale" aria-hidden="true">{ticks}</div>
        <div class="k-plot">
            <svg class="k-area" role="img" aria-label=move || label(tuned)>
                {lines}
                <rect class="k-core" x="0" width=core y=top height="100%" />
                <svg viewBox=format!("0 0 {SIDE} {SIDE}") preserveAspectRatio="none" width="100%" height="100%">
                    <path class="k-line" d=move || path.get() />
                </svg>
                <line class="k-cut" x1=core x2=core y1=top y2="100%" />
            </svg>
            {handle(tuned)}
        </div>
        <div class="k-shares" aria-hidden="true"><span>"0%"</span><span>"of the points, sorted"</span><span>"100%"</span></div>
    }
}

fn label(tuned: Tuned) -> String {
    let name = tuned.name.get_value();
    tuned.core_text().map_or_else(String::new, |core| format!("k-distance curve of {name}: {core}"))
}

fn percent(share: f64) -> String {
    format!("{:.2}%", 100.0 * share)
}

fn tick(scale: Scale, value: f64) -> impl IntoView {
    view! { <span style:top=percent(1.0 - scale.height(value))>{value.to_string()}</span> }
}

fn path(curve: &KDistanceCurve, scale: Scale) -> String {
    let across = SIDE / curve.distances.len().saturating_sub(1).max(1) as f64;
    let place = |(number, &distance): (usize, &f64)| {
        Some((number as f64 * across, SIDE * (1.0 - scale.height(distance))))
    };
    line(curve.distances.iter().enumerate().map(place))
}
