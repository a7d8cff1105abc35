//! The Sub-goals tab: what was found in each feature subset, where, with which epsilon, and the words.

mod cards;
mod k_distance;
mod places;

use std::sync::Arc;

use goalgraph::specification::{Ball, Specification, SubGoal, SubsetParameters};
use leptos::prelude::*;

use super::chips::nothing_yet;
use super::draft::draft;
use super::inspector::fact;
use super::words::word;
use crate::page::colors::subset_classes;
use crate::page::text::{count, significant};
use crate::page::update::{Action, App};
use crate::protocol::Outcome;

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
                    {k_distance::k_distance(app)}
                    {move || places::places(app)}
                    <h2>"Words" {move || waiting(app)}</h2>
                    {move || words(app)}
                </section>
                <aside class="inspector" aria-label="Sub-goals">{draft(app)} {move || cards::cards(app)}</aside>
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

/// Words are read again once an epsilon that is tried is let go of.
fn waiting(app: App) -> Option<impl IntoView> {
    let is_tried = app.derived.tuning.found.with(Option::is_some);
    is_tried.then(|| view! { <span class="hint waiting">"as before, until epsilon is let go of"</span> })
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
    let counts = Counts {
        found: of_subset(specification, &subset.name).count(),
        eliminated: outcome.eliminated.iter().filter(|cluster| cluster.subset == subset.name).count(),
    };
    let tried = tried(app, subset.name.clone());
    let (name, epsilon) = (subset.name.clone(), subset.epsilon);
    let counts = move || tried.get().map_or(counts, |(_, counts)| counts);
    let epsilon = move || significant(tried.get().map_or(epsilon, |(epsilon, _)| epsilon));
    let eliminated = move || {
        let eliminated = counts().eliminated;
        (eliminated > 0).then(|| fact("eliminated", eliminated.to_string()))
    };
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
                    <strong>{name}</strong>
                    <span class="hint">{move || count(counts().found, "sub-goal")}</span>
                </span>
                <dl class="facts compact">
                    {fact("epsilon", epsilon)}
                    {fact("min. points", subset.min_points.to_string())}
                    {fact("min. dwell", count(subset.min_dwell, "frame"))}
                    {eliminated}
                </dl>
            </button>
        </li>
    }
}

/// How many clusters there are of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Counts {
    found: usize,
    eliminated: usize,
}

/// The epsilon that is tried on a subset, and how many clusters it gives.
fn tried(app: App, subset: String) -> Memo<Option<(f64, Counts)>> {
    Memo::new(move |_| {
        app.derived.tuning.found.with(|found| {
            let found = found.as_ref().filter(|found| found.subset == subset)?;
            let (found_in_all, eliminated) = (found.clusters.found_in_all, found.clusters.eliminated_in_all);
            Some((found.epsilon, Counts { found: found_in_all, eliminated }))
        })
    })
}

fn of_subset<'a>(
    specification: &'a Specification,
    name: &'a str,
) -> impl Iterator<Item = (&'a SubGoal, &'a Ball)> {
    let with_ball =
        specification.sub_goals.iter().filter_map(|sub_goal| Some((sub_goal, sub_goal.ball.as_ref()?)));
    with_ball.filter(move |(_, ball)| ball.subset == name)
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
