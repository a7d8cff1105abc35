//! Epsilon of the subset on display: the k-distance curve that it is read from, a handle on it, and what it finds.

mod curve;
mod fields;
mod handle;
mod scale;

use std::sync::Arc;

use goalgraph::specification::{Specification, SubsetParameters};
use leptos::prelude::*;

use super::{Counts, learned, of_subset, tried};
use crate::page::text::{count, grouped, percent};
use crate::page::update::App;
use crate::protocol::KDistanceCurve;
use scale::Scale;

/// The curve with everything that belongs to it; while a subset is on display, it stays the same element.
pub(super) fn k_distance(app: App) -> impl IntoView {
    let name = Memo::new(move |_| app.derived.tuning.subset.with(|it| Some(it.as_ref()?.name.clone())));
    move || {
        name.get().map(|name| {
            let tuned = Tuned::new(app, name);
            let there = Memo::new(move |_| app.derived.tuning.of.with(Option::is_some));
            view! {
                <section class="k-distance" aria-label="Epsilon">
                    <header class="section-head">
                        <h2>"Epsilon"</h2>
                        <span class="hint">{move || subtitle(tuned)}</span>
                    </header>
                    {move || if there.get() { parts(tuned).into_any() } else { absence(app).into_any() }}
                </section>
            }
        })
    }
}

/// One subset whose epsilon is on display.
#[derive(Clone, Copy)]
struct Tuned {
    app: App,
    name: StoredValue<String>,
    /// The epsilon: the one that is tried, or else the one that the sub-goals were found with.
    epsilon: Memo<f64>,
    /// How far its points are from their neighbors, once that is known and there are such.
    curve: Memo<Option<Arc<KDistanceCurve>>>,
    scale: Memo<Option<Scale>>,
    /// The share of its points that are core.
    core: Memo<Option<f64>>,
    /// What the epsilon that is tried has found, once that was searched.
    tried: Memo<Option<(f64, Counts)>>,
    /// What epsilon is measured in, with a blank before it; nothing where that is not known.
    unit: Memo<String>,
}

impl Tuned {
    fn new(app: App, name: String) -> Self {
        let settled = move || app.derived.tuning.subset.get().unwrap_or_else(nothing);
        let of_this = name.clone();
        let epsilon = Memo::new(move |_| {
            let attempt = app.model.tuning.attempt.get().filter(|attempt| attempt.subset == of_this);
            attempt.map_or_else(|| settled().epsilon, |attempt| attempt.epsilon)
        });
        let curve = Memo::new(move |_| {
            app.derived.tuning.curve.get()?.ok().filter(|curve| !curve.distances.is_empty())
        });
        let scale = Memo::new(move |_| Some(Scale::new(&*curve.get()?, settled().epsilon)));
        let core = Memo::new(move |_| {
            let (curve, epsilon) = (curve.get()?, epsilon.get());
            let core = curve.distances.partition_point(|&distance| distance <= epsilon);
            Some(core as f64 / curve.distances.len() as f64)
        });
        let unit = Memo::new(move |_| {
            let specification = app.derived.specification.get();
            specification
                .and_then(|it| unit(&it, &settled()))
                .map_or_else(String::new, |unit| format!(" {unit}"))
        });
        let tried = tried(app, name.clone());
        Self { app, name: StoredValue::new(name), epsilon, curve, scale, core, tried, unit }
    }

    /// How many points are core, in words.
    fn core_text(self) -> Option<String> {
        let (core, points) = (self.core.get()?, self.curve.get()?.points);
        let share = percent((core * 10_000.0).round() as usize, 10_000);
        Some(format!("{share} of {} points are core", grouped(points)))
    }
}

fn nothing() -> SubsetParameters {
    SubsetParameters { name: String::new(), features: Vec::new(), epsilon: 1.0, min_points: 1, min_dwell: 1 }
}

/// The unit that all features of a subset share.
fn unit(specification: &Specification, subset: &SubsetParameters) -> Option<String> {
    let in_subset = specification.features.iter().filter(|feature| subset.features.contains(&feature.name));
    let mut units = in_subset.map(|feature| feature.unit.as_ref());
    let first = units.next()??;
    units.all(|unit| unit == Some(first)).then(|| first.clone())
}

/// What the curve is of.
fn subtitle(tuned: Tuned) -> Option<String> {
    let Tuned { app, scale, unit, .. } = tuned;
    let neighbor = app.derived.tuning.subset.with(|it| it.as_ref().map(|it| it.min_points))?;
    let kind = if scale.get()?.is_logarithmic() { ", logarithmic" } else { "" };
    let unit = unit.get();
    let unit = if unit.is_empty() { String::new() } else { format!(" in{unit}") };
    Some(format!("distance to the {} point, itself counted{unit}{kind}", nearest(neighbor)))
}

/// `nearest`, `2nd nearest`.
fn nearest(number: usize) -> String {
    let ending = match (number % 10, number % 100) {
        (1, 11) | (2, 12) | (3, 13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    if number == 1 { "nearest".to_owned() } else { format!("{number}{ending} nearest") }
}

/// Why there is no curve where no subset can be searched.
fn absence(app: App) -> impl IntoView {
    let why = if app.derived.basis.with(Option::is_none) {
        "There is no k-distance curve: no recordings are loaded."
    } else {
        "There is no k-distance curve: the settings have changed since this was learned. Infer again to see it."
    };
    view! { <p class="hint">{why}</p> }
}

fn parts(tuned: Tuned) -> impl IntoView {
    let there = Memo::new(move |_| tuned.scale.with(Option::is_some));
    view! {
        <div class="k-parts">
            <div class="k-chart">
                {move || if there.get() { curve::curve(tuned).into_any() } else { unmeasured(tuned).into_any() }}
            </div>
            <div class="k-side">
                {fields::fields(tuned)}
            </div>
            <div class="k-said">
                <p>{move || tuned.core_text()}</p>
                <p class="k-found" aria-live="polite" data-epsilon=move || searched(tuned)>{move || found(tuned)}</p>
                <p class="hint">{move || keeping(tuned)}</p>
            </div>
        </div>
    }
}

/// What stands in the place of the curve.
fn unmeasured(tuned: Tuned) -> Option<impl IntoView> {
    let why = match tuned.app.derived.tuning.curve.get()? {
        Err(reason) => format!("The points cannot be measured: {reason}."),
        Ok(curve) => {
            format!("{} to cluster, fewer than min. points: none is core.", count(curve.points, "point"))
        }
    };
    Some(view! { <p class="hint">{why}</p> })
}

/// How many clusters there are with the epsilon on display, as far as they were searched.
fn found(tuned: Tuned) -> String {
    let Tuned { app, name, tried, .. } = tuned;
    let name = name.get_value();
    let counts = tried.get().map(|(_, counts)| counts).or_else(|| {
        let (specification, outcome) = learned(app)?;
        let found = of_subset(&specification, &name).count();
        Some(Counts { found, eliminated: outcome.eliminated.iter().filter(|it| it.subset == name).count() })
    });
    let Counts { found, eliminated } = counts.unwrap_or_default();
    let eliminated =
        if eliminated > 0 { format!(", {} eliminated", grouped(eliminated)) } else { String::new() };
    count(found, "sub-goal") + &eliminated
}

/// The epsilon that the clusters on display were found with.
fn searched(tuned: Tuned) -> Option<String> {
    let tried = tuned.tried.get().map(|(epsilon, _)| epsilon);
    let learned = || tuned.app.derived.tuning.subset.with(|subset| Some(subset.as_ref()?.epsilon));
    tried.or_else(learned).map(|epsilon| epsilon.to_string())
}

/// What to do with an epsilon that is tried.
fn keeping(tuned: Tuned) -> Option<&'static str> {
    let name = tuned.name.get_value();
    let attempt = tuned.app.model.tuning.attempt.get().filter(|attempt| attempt.subset == name)?;
    Some(if attempt.released { "Learning with it …" } else { "Enter keeps it, Escape puts it back." })
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn numbers_have_their_endings() {
        let expected =
            ["nearest", "2nd nearest", "3rd nearest", "11th nearest", "20th nearest", "21st nearest"];
        assert_eq!([1, 2, 3, 11, 20, 21].map(nearest), expected);
    }
}
