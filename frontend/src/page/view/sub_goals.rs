//! The Sub-goals tab: what was found in each feature subset, where, and the words.

use std::sync::Arc;

use goalgraph::specification::{Ball, Specification, SubGoal, SubsetParameters};
use leptos::prelude::*;

use super::chips::{chip, nothing_yet};
use super::draft::draft;
use super::inspector::{fact, sub_goal_editor as editor};
use super::plot::{Disk, disks_view};
use super::words::word;
use crate::page::colors::subset_classes;
use crate::page::text::{count, significant};
use crate::page::update::{Action, App};
use crate::protocol::{Cloud, EliminatedCluster, Outcome};

/// List, canvas and inspector.
pub(crate) fn sub_goals(app: App) -> impl IntoView {
    let there = Memo::new(move |_| app.derived.specification.with(Option::is_some));
    move || {
        if !there.get() {
            return nothing_yet(app, "No sub-goals were found yet. Open demonstrations, or load a sample.")
                .into_any();
        }
        view! {
            <div class="columns">
                {subsets(app)}
                <section class="canvas scroll" tabindex="0" aria-label="Places">
                    {move || places(app)}
                    <h2>"Words"</h2>
                    {move || words(app)}
                </section>
                <aside class="inspector" aria-label="Sub-goals">{draft(app)} {move || found(app)}</aside>
            </div>
        }
        .into_any()
    }
}

/// What the views of this tab are made of; a specification that was opened was learned from nothing here.
fn learned(app: App) -> Option<(Arc<Specification>, Arc<Outcome>)> {
    let outcome =
        app.model.learned.with(|learned| learned.as_ref().map(|learned| Arc::clone(&learned.outcome)));
    Some((app.derived.specification.get()?, outcome.unwrap_or_default()))
}

fn shown_subset(app: App, specification: &Specification) -> Option<SubsetParameters> {
    let index = app.model.subset.get().min(specification.subsets.len().saturating_sub(1));
    specification.subsets.get(index).cloned()
}

fn subsets(app: App) -> impl IntoView {
    let rows = move || {
        let learned = learned(app)?;
        let specification = &learned.0;
        let names: Vec<&str> = specification.subsets.iter().map(|subset| subset.name.as_str()).collect();
        let classes = subset_classes(&names);
        let row = |(index, subset)| subset_row(app, index, subset, &classes[index], &learned);
        Some(specification.subsets.iter().enumerate().map(row).collect_view())
    };
    view! {
        <section class="list" aria-label="Feature subsets">
            <header class="section-head"><h2>"Feature subsets"</h2></header>
            <ul class="subsets">{rows}</ul>
        </section>
    }
}

fn subset_row(
    app: App,
    index: usize,
    subset: &SubsetParameters,
    class: &str,
    (specification, outcome): &(Arc<Specification>, Arc<Outcome>),
) -> impl IntoView + use<> {
    let class = format!("dot {class}");
    let found = of_subset(specification, &subset.name).count();
    let eliminated = outcome.eliminated.iter().filter(|cluster| cluster.subset == subset.name).count();
    view! {
        <li>
            <button
                type="button"
                class="entry tall"
                aria-pressed=move || (app.model.subset.get() == index).to_string()
                on:click=move |_| app.act(Action::ShowSubset(index))
            >
                <span class="entry-head">
                    <span class=class></span>
                    <strong>{subset.name.clone()}</strong>
                    <span class="hint">{count(found, "sub-goal")}</span>
                </span>
                <dl class="facts compact">
                    {fact("epsilon", significant(subset.epsilon))}
                    {fact("min. points", subset.min_points.to_string())}
                    {fact("min. dwell", count(subset.min_dwell, "frame"))}
                    {(eliminated > 0).then(|| fact("eliminated", eliminated.to_string()))}
                </dl>
            </button>
        </li>
    }
}

fn of_subset<'a>(
    specification: &'a Specification,
    name: &'a str,
) -> impl Iterator<Item = (&'a SubGoal, &'a Ball)> {
    let with_ball =
        specification.sub_goals.iter().filter_map(|sub_goal| Some((sub_goal, sub_goal.ball.as_ref()?)));
    with_ball.filter(move |(_, ball)| ball.subset == name)
}

/// Points and balls of the subset on display, seen from one or two sides.
fn places(app: App) -> Option<impl IntoView> {
    let (specification, outcome) = learned(app)?;
    let subset = shown_subset(app, &specification)?;
    let cloud = outcome.clouds.iter().find(|cloud| cloud.subset == subset.name)?;
    let axes: Vec<String> = subset.features.iter().map(|name| axis(name)).collect();
    let planes = match subset.features.len() {
        0 | 1 => vec![(0, 0)],
        2 => vec![(0, 1)],
        _ => vec![(0, 1), (0, 2)],
    };
    let plane = |(across, up): (usize, usize)| {
        let side = Side { across, up, cloud };
        let disks: Vec<Disk> =
            of_subset(&specification, &subset.name).map(|(it, ball)| side.sub_goal(app, it, ball)).collect();
        let eliminated = outcome.eliminated.iter().filter(|cluster| cluster.subset == subset.name);
        let eliminated: Vec<Disk> = eliminated.map(|cluster| side.eliminated(cluster)).collect();
        disks_view((&axes[across], &axes[up]), &side.points(|_| true), &disks, &eliminated)
    };
    let none = of_subset(&specification, &subset.name).next().is_none();
    Some(view! {
        <header class="section-head">
            <h2>{subset.name.clone()}</h2>
            <span class="hint">{subset.features.join(", ")}</span>
        </header>
        {none.then(|| view! { <p class="hint">"No sub-goal was found in this subset."</p> })}
        <div class="planes">{planes.into_iter().map(plane).collect_view()}</div>
    })
}

fn axis(feature: &str) -> String {
    feature.rsplit(['.', '_']).next().unwrap_or(feature).to_owned()
}

/// One side from which a cloud is seen.
struct Side<'a> {
    across: usize,
    up: usize,
    cloud: &'a Cloud,
}

impl Side<'_> {
    /// The points that `chosen` takes, seen from this side.
    fn points(&self, chosen: impl Fn(&[f64]) -> bool) -> Vec<(f64, f64)> {
        let chunks = self.cloud.coordinates.chunks_exact(self.cloud.dimensions.max(1));
        let points = chunks.map(|point| point.iter().map(|&value| f64::from(value)).collect::<Vec<f64>>());
        points.filter(|point| chosen(point)).map(|point| self.seen(&point)).collect()
    }

    fn seen(&self, point: &[f64]) -> (f64, f64) {
        let value = |axis: usize| point.get(axis).copied().unwrap_or(0.0);
        (value(self.across), if self.across == self.up { 0.0 } else { value(self.up) })
    }

    fn sub_goal(&self, app: App, sub_goal: &SubGoal, ball: &Ball) -> Disk {
        let color = app.derived.colors.with(|colors| colors.get(&sub_goal.id).copied());
        Disk {
            label: sub_goal.name.clone(),
            class: color.unwrap_or_default().class(),
            center: self.seen(&ball.center),
            radius: ball.radius,
            points: self.points(|point| ball.contains(point)),
        }
    }

    fn eliminated(&self, cluster: &EliminatedCluster) -> Disk {
        let (center, radius) = (self.seen(&cluster.center), cluster.radius);
        Disk { label: String::new(), class: "gray".to_owned(), center, radius, points: Vec::new() }
    }
}

/// What was found in the subset on display.
fn found(app: App) -> Option<impl IntoView> {
    let (specification, outcome) = learned(app)?;
    let Some(subset) = shown_subset(app, &specification) else {
        return Some(without_places(app, &specification).into_any());
    };
    let cards = of_subset(&specification, &subset.name).map(|(it, ball)| card(app, it, ball)).collect_view();
    let eliminated = outcome.eliminated.iter().filter(|cluster| cluster.subset == subset.name);
    let eliminated: Vec<_> = eliminated.map(|cluster| eliminated_card(app, cluster)).collect();
    let notes = outcome.notes.iter().map(|note| view! { <li>{note.clone()}</li> }).collect_view();
    Some(view! {
        <h2>"Sub-goals of " {subset.name.clone()}</h2>
        <ul class="sub-goals">{cards}</ul>
        {(!eliminated.is_empty()).then(|| view! { <h3>"Eliminated (dashed)"</h3><ul class="sub-goals">{eliminated}</ul> })}
        {(!outcome.notes.is_empty()).then(|| view! { <h3>"Notes"</h3><ul class="problems">{notes}</ul> })}
    }
    .into_any())
}

/// Sub-goals that nobody recorded have a name and a color, but no place.
fn without_places(app: App, specification: &Specification) -> impl IntoView + use<> {
    let card = |sub_goal: &SubGoal| {
        view! { <li class="sub-goal" data-sub-goal=sub_goal.id.to_string()><h3>{chip(app, sub_goal.id)}</h3> {editor(app, sub_goal.id)}</li> }
    };
    let cards = specification.sub_goals.iter().map(card).collect_view();
    view! { <h2>"Sub-goals"</h2><p class="hint">"They have no places: their words were not recorded."</p><ul class="sub-goals">{cards}</ul> }
}

fn card(app: App, sub_goal: &SubGoal, ball: &Ball) -> impl IntoView + use<> {
    view! {
        <li class="sub-goal" data-sub-goal=sub_goal.id.to_string()>
            <h3>{chip(app, sub_goal.id)}</h3>
            <dl class="facts">
                {fact("Center", coordinates(&ball.center))}
                {fact("Radius", significant(ball.radius))}
                {fact("Frames", sub_goal.frames.to_string())}
                {fact("Demonstrations", sub_goal.demonstrations.to_string())}
            </dl>
            {editor(app, sub_goal.id)}
        </li>
    }
}

fn eliminated_card(app: App, cluster: &EliminatedCluster) -> impl IntoView + use<> {
    let (subset, center) = (cluster.subset.clone(), cluster.center.clone());
    let restore = move |_| app.act(Action::Restore { subset: subset.clone(), center: center.clone() });
    view! {
        <li class="sub-goal eliminated">
            <p>{cluster.reason.clone()}</p>
            <button type="button" class="button" on:click=restore title="Take it for a sub-goal all the same">"Restore"</button>
            <dl class="facts">
                {fact("Center", coordinates(&cluster.center))}
                {fact("Radius", significant(cluster.radius))}
                {fact("Frames", cluster.frames.to_string())}
                {fact("Demonstrations", cluster.demonstrations.to_string())}
            </dl>
        </li>
    }
}

fn coordinates(center: &[f64]) -> String {
    center.iter().map(|&value| significant(value)).collect::<Vec<_>>().join(", ")
}

/// The word of every distinct kind, with the demonstrations that show it.
fn words(app: App) -> impl IntoView {
    let row = |variant: crate::page::derived::Variant| {
        view! {
            <li class="word-row">
                {word(app, &variant.word)}
                <span class="hint" title=variant.demonstrations.join(", ")>{count(variant.demonstrations.len(), "demonstration")}</span>
            </li>
        }
    };
    view! { <ul class="words">{app.derived.variants.get().into_iter().map(row).collect_view()}</ul> }
}
