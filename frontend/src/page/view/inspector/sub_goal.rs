//! A sub-goal: its name, its color, and whether it is one at all.

use goalgraph::edit::Edit;
use goalgraph::pdfa::Symbol;
use leptos::prelude::*;

use super::name::name_field;
use crate::page::colors::COLORS;
use crate::page::update::{Action, App};
use crate::page::view::chips::edit_button;

/// Fields to rename, recolor, merge or remove a sub-goal.
pub(crate) fn sub_goal_editor(app: App, symbol: Symbol) -> impl IntoView {
    let name = move || {
        app.derived.specification.with(|it| it.as_ref().map(|it| it.name_of(symbol)).unwrap_or_default())
    };
    let rename = move |name: String| app.act(Action::Edit(None, vec![Edit::RenameSubGoal { symbol, name }]));
    let others = move || {
        let specification = app.derived.specification.get();
        let sub_goals = specification.map(|it| it.sub_goals.clone()).unwrap_or_default();
        let others = sub_goals.into_iter().filter(|it| it.id != symbol);
        others.map(|it| view! { <option value=it.id.to_string()>{it.name}</option> }).collect_view()
    };
    let merge = move |event: web_sys::Event| {
        if let Ok(kept) = event_target_value(&event).parse::<Symbol>() {
            let first_new = app.next_state();
            app.act(Action::Begin(vec![Edit::MergeSubGoals { kept, merged: symbol, first_new }]));
        }
        event_target::<web_sys::HtmlSelectElement>(&event).set_value("");
    };
    let remove = move || vec![Edit::RemoveSubGoal { symbol, first_new: app.next_state() }];
    view! {
        <div class="sub-goal-editor">
            {name_field("Name", name, rename)}
            {palette(app, symbol)}
            <label class="field">
                <span>"Merge into"</span>
                <select on:change=merge><option value="">"Choose a sub-goal…"</option>{others}</select>
            </label>
            <div class="row">{edit_button(app, "Remove everywhere", remove)}</div>
        </div>
    }
}

/// The colors that a sub-goal can have.
fn palette(app: App, symbol: Symbol) -> impl IntoView {
    let chosen =
        Memo::new(move |_| app.derived.specification.with(|it| it.as_ref()?.sub_goal(symbol)?.color));
    let choose =
        move |color: Option<u8>| app.act(Action::Edit(None, vec![Edit::RecolorSubGoal { symbol, color }]));
    let swatch = move |color: u8| {
        view! {
            <button
                type="button"
                class=format!("swatch c{color}")
                aria-label=format!("Color {}", color + 1)
                aria-pressed=move || (chosen.get() == Some(color)).to_string()
                on:click=move |_| choose(Some(color))
            ></button>
        }
    };
    view! {
        <div class="swatches" role="group" aria-label="Color">
            {(0..COLORS as u8).map(swatch).collect_view()}
            <button
                type="button"
                class="button small"
                aria-pressed=move || chosen.get().is_none().to_string()
                on:click=move |_| choose(None)
            >
                "Auto"
            </button>
        </div>
    }
}
