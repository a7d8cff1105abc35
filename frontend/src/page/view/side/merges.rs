//! States that may be one, best first: accept, veto, next.

use goalgraph::edit::Edit;
use goalgraph::merge_candidates::MergeCandidate;
use leptos::prelude::*;

use crate::page::model::Selection;
use crate::page::text::count;
use crate::page::update::{Action, App};
use crate::page::view::chips::edit_button;
use crate::page::view::graph;

/// The list of candidates.
pub(super) fn merges(app: App) -> impl IntoView {
    let vetoed = move || app.model.vetoed.with(std::collections::BTreeSet::len);
    let none = move || app.derived.candidates.with(Vec::is_empty);
    view! {
        <p class="hint">
            "Pairs of states with futures that are alike. The test is ALERGIA's: below 1 no difference of the counts is larger than chance would give."
        </p>
        {move || none().then(|| view! { <p class="hint">"No two states have enough evidence to be compared."</p> })}
        <ol class="candidates">
            <For
                each=move || app.derived.candidates.get()
                key=|it| format!("{} {} {} {:?}", it.kept, it.merged, it.score, it.distinguished_by)
                children=move |candidate| row(app, &candidate)
            />
        </ol>
        {move || (vetoed() > 0).then(|| view! { <p class="hint">{format!("{} vetoed", vetoed())}</p> })}
    }
}

fn row(app: App, candidate: &MergeCandidate) -> impl IntoView + use<> {
    let MergeCandidate { kept, merged, score, compared, distinguished_by } = *candidate;
    let edit = move || vec![Edit::MergeStates { kept, merged }];
    let both = [Selection::State(kept), Selection::State(merged)];
    let show = move |_| {
        app.act(Action::SelectAll(both.to_vec()));
        graph::show(app, &both);
    };
    let evidence = distinguished_by.and_then(|index| {
        app.derived.specification.with(|it| Some(it.as_ref()?.demonstrations.get(index)?.name.clone()))
    });
    let evidence = match evidence {
        Some(name) => format!("{name} tells them apart"),
        None => "no demonstration tells them apart".to_owned(),
    };
    let alike = if score < 1.0 { "alike" } else { "different" };
    view! {
        <li class="candidate">
            <button type="button" class="link" on:click=show>{format!("{kept} and {merged}")}</button>
            <span class="hint">{format!("{alike}: the largest difference is {} of the bound, over {}", hundredths(score), count(compared, "outcome"))}</span>
            <span class="hint">{evidence}</span>
            <div class="row">
                {edit_button(app, "Merge", edit)}
                <button type="button" class="button" title="Do not propose this pair again" on:click=move |_| app.act(Action::Veto(kept, merged))>"Veto"</button>
            </div>
        </li>
    }
}

fn hundredths(score: f64) -> String {
    format!("{score:.2}")
}
