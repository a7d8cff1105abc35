//! What was found in the subset on display, cluster by cluster.

use goalgraph::specification::{Ball, Specification, SubGoal};
use leptos::prelude::*;

use super::{learned, of_subset};
use crate::page::model::Found;
use crate::page::text::{grouped, significant};
use crate::page::update::{Action, App};
use crate::page::view::chips::chip;
use crate::page::view::inspector::{fact, sub_goal_editor as editor};
use crate::protocol::{EliminatedCluster, FoundCluster};

/// The sub-goals of the subset on display with all that can be done to them; while another epsilon is tried, what it
/// finds.
pub(super) fn cards(app: App) -> Option<impl IntoView> {
    if let Some(found) = app.derived.tuning.found.get() {
        return Some(tried(&found).into_any());
    }
    let (specification, outcome) = learned(app)?;
    let Some(subset) = app.derived.tuning.subset.get() else {
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

/// How many clusters of a kind are listed while they change by the moment.
const LISTED: usize = 12;

fn tried(Found { subset, clusters, .. }: &Found) -> impl IntoView + use<> {
    let found = clusters.found.iter().take(LISTED).map(found_card).collect_view();
    let eliminated = clusters.eliminated.iter().take(LISTED).map(tried_eliminated_card).collect_view();
    let more = |all: usize| {
        let more = all.saturating_sub(LISTED);
        (more > 0).then(|| view! { <li class="hint">{format!("and {} more", grouped(more))}</li> })
    };
    view! {
        <h2>"Sub-goals of " {subset.clone()}</h2>
        <ul class="sub-goals">{found} {more(clusters.found_in_all)}</ul>
        {(clusters.eliminated_in_all > 0).then(|| view! {
            <h3>"Eliminated (dashed)"</h3>
            <ul class="sub-goals">{eliminated} {more(clusters.eliminated_in_all)}</ul>
        })}
    }
}

fn found_card(cluster: &FoundCluster) -> impl IntoView + use<> {
    let FoundCluster { center, radius, frames, demonstrations } = cluster;
    view! { <li class="sub-goal">{ball(center, *radius, *frames, *demonstrations)}</li> }
}

fn tried_eliminated_card(cluster: &EliminatedCluster) -> impl IntoView + use<> {
    view! { <li class="sub-goal eliminated"><p>{cluster.reason.clone()}</p> {eliminated_ball(cluster)}</li> }
}

fn eliminated_ball(cluster: &EliminatedCluster) -> impl IntoView + use<> {
    ball(&cluster.center, cluster.radius, cluster.frames, cluster.demonstrations)
}

fn ball(center: &[f64], radius: f64, frames: usize, demonstrations: usize) -> impl IntoView + use<> {
    view! {
        <dl class="facts">
            {fact("Center", coordinates(center))}
            {fact("Radius", significant(radius))}
            {fact("Frames", grouped(frames))}
            {fact("Demonstrations", grouped(demonstrations))}
        </dl>
    }
}

fn card(app: App, sub_goal: &SubGoal, at: &Ball) -> impl IntoView + use<> {
    view! {
        <li class="sub-goal" data-sub-goal=sub_goal.id.to_string()>
            <h3>{chip(app, sub_goal.id)}</h3>
            {ball(&at.center, at.radius, sub_goal.frames, sub_goal.demonstrations)}
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
            {eliminated_ball(cluster)}
        </li>
    }
}

fn coordinates(center: &[f64]) -> String {
    center.iter().map(|&value| significant(value)).collect::<Vec<_>>().join(", ")
}
